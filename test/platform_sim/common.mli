(** Functions shared by the tests of {!Dolphin_platform_sim}. *)

open Dolphin_plans
open Dolphin_semantics

val case : string -> (unit -> unit) -> unit Alcotest.test_case

val law :
  ?count:int -> string -> print:('a -> string) -> 'a QCheck2.Gen.t -> ('a -> bool) -> unit Alcotest.test_case

val scenario : string -> Dolphin_scenario.Scenario.t
(** From the text of a fleet. *)

val crowd : int -> Dolphin_scenario.Scenario.t
(** This number of vehicles, [v0], [v1] and on, and no plans. *)

val task : ?plan:Plan.t -> string -> Core.platform_task

val go_to : ?speed:float -> ?dwell:float -> Dolphin_geo.Position.t list -> Plan.t
(** Goes through these places at [speed] m/s, or the vehicle's own, and keeps station for [dwell] seconds at the end. *)

val show : Dolphin_runtime.Platform.event -> string
(** ["a done"], ["a failed: why"], ["timer 3"], ["a seen"], ["a unseen"]. *)
