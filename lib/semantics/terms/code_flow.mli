(** The code and the keys that a local slot may hold, found without running the program. Code flows by captures,
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
