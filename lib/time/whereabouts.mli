(** Where a vehicle is, as far as that is known without the moment at which its plan was stopped: within a distance of a
    place. docs/time.md, "Where vehicles are". *)

open Dolphin_plans
open Dolphin_geo

type t = private {
  centre : Position.t;
  within : float;  (** metres from the centre at most, over ground; 0: it is there *)
}

val at : Position.t -> t
(** [at p] is the place [p] itself. *)

val after : t option -> Inline_plan.t -> t option
(** [after here p] is where a vehicle is that was [here], or wherever, and has done [p]. *)

val along : t option -> Inline_plan.t -> t option
(** [along here p] is where a vehicle is that was [here] and has done some part of [p]: anywhere on its way. It is
    [here] again if the way lies within it. So finitely many plans with places have finitely many whereabouts. *)

val moving : t -> speed:float -> pace:(Inline_plan.leg -> float) -> Inline_plan.t -> (float * float) option
(** [moving here ~speed ~pace p] is the least and the greatest number of seconds under way in [p] from [here] until the
    first stay without end, each leg at its [pace] in metres a second; [speed] is that of legs without one in
    {!Inline_plan.path}. [None] if that is not known, for the way of [p] depends on the place where it begins. *)
