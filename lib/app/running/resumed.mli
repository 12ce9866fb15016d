(** A run whose console died, as far as its journal records it. *)

open Dolphin_trace

type t = {
  path : string;  (** of the journal *)
  past : Dolphin_runtime.Resumption.t;
  summary : Summary.builder;  (** of the lines that are resumed *)
}

val read : changed:bool -> tell:(Entry.t -> Replay.t -> unit) -> Program_file.t -> string -> (t, Error.t) result
(** [read ~changed ~tell program path] reads the journal [path]. [tell] gets each line that is resumed, with its
    result. With [changed] the program need not be the one that ran, if the journal is one of a run of it. The error,
    {!Error.Bad_input}, gives the reason why the run cannot be resumed. *)

val fleet : t -> named:string option -> (Fleet_file.t, Error.t) result
(** [fleet r ~named] is the fleet that the run was on: the file that its header names, or [named], with the same text.
*)
