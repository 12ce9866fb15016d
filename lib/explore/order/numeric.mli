(** Expressions whose value is a number, as the program's text shows. *)

open Dolphin_semantics

val is_number : Core.program -> Core.lambda -> Core.expression -> bool
(** [is_number p l e] is whether [e], an expression of the code [l], if it has a value, surely has a number: [10.min],
    [60 * 10], and variables to which nothing else is assigned; parameters too, of functions that are called by their
    names alone, and by all of them with numbers. *)
