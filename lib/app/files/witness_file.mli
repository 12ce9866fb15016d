(** Files with a recorded run of a program in the world of a fleet: {!Dolphin_trace.Witness}. *)

open Dolphin_semantics

(** A recorded run. *)
type run = {
  breaks : string;  (** the property that it breaks; [""] if it was not recorded for one *)
  description : string;  (** its contents, in a line *)
  steps : Transition.t list;
  cycle : Transition.t list;  (** repeats without end after the steps; empty if the run ends *)
}

val write : Program_file.t -> Fleet_file.t -> string -> run -> (unit, Error.t) result
(** [write program fleet path run] writes [run] into the file [path], in the Informal Trace Format if its name ends in
    [.itf.json], and else as {!read} reads it. *)

val draw : Program_file.t -> Fleet_file.t -> Drawing.t -> run -> (unit, Error.t) result
(** [draw program fleet drawing run] draws [run]: as that of a journal, by steps instead of time. *)

val read : string -> (Dolphin_trace.Witness.t, Error.t) result
(** [read path] is the run that the file [path] records. The error is {!Error.Bad_input}: the run does not exist. *)

val settings : string -> (string * string) list option
(** [settings path] is the parameters that the run in the file [path] was found with; [None] if it cannot be read. *)
