(** Cases of the corpus: a program in its world, and the expected results. [conformance/INTERPRETING.md] describes
    the file member by member. *)

(** A step of a trace, as far as it is known. [None] is not compared. *)
type seen = {
  label : string;
  event : Yojson.Safe.t option;  (** that causes it; [None]: it happens by itself *)
  world : Yojson.Safe.t option;  (** the known state of vehicles from this step on *)
  now : int option;  (** the date from this step on *)
  rule : string list option;
  effects : Yojson.Safe.t list option;
  running : (string * string) list option;  (** A after it *)
  bound : string list option;  (** B after it *)
  pairs : string list option;  (** N after it, sorted *)
  store : (string * string) list option;  (** some of the variables after it *)
  ending : (string * string option) option;  (** how the run ended with it, and the message, if that is known *)
}

(** A step of a trace in a case. *)
type step =
  | Until of string  (** on, leftmost first, until a step with this label has been made *)
  | Step of seen

(** How a run ends, in words of [conformance/INTERPRETING.md]. *)
type outcome = { how : string; message : string option; left : string list  (** of N, sorted *) }

(** An expected result; [conformance/INTERPRETING.md] describes each kind. *)
type expectation =
  | Rejected of (string * int option) list  (** codes, with the line if it matters, sorted *)
  | Trace of step list
  | Outcomes of outcome list
  | Deadlock of bool
  | Admits of step list
  | Forbids of step list
  | Times of Timed_data.times
  | Dated of { run : (int * Yojson.Safe.t) list; findings : Timed_data.finding list }

(** The environment of a program all of whose runs are explored. *)
type environment = {
  fails : string list;  (** plans that always fail *)
  may_fail : string list;
  answers : (string * string list) list;  (** the possible answers, by prompt; other prompts stay unanswered *)
  replies : Yojson.Safe.t list;  (** the possible replies of the host; without any, it fails *)
  interruption : bool;
  faults : string;  (** as in [dolphin time --faults], for times *)
}

type t = {
  path : string;
  title : string;
  covers : string list;  (** rules *)
  program : string;
  fleet : string;
  environment : environment;
  expectations : expectation list;
  fails : string list;  (** the faults that a right runner finds; [[]] for a right case *)
}

val kind : expectation -> string
(** Its name in the file: ["trace"]. *)

val of_string : path:string -> string -> (t, string) result
(** [of_string ~path text] is the case that [text] is, or what is wrong with it in a sentence without a full stop.
    Members that are not known are errors: a misspelt expectation would expect nothing. *)
