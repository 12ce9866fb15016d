(** Runs that were: those that are kept, and the journals of the folder. *)

open Dolphin_json
open Exchange
module Request = Dolphin_http.Request

val list : Workspace.t -> Request.t -> (json, refusal) result
(** [GET runs]. *)

(** A run whose console died. *)
type broken_off = {
  path : string;  (** of the program, in the folder *)
  journal : string;
  set : (string * string) list;
  speed : float option;
}

val broken_off : Workspace.t -> Field.members -> (json, refusal) result
(** [broken_off w found] is the run that [POST run/resume] names, in JSON. *)

val of_json : Field.members -> (broken_off, refusal) result
(** The result of {!broken_off}. *)

val journal : Workspace.t -> run:string option -> path:string option -> (string, refusal) result
(** [journal w ~run ~path] is the file of the kept run [run], or of the journal [path] of the folder. *)

val check : Workspace.t -> Request.t -> (json, refusal) result
(** [check w r] is the file [journal] of the run that [GET replay] names, if its first line is that of a journal. *)

val replay : Workspace.t -> Request.t -> (string -> unit) -> unit
(** [replay w r write] gives [write] the messages of the file [journal] of [r], piece by piece, as it reads the lines:
    {!Past_run.tell}, and at last [end], or [failed] with a message. *)
