(** Who keeps vehicles to a program's fences: what is known of them, and what must not go on. Pure; {!Fenced} is the
    shell around it. *)

open Dolphin_semantics

type t

val make : Fences.t -> t
(** Nothing is known of any vehicle. *)

val watches : t -> bool
(** Whether it matters where vehicles are while plans run: unless there are no fences. *)

val see : World.vehicle_state -> t -> t
(** Where that vehicle is now. *)

val start : Core.vehicle -> Core.platform_task -> t -> (t, string) result
(** [start v task g] is [g] once [v] has set out on [task]; or why it must not: which fence the plan breaks, where and
    by how much, or which vehicle under way it comes too near to. Of a plan that vehicles know by name only, nothing is
    known before it runs. *)

val over : Core.vehicle -> t -> t
(** The vehicle's task is over, or it was told to stop. *)

val is_under_way : Core.vehicle -> t -> bool
(** Whether it has set out on a task that is not over. *)

val breaking : Core.vehicle -> t -> (Core.vehicle * string) list
(** [breaking v g] is, if [v] is under way, the vehicles under way that break a fence because [v] is where it is: [v]
    itself, or both of two that are too near to each other; each with what is to be said. Who has set out from beyond a
    fence may come back ({!Fences.of_vehicle}). *)

(** {1 Resumption} *)

type past = {
  guard : t;
  history : History.t;  (** what the platform was asked for, and what it has told *)
  untold : (Core.vehicle * string) list;  (** vehicles whose tasks have failed at a fence, and nobody was told *)
}

val replay : Fences.t -> History.t -> past
(** [replay fences history] is how a run went on its platform that has the [history], as its journal has it. *)
