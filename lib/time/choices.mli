(** Runs as numbers, for another process that has the same program: which step is taken in each state. *)

type t

val of_run : Timed.options -> Timed.state -> Timed.step list -> t
(** [of_run o s steps] is [steps] from [s], each among {!Timed.all_steps}. *)

val run : Timed.options -> Timed.state -> t -> Timed.step list
(** [run o s (of_run o s steps)] is [steps], also where it was another process that made the choices. *)
