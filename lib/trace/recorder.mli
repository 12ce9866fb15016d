(** Makes the journal of a run, told of it as {!Dolphin_runtime.Observer} are.

    What is told of vehicles becomes a line at once if it is new or the link came or went. The rest, positions and
    batteries, becomes one every few seconds or every ten metres of a vehicle; but before a transition that may depend
    on it, all of it does. So whoever reads the journal knows of vehicles, at each transition, all that the program
    could know. *)

open Dolphin_semantics

type t

val make : ?period:float -> Core.program -> Header.t -> (Entry.t -> unit) -> t
(** [make ~period program header write] gives [header] and then the lines of a run of [program] to [write], in order. A
    vehicle's samples are at most about [period] seconds apart, by default 5. An exception of [write] goes to whoever
    tells of the run. *)

val resume :
  ?period:float -> Core.program -> Replay.t -> seen:(float * World.vehicle_state) list -> (Entry.t -> unit) -> t
(** [resume program replay ~seen write] goes on with the journal that [replay] has gone through, to its end; [seen] is
    what it says of each vehicle, and when. Nothing is written of what it has. *)

val write : t -> time:float -> (time:float -> Entry.t) -> unit
(** [write r ~time line] writes [line ~time], at [time] or, if that is later, the time of the line before. *)

val transition : t -> time:float -> cause:Transition.event option -> Transition.t -> unit
(** [transition r ~time ~cause t] writes the line of [t], and before it that of the event that caused it, and of
    vehicles what [t] may depend on. *)

val news : t -> time:float -> World.vehicle_state -> unit
(** [news r ~time state] writes what is known of a vehicle now, or keeps it to be written later. *)

val finish : t -> time:float -> stuck:bool -> unit
(** The run is over. With [~stuck:true] its interruption was nobody's wish, but the end of a program that was stuck.
    Nothing is written of a run that did not end: of one that an exception broke. *)
