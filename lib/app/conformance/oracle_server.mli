(** The oracle of the step protocol, on channels. *)

val serve : name:string -> in_channel -> out_channel -> unit
(** [serve ~name input output] answers each line of [input] with a line on [output], until [input] ends
    ({!Dolphin_conformance.Oracle}). A request is at most 64 MB long. *)

val serve_as : Dolphin_conformance.Oracle.t -> in_channel -> out_channel -> unit
(** [serve_as oracle input output] is the same with [oracle]. *)
