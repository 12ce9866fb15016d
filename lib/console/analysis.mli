(** What is found out about a program on behalf of pages, without running it: by another command of [dolphin] in a
    process of its own, so that nothing else waits for it. *)

open Dolphin_app

(** What is asked. *)
type kind =
  | Exploration  (** [dolphin explore] *)
  | Timing of { deadline : string option }  (** [dolphin time] *)
  | Graph of { states : int }  (** [dolphin lts], of at most so many states *)

type order = { kind : kind; faults : string option;  (** as of [--faults] *) seconds : int  (** at most *) }

type t

val inputs : Program_file.t -> Fleet_file.t -> string list
(** [inputs program fleet] is the arguments that name both, with the program's parameters, to any command of [dolphin]:
    its last ones. *)

val start : dolphin:string -> changed:(unit -> unit) -> order -> Program_file.t -> Fleet_file.t -> t
(** [start ~dolphin ~changed order program fleet] asks the command [dolphin]. [changed] is called whenever {!to_json}
    has changed. *)

val goes_on : t -> bool
val cancel : t -> unit

val finished : t -> unit Lwt.t

val shown : t -> (Program_file.t * Fleet_file.t * Dolphin_trace.Witness.t) option
(** The run that it shows, a counterexample perhaps, with the program and the fleet as they were then. *)

val program : t -> Program_file.t

val to_json : t -> Yojson.Safe.t
(** How it goes, and the hash of the program's file as it was read; when it is over, the result as the command has it
    with [--json], and the run that it shows step by step, each as a line of a journal with the words of the log. *)
