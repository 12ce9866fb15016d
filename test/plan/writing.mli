(** Settings as tests write them, and the results of {!Dolphin_semantics.Plan_builder} for them. *)

open Dolphin_plans
open Dolphin_semantics
open Core

val case : string -> (unit -> unit) -> unit Alcotest.test_case

(** {1 Values} *)

val i : int -> value
val n : float -> value
val str : string -> value
val sym : string -> value
val items : value list -> value

(** {1 Settings} *)

val set : ?named:(string * value) list -> string -> value list -> setting

val man : string -> (string * value) list -> setting
(** A maneuver with named arguments. *)

val go : setting
(** [goTo] without arguments. *)

val plan_site : site
(** The place of the plans of {!build}. *)

val build : ?name:string -> ?place:Dolphin_geo.Position.t option -> setting list -> (Plan.t, Fault.t) result
(** [build settings] is the plan called ["p"]; the site of each setting is its place in the list. [place] is its
    beginning, by default [Place.apdl]. *)

val built : setting list -> Plan.t
(** [built settings] is that plan; a fault fails the test. *)
