(** Blocks of settings read into their results: the vehicles that [pick] asks for, positions, choices. Inline plans
    are {!Plan_builder}'s. *)

open Core

(** Which vehicles a pick accepts. *)
type filter = Vehicle_filter.t = {
  id : string option;
  kind : string option;  (** [type 'UUV'] *)
  payload : string list;
  region : Dolphin_geo.Area.t option;
}

(** The number of vehicles that a [pick] asks for. *)
type count = Exactly of int | All  (** [count _] *)

(** The contents of a [pick] block. *)
type pick = {
  filter : filter;
  count : count;
  timeout : float option;  (** seconds *)
  otherwise : bool;  (** with too few vehicles the script goes on, with null *)
}

val accepts : filter -> World.vehicle_state -> bool
(** [accepts f s] is whether a connected vehicle in state [s] fulfils [f]. *)

val pp_filter : Format.formatter -> filter -> unit
(** [" of type 'UAV'"], each part behind a space. *)

val pp_pick : Format.formatter -> pick -> unit
(** The request: ["3 of type 'UUV' with DVL"]. *)

val compare_pick : pick -> pick -> int
(** A total order. *)

val pick : setting list -> (pick, Fault.t) result
(** [pick settings] is the pick that [settings] (first one first) ask for: one vehicle by default. An id is compared
    as plain text, after its backslashes are taken as escapes. *)

val position : site -> setting list -> (value, Fault.t) result
(** [position site settings] is the position that [pos { ... }] at [site] makes of its settings. *)

val branches : site -> setting list -> (branch list, Fault.t) result
(** [branches site settings] is the branches of an [allOf] or [oneOf] at [site], in the order of the text. *)
