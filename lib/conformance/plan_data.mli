(** Inline plans, written down whole. *)

val to_json : Dolphin_semantics.Plan.t -> Data.json
(** The name of the plan, what it says of itself, and its maneuvers in order. *)

val of_json : Data.json -> Dolphin_semantics.Plan.t
(** @raise Data.Wrong if it is none. *)

val position : Data.json -> Dolphin_geo.Position.t
(** A list of latitude, longitude (degrees) and height (metres).
    @raise Data.Wrong if it is none. *)

val of_position : Dolphin_geo.Position.t -> Data.json
(** What {!position} reads. *)
