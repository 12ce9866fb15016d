(** Who watches a run: the journal, the log, a display. *)

open Dolphin_semantics

type t = {
  transition : time:float -> cause:Transition.event option -> Transition.t -> unit;
  (** The run takes this transition: on the event [cause], or with [None] by itself. Told before its effects are carried
      out, so that what is on record is never less than what vehicles were asked to do. *)
  news : time:float -> World.vehicle_state -> unit;  (** The platform told this of a vehicle. *)
  unknown : time:float -> Fault.t -> unit;
  (** A guard needs what a vehicle has not told, and does not hold: said once of each place and vehicle. *)
}
(** [time] is the platform's. An exception that an observer raises ends the run: see {!Driver.run}. *)

val nobody : t
(** Looks at nothing. *)

val both : t -> t -> t
(** [both a b] tells [a], then [b]. *)
