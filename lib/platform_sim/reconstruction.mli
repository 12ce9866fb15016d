(** The simulated fleet of a run whose console died, reconstructed. The vehicles were simulated in that console and died
    with it; but all that became of them follows from what they were commanded and when, which the journal has. *)

open Dolphin_runtime
open Dolphin_semantics
open Dolphin_scenario

type t = {
  fleet : Fleet.t;  (** as it was at the time of the last entry, with telemetry on *)
  early : Platform.event list;
  (** what the fleet has told and the journal has not, in order: to be told before anything else *)
  news : World.vehicle_state list;  (** what it told of vehicles since the journal's last line on each *)
}

val make : seed:int -> announce_period:float -> Scenario.t -> History.t -> (t, string) result
(** [make ~seed ~announce_period s history] is the fleet of [s] and [seed] after [history], of a run with a journal. The
    error says what cannot have happened to this fleet. [announce_period] (s) is how long a [pick] without a timeout
    looks.

    In virtual time the fleet is the same as before in every respect. In paced time commands came a little later than
    the journal's lines tell, so that what followed may come as much earlier now. *)
