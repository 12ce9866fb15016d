(** The simulated fleet of a run whose console died, reconstructed. The vehicles were simulated in that console and
    died with it; but their state follows from their commands and the times of these, which the journal has. *)

open Dolphin_runtime
open Dolphin_semantics
open Dolphin_scenario

type t = {
  fleet : Fleet.t;  (** as it was at the time of the last entry, with telemetry on *)
  early : Platform.event list;
  (** the reports of the fleet that the journal lacks, in order: to be given before anything else *)
  news : World.vehicle_state list;  (** its reports on vehicles since the journal's last line on each *)
}

val make : seed:int -> announce_period:float -> Scenario.t -> History.t -> (t, string) result
(** [make ~seed ~announce_period s history] is the fleet of [s] and [seed] after [history], of a run with a journal. The
    error names the event that this fleet cannot have had. [announce_period] (s) is how long a [pick] without a timeout
    looks.

    In virtual time the fleet is the same as before in every respect. In paced time commands came a little later than
    the journal's lines have it, so that later events may come as much earlier now. *)
