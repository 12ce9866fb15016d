(** The guard of a program's fences: the known state of vehicles, and the tasks that must not go on. Pure; {!Fenced}
    is the shell around it. *)

open Dolphin_plans
open Dolphin_semantics

type t

val make : Fences.t -> t
(** Nothing is known of any vehicle. *)

val watches : t -> bool
(** Whether the places of vehicles matter while plans run: if the program has fences. *)

val see : World.vehicle_state -> t -> t
(** The present place of that vehicle. *)

val start : Core.vehicle -> Core.platform_task -> t -> (t, string) result
(** [start v task g] is [g] once [v] has set out on [task]; or the reason why it must not: the fence that the plan
    breaks, with place and metres, or the vehicle under way that it comes too near to. Of a plan that vehicles know
    by name only, nothing is known before it runs. *)

val over : Core.vehicle -> t -> t
(** The vehicle's task is over, or it was ordered to stop. *)

val is_under_way : Core.vehicle -> t -> bool
(** Whether it has set out on a task that is not over. *)

val breaking : Core.vehicle -> t -> (Core.vehicle * string) list
(** [breaking v g] is, if [v] is under way, the vehicles under way that break a fence at the present place of [v]:
    [v] itself, or both of two that are too near to each other; each with its message. A vehicle that has set out
    from beyond a fence may come back ({!Fences.of_vehicle}). *)

(** {1 Resumption} *)

(** The guard of a run so far, and the part of its history that concerns the platform. *)
type past = {
  guard : t;
  history : History.t;  (** the requests to the platform, and its reports *)
  untold : (Core.vehicle * string) list;  (** vehicles whose tasks have failed at a fence, not reported yet *)
}

val replay : Fences.t -> History.t -> past
(** [replay fences history] is how a run went on its platform that has the [history], as its journal has it. *)
