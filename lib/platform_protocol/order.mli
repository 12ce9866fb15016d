(** Orders: the lines of the platform protocol that Dolphin writes; [docs/platform.md] defines their meaning. *)

open Dolphin_semantics

(** The purpose for which Dolphin starts an adapter: to run a program, to look at vehicles, to check plans. *)
type purpose = Run | Look | Check

(** What the journal may have lost of a request, with its end: the order itself, or the notes of the adapter on it. *)
type doubt = Lost_order | Lost_notes

type t =
  | Hello of { version : int; dolphin : string; purpose : purpose; program : string option; resumes : bool }
  | Telemetry of bool
  | Hold of Core.vehicle list
  | Release of Core.vehicle list
  | Timeout of Core.vehicle list option * float
  | Ping of int
  | Start of { request : string; vehicle : Core.vehicle; plan : Yojson.Safe.t; timeout : float }
  | Stop of { request : string; vehicle : Core.vehicle }
  | Resume of {
      request : string;
      vehicle : Core.vehicle;
      plan : Yojson.Safe.t;
      timeout : float;
      notes : Yojson.Safe.t list;  (** latest first *)
      doubt : doubt option;  (** what the journal may have lost *)
    }
  | Check of { id : int; vehicle : Core.vehicle option; plan : Yojson.Safe.t }
  | Kept of int
  | Refused of string  (** A report was not understood, and why. In JSON, bytes outside of ASCII are ["?"]. *)
  | Close

val codec : t Dolphin_json.Codec.t
(** Lines: [conformance/schema/platform-order.schema.json]. *)

val to_json : t -> Yojson.Safe.t
(** The object of the line. *)

val to_line : t -> string
(** With its line feed. *)

val of_line : string -> (t option, string) result
(** [of_line text] is the order that [text] is; [None] for one of a kind that is not known. The error follows the line's
    name: ["is not JSON: ..."]. *)
