(** The runner's side of the step protocol: requests to an implementation, and its replies. *)

type json = Yojson.Safe.t
(** JSON of any shape. *)

exception Trouble of string
(** The implementation does not answer, or its answer is not that of the protocol; why, without a full stop. *)

type ask = json -> (json, string) result
(** [ask request] is the reply, or the reason why there is none. *)

(** The present place of a run. *)
type place = { configuration : json; world : json; now : int  (** the date, in seconds *) }

(** A transition that the implementation reports, in the words of the protocol. *)
type transition = {
  event : json option;
  label : string;
  rules : string list;
  effects : json list;
  next : json;
}

(** The transitions from one place. *)
type steps = {
  internal : transition list;  (** leftmost first *)
  caused : transition list;  (** by the events, in their order *)
  awaited : json list;
  refused : string list;  (** why events caused nothing *)
}

(** {1:ask Requests}

    All of these raise {!Trouble}. *)

val hello : ask -> string
(** The name that the implementation gives itself. *)

val initial : ask -> program:string -> fleet:string -> (place, (string * int option) list) result
(** The places where runs begin; or the codes and lines of the errors. *)

val steps : ask -> place -> json list option -> steps
(** [steps ask place events] is the possible steps on [events]; without them, on all awaited ends of tasks and
    timers. *)

val times : ask -> faults:string -> Timed_data.times
(** [times ask ~faults] is the dates of all runs of the program that {!initial} gave, with these faults; [""]: none. *)

val dated : ask -> faults:string -> (int * json) list -> Timed_data.finding list
(** [dated ask ~faults run] is the events that were too early or too late in the run with these events and their
    dates. *)

(** {1:configurations What a configuration shows} *)

val ending : json -> (string * string option) option
(** How the run ended, and its message; [None] before its end. *)

val running : json -> (string * string) list
(** A, by vehicle, sorted. *)

val bound : json -> string list
(** B, in pick order. *)

val pairs : json -> string list
(** N, sorted. *)

val store : json -> (string * string) list
(** The variables that have a value, sorted by name. *)

val key : json -> string
(** Equal for configurations that are equal, in whatever order their members are. *)
