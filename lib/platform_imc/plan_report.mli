(** The content of one PlanControlState about the vehicle's plan. *)

open Dolphin_imc

type t = {
  sent : float;  (** when, by the vehicle's clock as {!Vehicle_clock.observe} returns it (s) *)
  state : Message.Plan_control_state.t;
}

val names : string -> t -> bool
(** [names plan r] is whether [r] is about [plan]. *)

val is_busy : t -> bool
(** Whether the vehicle is in a state in which a plan that runs, or has just been taken, is seen: EXECUTING or
    INITIALIZING. *)

val succeeded : t -> bool
(** Whether the last outcome is SUCCESS. *)

val failed : t -> bool
(** Whether the last outcome is FAILURE. *)
