(** Expressions whose value is a number, as the program's text shows. *)

open Dolphin_semantics

val is_number : Core.program -> Core.expression -> bool
(** [is_number p e] is whether [e], if it has a value, surely has a number: [10.min], [60 * 10], and variables of the
    script to which nothing else is assigned. *)
