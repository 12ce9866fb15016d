(** The code, keys and numbers that a local slot may hold, found without running the program. These flow by captures,
    assignments to locals and arguments of calls whose callee is known; a key is a parameter of the code of a [fresh].
    Values that come by any other way count as unknown. *)

open Core

type t

val of_program : program -> t
(** The contents of all slots of the program's code, in time that grows with its expressions, times how far code and
    keys flow. *)

type key = { code : int; parameter : int }
(** A parameter of the code of a [fresh], by the number of that code. It is another key in each execution. *)

val callees : t -> lambda -> expression -> lambda list option
(** [callees t l e] is the code that [e], an expression of [l], may be; [None] if it may be any. *)

val key : t -> lambda -> expression -> key option
(** [key t l e] is the parameter that [e], an expression of [l], always is. *)

val computes : expression -> bool
(** Whether an expression is made of numbers, texts and variables by arithmetic: it has no effect, and depends on
    nothing else. *)

val values : t -> lambda -> int -> (lambda * expression) list option
(** [values t l i] is the expressions whose value the local [i] of [l] may have, each with the code that owns it: all of
    them are as {!computes} has it; [None] if it may have other values. *)
