(** The meaning of TLC's messages. The codes are those of its class [EC], of TLC 2.18; a message with another code is
    {!Trouble} if TLC calls it an error, and otherwise {!Other}. *)

(** The thing that a counterexample violates. *)
type violation =
  | Invariant of string  (** its name in the configuration *)
  | Property of string  (** a property of single steps, by its name *)
  | Temporal  (** some property in the configuration: TLC does not name it *)
  | Deadlock
  | Unnamed  (** the server of the distributed mode does not name the violated property, see {!Behaviour} *)

type t =
  | Version of string  (** ["TLC2 Version 2.18 of 20 March 2023"] *)
  | Begins of string  (** how it searches: workers, memory *)
  | Initial_states of int
  | Progress of { depth : int; generated : int; distinct : int; queue : int }
  (** [depth] counts states: 1 for the initial ones *)
  | Checks_temporal of int  (** the temporal properties, on this number of states *)
  | Violation of violation
  | Behaviour  (** a counter-example follows *)
  | State of { number : int; action : string option; text : string }
  (** of a counter-example, numbered from 1: the action that led there, unless it is an initial state; the text of the
      variables, [/\ x = 1] and so on *)
  | Stutters  (** the counterexample stays in its last state *)
  | Returns_to of int  (** the counterexample goes on from its last state to this one, again and again *)
  | Holds  (** no error was found *)
  | Totals of { generated : int; distinct : int; queue : int }
  | Depth of int  (** of the complete state graph, in states: 1 if there are only initial ones *)
  | Printed of string  (** a line outside of messages, by the model, SANY or Java *)
  | Worker of string  (** a server's line about workers and fingerprint servers *)
  | Assertion of string  (** the model's own, which does not hold: its text *)
  | Trouble of string
  | Warning of string
  | Other

val of_message : Message.t -> t
(** [of_message m] is the meaning of [m]. *)

val variable : string -> string -> string option
(** [variable x text] is the value of the variable [x], as TLC prints it, in the text of a {!State}, if it stands on
    one line. *)

val number_after : string -> string -> int option
(** [number_after part text] is the number that begins where [part] first ends in [text]. *)
