(** The progress of vehicles in their plans, for programs that ask for it: computed from the places where they are seen,
    so for vehicles of all platforms. *)

open Dolphin_semantics

val is_asked_for : Core.program -> bool
(** [is_asked_for p] is whether some code of [p] looks at progress, by [progress(v)] or [p.rest(v)]. *)

type t

val none : t
(** No vehicle is under way. *)

val resume : at:float -> World.t -> Core.platform_task Vehicle_map.t -> t
(** [resume ~at w a] is that of a run that goes on: vehicles run the tasks of [a], and were seen last as [w] has them,
    about the second [at] of the run. *)

val start : World.vehicle_state -> Core.platform_task -> t -> t
(** [start s p x] is [x] once the vehicle of [s] begins [p]. *)

val finish : Core.vehicle -> t -> t
(** [finish v x] is [x] once [v] has done its plan. *)

val stop : Core.vehicle -> t -> t
(** [stop v x] is [x] once [v] was stopped, or failed: later reports change nothing. So the rest does a second or two
    of its way again, the time between two reports. *)

val see : at:float -> World.vehicle_state -> t -> t * World.vehicle_state
(** [see ~at s x] is [x] once the report [s] was received at that second of the run, and [s] with its progress. The
    report that a link is lost has an earlier place, and changes nothing. *)
