(** How much an operation does, where its operands are large. A piece of code may evaluate a number of expressions
    before it counts as endless, or before its step is over; an operation on a million elements counts as many. *)

open Core

val most_free : int
(** Operands with fewer elements than this, together, cost nothing. *)

val of_operation : operation -> value list -> int
(** [of_operation f xs] is the number of expressions that [f] of the operands [xs] counts as, besides itself: one for
    every 200 elements that it looks at or copies, of which a string that is only copied has a hundredth of its bytes;
    where it sorts [n] elements, [n log2 n / 10]. Operations that take constant time count as none. Of an operation
    that adds one element to a list only this one is counted, since the result shares the others; if it adds the
    elements of another list, all are copied. *)
