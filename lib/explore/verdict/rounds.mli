(** Runs that go round: from a round in an image of the program to a cycle of the program itself, which may take several
    rounds. *)

val closed :
  ?most:int -> equal:('s -> 's -> bool) -> ('s -> ('s * 'step list) option) -> 's -> ('step list * 'step list) option
(** [closed ~equal round s] is the steps from [s], round after round, until one ends where an earlier one began:
    those before that one, and those of the cycle. [round s] is the end of the round from [s], with its steps. [None]
    if there is no further round, or after [most], unbounded by default. *)
