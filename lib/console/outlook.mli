(** What may still happen in the run of a console: when it will be over, and what may go wrong. It is computed from the
    run's journal whenever the run has gone on, by {!Outlook_work} in a process beside. The run is not affected. *)

type t

val follow : dolphin:string -> changed:(unit -> unit) -> workspace:(unit -> Workspace.t) -> Live_run.t -> t
(** [follow ~dolphin ~changed ~workspace run] begins. Workers are processes of the command [dolphin]; [changed] is
    called whenever {!to_json} has changed. It ends with [run]. *)

val to_json : t -> Yojson.Safe.t
(** The latest reply of {!Outlook_work.compute}, or an object with its [error]; [null] before the first, and once the
    run is over. *)

val pids : t -> int list
(** The processes that there are. *)

val close : t -> unit
(** Ends it, with its processes. *)
