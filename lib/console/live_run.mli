(** The run of a console: it belongs to the server, whoever looks on. *)

open Dolphin_app

type t

(** What a run is started with. *)
type order = { program : Program_file.t; fleet : Fleet_file.t; settings : Run.settings }

val start : id:string -> changed:(unit -> unit) -> journal:string -> order -> t
(** [start ~id ~changed ~journal order] begins the run, which is kept in the file [journal]. [changed] is called
    whenever {!feed} or {!to_json} has changed. *)

val resume : id:string -> changed:(unit -> unit) -> journal:string -> order -> t
(** Likewise goes on with the run whose journal is [journal], and whose console died. *)

val enact :
  id:string -> changed:(unit -> unit) -> speed:float option -> Program_file.t -> Fleet_file.t ->
  Dolphin_trace.Witness.t -> t
(** Likewise carries out a counterexample on the simulated fleet, [speed] times as fast as the clock; [None]: as fast as
    it goes. It has no journal. *)

val id : t -> string
val feed : t -> Feed.t
val journal : t -> string option
(** The file that it is kept in. *)

val program : t -> Program_file.t

val goes_on : t -> bool

val now : t -> float
(** Its time, in seconds. *)

val finished : t -> unit Lwt.t
(** Resolves when it is over, and its vehicles are released. *)

(** What a Stop ends. *)
type stopping =
  | Next  (** as Ctrl-C does: the program, or, if it is being stopped already, what it executes by [onInterrupt] *)
  | Program  (** the program alone: nothing if it is being stopped already *)
  | All  (** what it executes by [onInterrupt], too *)

val stop : t -> stopping -> unit

val remark : t -> string -> unit
(** A line of its log. *)

val answer : t -> int -> string -> (unit, string) result
(** [answer r n text] answers the question with the number [n]; or says why not: somebody else did. *)

val post : t -> (string * Dolphin_semantics.Core.value) list -> (float, string) result Lwt.t
(** [post r pairs] posts them, one after the other. It resolves when the run has taken them, and the journal has them:
    to the time then. *)

val to_json : t -> Yojson.Safe.t
(** What stands beside the journal: how it goes on, its question, what may be posted. *)
