(** Runs without end. An executing task can only become less, so every cycle goes through the script, where a single
    step of the program, or of the outside, is possible that a fair run has to take; around such a cycle no step stays
    possible without being taken. So each cycle of the state graph is a fair run that does not end. *)

type lasso = {
  stem : int list;  (** states from the initial one *)
  around : int list;  (** from its last one back to it *)
}

val find : tick:(unit -> unit) -> Space.t -> lasso option
(** [find ~tick s] is a cycle of [s], all of whose states have been expanded, with a shortest way to it and the
    shortest way around. Where [Space.may_cycle] is [false] there is none, and the graph need not be searched.
    [tick] is called at each state. *)
