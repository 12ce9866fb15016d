(** Cases of the corpus: a program in its world, and what must be so. [conformance/INTERPRETING.md] describes the file
    member by member. *)

(** What is known of a step that a trace has. What is [None] is not compared. *)
type seen = {
  label : string;
  event : Yojson.Safe.t option;  (** that causes it; [None]: it happens by itself *)
  world : Yojson.Safe.t option;  (** what is known of vehicles from this step on *)
  now : int option;  (** the date from this step on *)
  rule : string list option;
  effects : Yojson.Safe.t list option;
  running : (string * string) list option;  (** A after it *)
  bound : string list option;  (** B after it *)
  pairs : string list option;  (** N after it, sorted *)
  store : (string * string) list option;  (** some of the variables after it *)
  ending : (string * string option) option;  (** how the run ended with it, and the message, if that is known *)
}

type step =
  | Until of string  (** on, leftmost first, until a step with this label has been made *)
  | Step of seen

type outcome = { how : string; message : string option; left : string list  (** of N, sorted *) }

type expectation =
  | Rejected of (string * int option) list  (** codes, with the line if it matters, sorted *)
  | Trace of step list
  | Outcomes of outcome list
  | Deadlock of bool
  | Admits of step list
  | Forbids of step list
  | Times of Timed_data.times
  | Dated of { run : (int * Yojson.Safe.t) list; findings : Timed_data.finding list }

(** What may happen around a program all of whose runs are explored. *)
type environment = {
  fails : string list;  (** plans that always fail *)
  may_fail : string list;
  answers : (string * string list) list;  (** what may be answered, by prompt; nobody answers others *)
  replies : Yojson.Safe.t list;  (** what the host may reply; none: it fails *)
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
  fails : string list;  (** what a right runner finds wrong; [[]] for what is right *)
}

val kind : expectation -> string
(** Its name in the file: ["trace"]. *)

val of_string : path:string -> string -> (t, string) result
(** [of_string ~path text] is the case that [text] is, or what is wrong with it in a sentence without a full stop.
    Members that are not known are errors: a misspelt expectation would expect nothing. *)
