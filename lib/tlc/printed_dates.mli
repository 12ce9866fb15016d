(** Dates that a model with time prints while TLC explores it, as [Timed.tla] has it: whenever a moment of a run is
    found to be earlier or later than it ever was, a line reports it, in one string literal of TLA+, of these fields
    with tabulators between:

    {v
T <tab> program <tab> date <tab> moment
    v}

    A moment has one or more fields: the end of the run; the event of a task, with the task's name, its vehicle and
    its place in the program; ["goes on"], at the horizon; ["stuck"], where no further event is possible. Dates are
    in ticks. *)

type t

val none : t
(** No line was read. *)

val line : t -> string -> t option
(** [line d s] takes in a line of TLC's output; [None] if it is not one of the above. *)

val windows : t -> int -> (string list * (int * int)) list
(** [windows d n] is all moments of program [n], each with its earliest and its latest date, in ascending order. *)
