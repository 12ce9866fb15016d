(** Makes the journal of a run, told of it as {!Dolphin_runtime.Observer} are.

    What is told of vehicles becomes a line at once if it is new or the link came or went. The rest, positions and
    batteries, becomes one every few seconds or every ten metres of a vehicle; but before a transition that may depend
    on it, all of it does. So whoever reads the journal knows of vehicles, at each transition, all that the program could
    know. *)

open Dolphin_semantics

type t

val make : ?period:float -> Core.program -> Header.t -> (Entry.t -> unit) -> t
(** [make ~period program header write] gives [header] and then the lines of a run of [program] to [write], in order. A
    vehicle's samples are at most about [period] seconds apart, by default 5. An exception of [write] goes to whoever
    tells of the run. *)

val transition : t -> time:float -> cause:Transition.event option -> Transition.t -> unit
val news : t -> time:float -> World.vehicle_state -> unit

val finish : t -> time:float -> stuck:bool -> unit
(** The run is over. With [~stuck:true] its interruption was nobody's wish, but the end of a program that was stuck.
    Nothing is written of a run that did not end: of one that an exception broke. *)
