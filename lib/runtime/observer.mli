(** Observers of a run: the journal, the log, a display. *)

open Dolphin_semantics

type t = {
  transition : time:float -> cause:Transition.event option -> Transition.t -> unit;
  (** The run takes this transition: on the event [cause], or with [None] by itself. Called before its effects are
      carried out, so that the record always covers the commands to vehicles. *)
  news : time:float -> World.vehicle_state -> unit;  (** The platform reported this of a vehicle. *)
  unknown : time:float -> Fault.t -> unit;
  (** A guard needs a value that a vehicle has not reported, and does not hold: reported once for each place and
      vehicle. *)
}
(** [time] is the platform's. An exception that an observer raises ends the run: see {!Driver.run}. *)

val nobody : t
(** Looks at nothing. *)

val both : t -> t -> t
(** [both a b] calls [a], then [b]. *)
