(** A counterexample, carried out on the simulated fleet: {!Dolphin_runtime.Enactment}. Vehicles move, and the only
    events are those of the counterexample. No journal is kept: such a run cannot be resumed. *)

open Dolphin_runtime
open Dolphin_trace

val start :
  Run.front -> interruption:Interruption.t -> speed:float option -> follower:(Entry.t -> unit) -> Program_file.t ->
  Fleet_file.t -> Witness.t -> (Driver.outcome, Error.t) result Lwt.t
(** [start front ~interruption ~speed ~follower program fleet witness] carries [witness] out, as {!Run.start} does a
    run; its cycle, if it has one, once. [follower] is given the lines that a journal would have. The error is
    {!Error.Bad_input}: [program] does not have that run. *)
