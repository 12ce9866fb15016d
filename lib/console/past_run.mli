(** Journals of runs that are over, or broke off, told as {!Live_run} tells of its run. *)

open Dolphin_app

val tell : Folder.t -> id:string -> string -> (Feed.t, Error.t) result
(** [tell folder ~id path] is all that there is to tell of the journal [path]. The log and what the program waited for
    are part of it if the program that its header names is in [folder] and has not changed; else it has the lines of the
    journal alone. The feed is the caller's to close. *)
