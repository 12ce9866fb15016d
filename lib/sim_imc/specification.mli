(** Plans as vehicles receive them, PlanSpecification, in a form that can be flown. *)

open Dolphin_imc

type t = {
  plan : Dolphin_plans.Plan.t;
  (** Of payloads and vehicles nothing is in it: the vehicle is already chosen. A plan whose transitions run in a circle
      ends by keeping station for good where the circle closes. *)
  kinds : int list;  (** The number of the message of each maneuver of [plan]. *)
}

val read : Message.t Message.Plan_specification.t -> (t, string) result
(** [read s] is the maneuvers of [s] in the order in which a vehicle carries them out: from the initial one, always
    along the first of the transitions out of it, with any condition, up to [_done_] or to one without a transition.

    The error is in a vehicle's own words, ["parse error: 1: maneuver is not supported"]: for maneuvers that
    {!Dolphin_plans.Plan} does not have, for numbers that make no sense, for depths beyond {!deepest}, for a
    maneuver that no transition leads to. *)

val of_maneuver : plan:string -> Message.Maneuver.t -> Message.t Message.Plan_specification.t
(** [of_maneuver ~plan m] is the plan named [plan] of [m] only. *)

val deepest : float
(** 100 m. *)
