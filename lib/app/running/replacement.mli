(** Another program for a run that goes on. The run so far has to be the beginning of a run of that program, too: the
    journal is read again with it. Vehicles are not commanded by the change itself. *)

open Dolphin_runtime
open Dolphin_trace

(** The run. *)
type run = {
  fleet : Fleet_file.t;  (** whose fences and place of plans hold for the new program, too *)
  recording : Recording.t;
  now : unit -> float;  (** seconds since the start *)
  took : Program_file.t -> Replay.t -> unit;
  (** is called at the change, with the new program, and the journal as read with it *)
}

type t

val make : run -> Program_file.t -> t
(** [make run program] is for a run of [program]. *)

val program : t -> Program_file.t
(** The program that runs now. *)

val inbox : t -> (unit -> Driver.replacement option) Lwt_mvar.t
(** The argument [replacements] of {!Driver.run}. *)

(** The reason why a run goes on with its program. *)
type refusal =
  | Busy  (** another replacement is being checked *)
  | No_journal
  | Wrong_program of string
  (** the file cannot be read or has errors, is not the one that was meant, or has other fences *)
  | Differs of string  (** the first line of the journal that no run of the program has *)
  | Over  (** the run ended before *)

val message : refusal -> string
(** One sentence without a full stop, and perhaps further lines. *)

val replace : t -> ?set:(string * string) list -> ?hash:string -> string -> (float, refusal) result Lwt.t
(** [replace t ~set ~hash path] makes the run go on with the program in the file [path], with parameters [set] (by
    default those of the present program), as soon as the run waits for an event, and resolves to the time when it does.
    With [hash], that of {!Program_file.header}, a file that has changed since is refused. The journal is read in parts,
    between which the run goes on. *)

val refused : ?set:(string * string) list -> ?hash:string -> string -> (float, refusal) result Lwt.t
(** {!replace} of a run that has not begun, or is over. *)

val close : t -> unit
(** The run is over. *)
