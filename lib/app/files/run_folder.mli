(** The home of journals: the folder [dolphin/runs] in the user's state directory, which [XDG_STATE_HOME] names or is
    [~/.local/state]. *)

open Dolphin_trace

(** How far a run came. *)
type state =
  | Ended of Request.ending
  | Going_on  (** its console lives *)
  | Broken_off  (** its console died, and it was not resumed *)

(** A journal in the folder. *)
type run = {
  name : string;  (** of its file, without the ending [.run] *)
  path : string;
  header : Header.t;
  time : float;  (** of its last line, in seconds since its start *)
  state : state;
}

val fresh : program:string -> (string, Error.t) result
(** [fresh ~program] is the path of a new journal of a run of [program] that starts now: of a file that is there from
    now on, empty, and removed when the process ends if it still is. The folder is made if it is not there. The
    error, {!Error.Unavailable}, gives the reason. *)

val beside : string -> (string, Error.t) result
(** [beside name] is the folder [name] beside that of the journals, which is made if it does not exist. *)

val writable : unit -> (string, Error.t) result
(** The folder, which may be yet to be made, if it can be written to. *)

val list : ?except:string -> unit -> (run list, Error.t) result
(** The runs in the folder, latest first, but for the one with the path [except], which this process writes: to read
    it would give its lock away. Files that are not journals are left out; a folder that does not exist yet has none.
    The error, {!Error.Unavailable}, gives the reason: the folder is not named, or it cannot be read. *)

val find : string -> (string, Error.t) result
(** [find name] is the path of the run of this name, or of the only one whose name begins so; [find "latest"] is that
    of the latest. The error reports that there is no such run, or several, or is that of {!list}. *)

val journal : string -> (string, Error.t) result
(** [journal name] is the path of a journal: [name] itself if it has a folder or there is such a file, else {!find}
    [name]. *)
