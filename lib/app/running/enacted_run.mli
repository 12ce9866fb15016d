(** A counterexample, carried out on the simulated fleet: {!Dolphin_runtime.Enactment}. Vehicles move, and nothing
    happens but what the counterexample says. No journal is kept: it is no run that could be resumed. *)

open Dolphin_runtime
open Dolphin_trace

val start :
  Run.front -> interruption:Interruption.t -> speed:float option -> follower:(Entry.t -> unit) -> Program_file.t ->
  Fleet_file.t -> Witness.t -> (Driver.outcome, Error.t) result Lwt.t
(** [start front ~interruption ~speed ~follower program fleet witness] carries [witness] out, as {!Run.start} does a
    run; its cycle, if it has one, once. [follower] is given the lines that a journal would have. The error is
    {!Error.Bad_input}: [program] does not have that run. *)
