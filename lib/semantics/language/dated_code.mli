(** At which dates code that reads the date may come to do something else: found in the text of the program, from the
    comparisons of [now()]. Between two of these dates it does the same. *)

open Core

type t

val of_program : program -> t
(** [of_program p] finds the dates of all code in [p], once. *)

val next : t -> program -> World.t -> now:int -> Store.t -> int option
(** [next t p w ~now s] is a date after [now], and none after the first at which code of [p] may do something else
    than it did at [now], as long as the variables are those of [s]; [None]: it never does. If code that may be asked
    again and again, as guards are, uses the date in other ways than to compare it with values of variables and
    numbers, this is the next second. *)

val is_exact : t -> bool
(** Whether it does no more. *)

val named : program -> (int list, site) result
(** [named p] is the dates after the start at which code of [p] may take another branch, if [p] only compares the
    date with constants, and prints it; otherwise the place of its first other use. A variable is a constant if only
    constants are assigned to it. *)
