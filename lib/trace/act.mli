(** Acts of operators on a run, by name. They mean nothing to the semantics: a run with them is the same without. *)

(** What an operator did. *)
type deed =
  | Start
  | Resume
  | Answer of { question : string;  (** its prompt *) text : string }
  | Post of string  (** the pair, ["ready:1"] *)
  | Replace of string  (** the run is to go on with the program in this file *)
  | Stop of { all : bool }  (** [all]: the task of [onInterrupt], too *)
  | Take_helm of string option  (** from the operator who had it *)
  | Leave_helm  (** to no other operator *)
  | Shut_out of string  (** this operator, until the console is started again *)

type t = { operator : string;  (** the name *) role : string; deed : deed }

val fields : (t, t) Dolphin_json.Codec.fields
(** The members that an act is written as. *)

val words : t -> string
(** ["ana (steer) answers 'Begin now?': yes"]. *)
