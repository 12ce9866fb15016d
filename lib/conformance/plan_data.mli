(** Inline plans, written down whole. *)

val to_json : Dolphin_semantics.Plan.t -> Data.json
val of_json : Data.json -> Dolphin_semantics.Plan.t
(** @raise Data.Wrong if it is none. *)

val position : Data.json -> Dolphin_geo.Position.t
val of_position : Dolphin_geo.Position.t -> Data.json
