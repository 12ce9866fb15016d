(** The parts of the generated module [Message], in the order of definition. *)

open Dolphin_imc_definition

(** A part of the generated module. *)
type item =
  | Message of Definition.message
  | Group of Definition.group * Definition.message list  (** With its members, by id. *)

type t

exception Unsupported of string
(** The definition asks for something that no message of IMC needs: a message that contains itself by
    name, a message in two groups, a restriction to a message without fields. *)

val make : Definition.t -> t
(** @raise Unsupported *)

val definition : t -> Definition.t
(** Its source. *)

val items : t -> item list
(** Each item after those it refers to by name. *)

val item : t -> string -> item
(** [item o name] is the meaning of [name]. *)

val name : item -> string
(** Its name in the definition. *)

val is_open : t -> item -> bool
(** [is_open o i]: [i] can contain any message, so that its type has the type of all messages as a
    parameter. That type comes last, and ties the knot. *)

val all_groups : t -> item list
(** The groups, as items. *)

val loose : t -> Definition.message list
(** The messages of no group. *)
