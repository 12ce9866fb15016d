(** Plans that may run side by side, near each other, in reports. *)

module Side_by_side := Dolphin_explore.Side_by_side

val print : Program_file.t -> Side_by_side.pair list -> unit
(** A line for each, after an empty one; nothing without any. *)

val json : Program_file.t -> Side_by_side.pair list -> Yojson.Safe.t
(** The pairs for programs: an array, with an object for each. *)
