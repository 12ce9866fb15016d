(** Makes the journal of a run from the calls that a {!Dolphin_runtime.Observer} gets.

    News of a vehicle become a line at once if the vehicle is new or its link came or went. New positions and battery
    levels become one only every few seconds or every ten metres, or before a transition that may depend on them. So at
    each transition the journal has all that the program could know of vehicles. *)

open Dolphin_semantics

type t

val make : ?period:float -> Core.program -> Header.t -> (Entry.t -> unit) -> t
(** [make ~period program header write] gives [header] and then the lines of a run of [program] to [write], in order. A
    vehicle's samples are at most about [period] seconds apart, by default 5. An exception of [write] is raised by
    the functions below. *)

val resume :
  ?period:float -> Core.program -> Replay.t -> seen:(float * World.vehicle_state) list -> (Entry.t -> unit) -> t
(** [resume program replay ~seen write] continues the journal that [replay] has read to its end; [seen] is its state
    of each vehicle, with the time. Lines of the journal are not written again. *)

val write : t -> time:float -> (time:float -> Entry.t) -> unit
(** [write r ~time line] writes [line ~time], at [time] or, if that is later, the time of the line before. *)

val transition :
  ?unasked:(unit -> bool) -> t -> time:float -> cause:Transition.event option -> Transition.t -> unit
(** [transition r ~time ~cause t] writes the line of [t], and before it that of the event that caused it, and of
    vehicles what [t] may depend on. An interruption while [unasked ()], which by default is false, is that of a
    program that is stuck. *)

val news : t -> time:float -> World.vehicle_state -> unit
(** [news r ~time state] writes what is known of a vehicle now, or keeps it to be written later. *)

val replace : t -> time:float -> Core.program -> line:(time:float -> Entry.t) -> Replay.t -> unit
(** [replace r ~time program ~line replay] writes [line], at [time] or later as {!write} does; from then on the run is
    one of [program], whose configuration is that of [replay], which has read the journal so far. *)

val finish : t -> time:float -> stuck:bool -> unit
(** The run is over. With [~stuck:true] its interruption was the end of a stuck program, and not a person's wish.
    Nothing is written of a run that did not end: of one that an exception broke. *)
