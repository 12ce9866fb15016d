(** The requests of a transition to the outside, as journals have them: {!Dolphin_semantics.Effect.t} with texts for
    parts that a reader need not take apart. *)

open Dolphin_semantics

(** How a run ended, and its message. *)
type ending = { how : string;  (** see {!how} *) message : string option }

type t =
  | Start of { vehicle : string; plan : string }
  | Stop of string
  | Set_timer of { timer : int; seconds : float }
  | Cancel_timer of int
  | Put_question of { question : int; prompt : string }
  | Withdraw_question of int
  | Look_for of string
  | Bind of string list
  | Release of string list
  | Set_connection_timeout of { vehicles : string list option; seconds : float }
  | Say of string
  | Ask of string
  | Call of string
  | End of ending

val of_effect : Effect.t -> t
(** The request of an effect to the outside. *)

val ending : Configuration.ending -> ending
(** How a run ended, in words. *)

val how : string list
(** How runs end: ["completed"], ["halted"], ["failed"], ["interrupted"], and, of whole runs but not of their last
    effects, ["stuck"]. *)

val codec : t Dolphin_json.Codec.t
(** Objects whose first member is the kind of the request. *)

val some_texts : string list Dolphin_json.Codec.t
(** A list of texts, which is written if it is not empty. *)

val ending_fields : (ending, ending) Dolphin_json.Codec.fields
(** The members of an ending. *)

val ending_members : ending -> Dolphin_json.Field.members
(** [ending_members e] is {!ending_fields} of [e]. *)
