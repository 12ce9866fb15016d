(** The places where a program names its variables and functions, and their definitions. *)

open Dolphin_syntax

(** The kind of a name, and what is known of its definition. *)
type kind =
  | Function of string list  (** with the names of its parameters *)
  | Global of Ast.expression option  (** the value that the first assignment gives it *)
  | Local of Ast.expression option
  | Parameter  (** of a function or closure, or what a loop goes through *)

type span = { start : int; stop : int }
(** Bytes of the text, from [start] up to, but without, [stop]. *)

type binding = { name : string; kind : kind; definition : span; uses : span list }
(** [uses] has [definition], and is in the order of the text. *)

val of_program : source:string -> Ast.program -> binding list
(** [of_program ~source p] is the variables and functions of [p], which [source] spells, in the order in which they are
    defined. *)

val at : binding list -> int -> binding option
(** [at bindings offset] is the one that is named at byte [offset], or just before it. *)
