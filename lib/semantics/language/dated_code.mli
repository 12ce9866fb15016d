(** At which dates code that reads the date may come to do something else: found in the text of the program, from the
    comparisons of [now()] and [timeOfDay()]. Between two of these dates it does the same. *)

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

(** Dates at which code may take another branch, each once or every day. *)
type dates = {
  once : int list;  (** after the start, in order *)
  daily : int list;  (** each below {!Calendar.day_length}, and that much later each day; in order *)
}

val no_dates : dates
(** None. *)

val named : program -> (dates, site) result
(** [named p] is the dates after the start at which code of [p] may take another branch, if [p] only compares the
    date with constants, and prints it; otherwise the place of its first other use. A variable is a constant if only
    constants are assigned to it; so is a local variable, and a parameter of a function all of whose calls are
    known. The time of day is compared with constants only if it is known when [p] begins. *)

val following : dates -> int -> int option
(** [following d n] is the first of [d] after [n]. *)

val latest : dates -> int -> int
(** [latest d n] is the last of [d] until [n], or 0. *)

val repeated : dates -> int -> int
(** [repeated d n] is a date at which, and after which, code does the same as from [n] on, as far as it depends on [d].
    There are finitely many such dates. *)
