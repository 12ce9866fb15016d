(** The run of a console: it belongs to the server, and does not depend on the clients that follow it. *)

open Dolphin_app

type t

(** The program, fleet and settings of a run. *)
type order = { program : Program_file.t; fleet : Fleet_file.t; settings : Run.settings }

type operator = { name : string; role : string }
(** An operator with a name. Where one is given below, the journal and the log have its deed before it takes effect. *)

val start : ?by:operator -> id:string -> changed:(unit -> unit) -> journal:string -> order -> t
(** [start ~id ~changed ~journal order] begins the run, which is kept in the file [journal]. [changed] is called
    whenever {!feed} or {!to_json} has changed. *)

val resume : ?by:operator -> id:string -> changed:(unit -> unit) -> journal:string -> order -> t
(** Resumes the run with the journal [journal], after its console died. *)

val enact :
  id:string -> changed:(unit -> unit) -> speed:float option -> Program_file.t -> Fleet_file.t ->
  Dolphin_trace.Witness.t -> t
(** Carries out a counterexample on the simulated fleet, [speed] times as fast as the clock; [None]: as fast as
    it goes. It has no journal. *)

val id : t -> string
(** The identity that {!start} was given. *)

val feed : t -> Feed.t
(** The messages of the run, for clients that follow it. *)

val journal : t -> string option
(** The file that it is kept in. *)

val program : t -> Program_file.t
(** The program that runs. *)

val goes_on : t -> bool
(** Whether it is not over. *)

val now : t -> float
(** Its time, in seconds. *)

val finished : t -> unit Lwt.t
(** Resolves when it is over, and its vehicles are released. *)

val steps : t -> int
(** The number of transitions and of changes of the program since this console began or resumed the run. *)

val after : t -> int -> unit Lwt.t
(** [after r n] resolves when [r] has taken more than [n] {!steps}, or is over. *)

(** The extent of a Stop. *)
type stopping =
  | Next  (** as Ctrl-C does: the program, or, if it is being stopped already, its task of [onInterrupt] *)
  | Program  (** the program alone: nothing if it is being stopped already *)
  | All  (** its task of [onInterrupt], too *)

val stop : ?by:operator -> t -> stopping -> unit
(** [stop r extent] interrupts [r]; without effect on one that is over. *)

val remark : t -> string -> unit
(** A line of its log. *)

val acted : t -> operator option -> Dolphin_trace.Act.deed -> unit
(** [acted r by deed] has the deed of the operator [by] in the journal and in the log, if it has a name. *)

val answer : ?by:operator -> t -> int -> string -> (unit, string) result
(** [answer r n text] answers the question with the number [n]. The error: another client has answered it. *)

val post : ?by:operator -> t -> (string * Dolphin_semantics.Core.value) list -> (float, string) result Lwt.t
(** [post r pairs] posts them, one after the other. It resolves when the run has taken them, and the journal has them:
    to the time then. *)

val replace :
  ?by:operator -> t -> set:(string * string) list -> hash:string -> string ->
  (float, Replacement.refusal) result Lwt.t
(** [replace r ~set ~hash path] is {!Replacement.replace}: [r] goes on with the program in the file [path]. The log has
    the reason of a refusal. *)

val prompt_of : t -> int -> string option
(** [prompt_of r n] is the prompt of the open question with the number [n]. *)

val open_prompts : t -> string list
(** The prompts of the questions of tasks, which {!post} answers. *)

val to_json : addressee:(string -> string option) -> t -> Yojson.Safe.t
(** [to_json ~addressee r] is the state of [r] beside its journal: progress, question, inputs. [addressee prompt] is the
    operators for whom a question is; [None]: for all. *)
