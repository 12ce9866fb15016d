(** The result of [dolphin time], as a picture: for each task a bar from its earliest start to its latest end. *)

module Timed_analysis = Dolphin_time.Timed_analysis

val svg : ?deadline:int -> Program_file.t -> Timed_analysis.outcome -> string
(** A document of its own, in the style of {!Dolphin_trace.Picture}. *)

val html : ?deadline:int -> Program_file.t -> Timed_analysis.outcome -> string
(** The same in a page, with a table of the tasks. *)
