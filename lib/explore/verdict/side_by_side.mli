(** Plans that run at the same time, on different vehicles, and the known distance between their ways
    ({!Dolphin_plans.Fences.near}). Ways to plans are left aside: they begin wherever vehicles are.

    docs/explorer.md describes how they are found. *)

open Dolphin_plans
open Dolphin_semantics

(** How near two plans come. *)
type nearness =
  | Near of Fences.near  (** nearer than the least distance *)
  | Unknown  (** the way of one of them is unknown: vehicles know it by name, or it depends on their positions *)

(** Two plans that run at the same time in some run, each with its vehicle. *)
type pair = {
  one : Core.vehicle * Core.platform_task;
  other : Core.vehicle * Core.platform_task;  (** of no lesser site *)
  nearness : nearness;
}

val name : Core.platform_task -> string
(** ["'survey'"], as plans are called in reports. *)

(** {1 Watching states} *)

type t
(** The pairs seen so far. *)

val create : Fences.t -> t
(** [create fences] has seen no pair. *)

val see : t -> Core.platform_task Vehicle_map.t -> unit
(** [see t a] takes note of all that run at the same time, each on its vehicle. *)

val pairs : t -> pair list
(** Those that were seen and are [Near] or [Unknown], each pair of plans once, with the vehicles that it was seen on
    first; those that are [Near] before the others, by their sites. *)

val first_near : t -> bool
(** Whether one of {!pairs} is [Near]. *)

(** {1 Candidates} *)

val candidates : t -> int
(** How many {!pairs} there would be if all that were seen ran at the same time. *)

val seen_all : candidates:int -> t -> bool
(** Whether {!pairs} has this many members. *)
