(** Reports: the lines of the platform protocol that an adapter writes; [docs/platform.md] defines their meaning.

    {[
      open Dolphin_platform_protocol

      let () =
        assert (Report.of_line (Report.to_line (Request ("r1", Done))) = Ok (Some (Request ("r1", Done))));
        assert (Report.is_end Done && not (Report.is_end Taken));
        assert (Result.is_error (Report.of_line "{"))
    ]} *)

open Dolphin_semantics

(** The first report of an adapter. [plans] is the kinds of plans that it takes, [patience] the time within which it
    answers orders. *)
type greeting = {
  version : int;  (** of the protocol *)
  name : string;
  adapter : string option;  (** its own version *)
  plans : string list;
  announce : float;  (** seconds *)
  patience : float;  (** seconds *)
}

(** The content of a report about a vehicle; [None]: as before. *)
type sight = {
  vehicle : Core.vehicle;
  kind : string option;
  payload : string list option;
  place : (float * float) option;  (** latitude and longitude, in degrees *)
  height : float option;
  depth : float option option;  (** metres below the surface; [Some None]: not known *)
  altitude : float option option;  (** metres above the ground or home; [Some None]: not known *)
  battery : float option option;  (** [Some None]: not known *)
  speed : float option option;
  readings : (string * float option) list;  (** of its measurements; [None]: not known any more *)
  link : bool option;
  unready : string option option;  (** [Some None]: nothing keeps it *)
}

val nothing : Core.vehicle -> sight
(** Has nothing about the vehicle. *)

(** A report on a request. *)
type word =
  | Taken
  | Progress of { share : float option; remaining : float option }
  | Done
  | Failed of string
  | Stopped
  | Unknown of string
  | Absent

type t =
  | Hello of greeting
  | Trouble of string  (** The adapter cannot go on. *)
  | Vehicle of sight
  | Gone of Core.vehicle
  | Pong of int
  | Request of string * word
  | Checked of { id : int; problems : string list }
  | Note of { request : string; note : Yojson.Safe.t; id : int option }
  | Log of { vehicle : Core.vehicle option; text : string }
  | Quiet

val is_end : word -> bool
(** Whether a request is over after this word: [Done], [Failed], [Stopped], [Absent]. *)

val codec : t Dolphin_json.Codec.t
(** Lines: [conformance/schema/platform-report.schema.json]. *)

val to_json : t -> Yojson.Safe.t
(** The object of the line. *)

val to_line : t -> string
(** With its line feed. *)

val of_line : string -> (t option, string) result
(** [of_line text] is the report that [text] is; [None] for one of a kind that is not known. The error follows the
    line's name: ["is not JSON: ..."]. *)

val version : int
(** Of the protocol: 1. *)

val longest_line : int
(** In bytes. *)
