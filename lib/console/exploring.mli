(** [dolphin explore], on behalf of pages: a process of its own, so that nothing else waits for it. *)

open Dolphin_app

type t

val start :
  dolphin:string -> changed:(unit -> unit) -> seconds:int -> Program_file.t -> Fleet_file.t -> t
(** [start ~dolphin ~changed ~seconds program fleet] explores [program] for so many seconds at most, by the command
    [dolphin]. [changed] is called whenever {!to_json} has changed. *)

val goes_on : t -> bool
val cancel : t -> unit

val finished : t -> unit Lwt.t

val to_json : t -> Yojson.Safe.t
(** How it goes; when it is over, the verdicts, as [dolphin explore --json] has them, and the first counterexample step
    by step, each as a line of a journal with the words of the log. *)
