(** The pieces of a core program by their numbers, for configurations that are written down: expressions by their sites,
    which elaboration makes unique, functions and closures by their identifiers. *)

open Dolphin_semantics

type t

val of_program : Core.program -> t
val expression : t -> Core.site -> Core.expression option
val lambda : t -> int -> Core.lambda option
