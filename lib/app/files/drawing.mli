(** The files that runs are drawn in. *)

type t

val of_path : string -> (t, string) result
(** [of_path path] is the picture in the file [path], whose name ends in [.svg] or [.html]. The error reports that it
    does not. *)

val over : Dolphin_trace.Layer.t list -> t -> t
(** [over layers d] is [d] with [layers] below the ways of the run. *)

val path : t -> string
(** The path of the file. *)

val check : t -> (unit, Error.t) result
(** [check d] fails if it is clear already that [d] cannot be written. It writes nothing. *)

val write_text : t -> svg:(unit -> string) -> html:(unit -> string) -> (unit, Error.t) result
(** [write_text d ~svg ~html] writes the text of the one or the other. *)

val write : t -> Dolphin_trace.Summary.t -> (unit, Error.t) result
(** [write d run] draws [run], on the layers of [d]. *)
