(** Inline plans, written down whole. *)

val of_inline : Dolphin_plans.Inline_plan.t -> Data.json
(** Of a plan of maneuvers: its name, its description, and its maneuvers in order. Of a mission, in an object: its
    name, its vehicles and its items in order. *)

val inline : Data.json -> Dolphin_plans.Inline_plan.t
(** @raise Data.Wrong if it is not one. *)

val position : Data.json -> Dolphin_geo.Position.t
(** A list of latitude, longitude (degrees) and height (metres).
    @raise Data.Wrong if it is not one. *)

val of_position : Dolphin_geo.Position.t -> Data.json
(** Reads the output of {!position}. *)
