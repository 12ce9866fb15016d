(** Maps that pictures have below the ways of vehicles. *)

val read : string -> (Dolphin_trace.Layer.t, Error.t) result
(** [read path] is the map in the file [path], in any format of {!Dolphin_maps.Map_file}. The error names the file. *)
