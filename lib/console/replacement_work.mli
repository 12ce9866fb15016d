(** Another program for the run that goes on: the work of a worker before {!Live_run.replace}. *)

open Dolphin_app
open Dolphin_json
open Exchange

type t = { journal : string;  (** of the run *) program : Program_file.t }

val program : Workspace.t -> set:(string * string) list -> string -> (t, refusal) result
(** [program w ~set path] is the program in a file of the folder, with the parameters [set], by default those of the
    run. Refused with its diagnostics, as ["no-run"], or as ["differs"] with the first line of the journal that no run
    of it has. *)

val differences : Workspace.t -> Field.members -> (json, refusal) result
(** [differences w found] has the texts [before] and [after]: that of the run's program, a member of [found], and that
    of the program whose path is another one, with their included files. *)

val outcome : json -> string
(** [outcome result] is ["holds"], ["violated"] or ["inconclusive"], for the result of [dolphin explore --json]: as its
    exit status. *)

val check : Workspace.t -> Field.members -> (json, refusal) result
(** [check w found] is the order for {!Live_run.replace}: [path], the file, its [hash], and [set]. Refused as
    ["changed"] if the file has no longer the [hash] that a member of [found] has, and as ["too-long"] if the process
    that commands would have to read it for more than half a second. *)
