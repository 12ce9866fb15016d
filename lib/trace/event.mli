(** The events from outside, as journals have them: the events of {!Dolphin_semantics.Transition.event}. *)

open Dolphin_semantics

type t =
  | Done of string
  | Failed of { vehicle : string; why : string }
  | Timer of int
  | Confirmation of { question : int; yes : bool }  (** of a task's question *)
  | No_confirmation of { question : int; why : string }
  | Recruited of { recruit : int; vehicle : string }  (** for a task's [recruit], by its number *)
  | Answer of string
  | No_answer of string
  | Reply of Yojson.Safe.t  (** a value as {!Dolphin_json.Host_value} writes it *)
  | No_reply of string
  | Input of { key : string; value : Yojson.Safe.t }
  | Interruption of { stuck : bool }  (** [stuck]: by the driver, as the program could not go on *)

val of_event : ?stuck:bool -> Transition.event -> t
(** [of_event ~stuck e] is [e]; an interruption is [stuck], by default not.

     @raise Invalid_argument for a reply that no host process can give: a closure, for example. *)

(** Why one is not an event for the transition function. *)
type fault =
  | No_value of string  (** the reply is not a value: why *)
  | Refused of Transition.refusal  (** it is an answer without a question, or it is not an expression *)

val to_event : Core.program -> Configuration.t -> t -> (Transition.event, fault) result
(** [to_event p c h] is the event, for [c]: tasks in a reply come from the place of the script of [c]. *)

val fields : (t, t) Dolphin_json.Codec.fields
(** The members that an event is written as. *)

val members : t -> Dolphin_json.Field.members
(** As journals and the step protocol have it. *)

val of_members : Dolphin_json.Field.members -> (t, string) result
(** Reads the output of {!members}, or gives the reason why it cannot. *)

val pp : Format.formatter -> t -> unit
(** ["the end of noptilus-1's task"]. *)
