(** The result of [dolphin exec --runs], as a picture: when runs that complete are over, with their number in each
    span of time. *)

val svg : Program_file.t -> Sampling.t -> string
(** A document of its own, in the style of {!Dolphin_trace.Picture}. *)

val html : Program_file.t -> Sampling.t -> string
(** The same in a page, with a table of the ways in which runs ended. *)
