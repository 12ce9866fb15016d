(** Journals of runs that are over, or broke off, as the messages that {!Live_run} has of its run. *)

open Dolphin_app

val tell : Folder.t -> string -> Narrator.tell -> (unit, Error.t) result
(** [tell folder path tell] gives [tell] the messages of the journal [path], as it reads its lines. The log and the
    waiting are among them if the program that the run had last is in [folder] and has not changed; else there are the
    lines of the journal alone. The error is a line that is not of a journal. *)
