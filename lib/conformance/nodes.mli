(** The parts of a core program by their numbers, for configurations in JSON: expressions by their sites, which
    elaboration makes unique, functions and closures by their identifiers. *)

open Dolphin_semantics

type t

val of_program : Core.program -> t
(** All pieces of a program. *)

val expression : t -> Core.site -> Core.expression option
(** The expression at that site, if there is one. *)

val lambda : t -> int -> Core.lambda option
(** The function or closure of that number, if there is one. *)
