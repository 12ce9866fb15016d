(** How much an operation does, where its operands are large. A piece of code may evaluate a number of expressions
    before it counts as endless, or before its step is over; an operation on a million elements counts as many. *)

open Core

val most_free : int
(** Operands with fewer elements than this cost nothing. *)

val of_operation : operation -> value list -> int
(** [of_operation f xs] is the number of expressions that [f] of the operands [xs] counts as, besides itself: one for
    every 200 elements that it looks at or copies; where it sorts [n] elements, [n log2 n / 10]. Operations that take
    constant time count as none. *)
