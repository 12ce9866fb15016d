(** OCaml types of messages and fields: the common part of the interface and the implementation. *)

open Dolphin_imc_definition
open Definition

type set =
  | Enumeration_of of named list  (** Becomes a variant type. *)
  | Bits_of of named list  (** Becomes an integer, read through named constants. *)

val shared_sets : Outline.t -> (string * set) list
(** The sets that several messages share, by module name. *)

val own_sets : message -> (string * set) list
(** The sets of values of one field each, by module name. *)

val set_module : field -> names -> string
(** The module of the set that the field's values are in. *)

val constant : named -> bool
(** Whether a bit deserves a constant: all do but [NONE], which every set of bits has. *)

val parameter : Outline.t -> Outline.item -> string
(** ["'message "] for an open item, otherwise empty. *)

val record : Outline.t -> message -> comment:(field -> string) -> Code.t list
(** The record type of a message with fields, with [comment f] after each field. *)

val enumeration : named list -> comment:(named -> string) -> Code.t list
(** The variant type of an enumeration. *)

val variant : Outline.t -> Outline.item -> Outline.item list -> Code.t list
(** [variant o i is] is the type of the group [i], of the members [is]: a constructor each, [Goto of Goto.t], or only
    [Abort] without fields. *)

val all : Outline.t -> Code.t list
(** The type [t] of all messages: the groups, then {!Outline.loose}. *)
