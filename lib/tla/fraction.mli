(** Numbers as fractions: TLA+ has no floating point. *)

val of_float : float -> (int * int) option
(** [of_float n] is the fraction, in lowest terms and with a positive denominator, of the shortest decimal text that
    reads back as [n]: 0.3 is 3/10. [None] if TLC's whole numbers cannot hold it. *)
