(** The lines of a journal. [docs/trace.md] describes them field by field. *)

open Dolphin_semantics

(** The way of a plan that a vehicle starts: of one that the program describes, from the vehicle's last known place,
    perhaps without points that are on the way between others; of another, only the vehicle knows it. *)
type way = Path of Dolphin_geo.Position.t list  (** not empty *) | By_name

type t =
  | Header of Header.t  (** the first line, and only that *)
  | Partial of { observed : string list }
  (** the first line of a trace that has only labels, of these kinds; [[]]: of all *)
  | Label of { time : float; label : string }  (** in such a trace, in place of a transition *)
  | Vehicle of { time : float; state : World.vehicle_state }  (** a vehicle as it is known *)
  | Event of { time : float; event : Event.t }  (** the cause of the next transition *)
  | Transition of {
      time : float;
      index : int;  (** from 0 *)
      step : Step.t;
      ways : (Core.vehicle * way) list;  (** of the plans that it starts; for pictures, it means nothing else *)
    }
  | Note of { time : float; vehicle : Core.vehicle; note : Yojson.Safe.t }
  (** The platform's data about a vehicle for a resumption of the run: an object. It means nothing to the semantics. *)
  | Act of { time : float; act : Act.t }  (** an operator's; it means nothing to the semantics *)
  | Resumed of { time : float; program : Header.source; at : string  (** in UTC *) }
  (** The console died, and another one resumed the run here, with this program. *)
  | End of { time : float; transitions : int; ending : Request.ending }  (** the last line of a run that ended *)

val time : t -> float
(** Seconds since the start; 0 for the first line. *)

val to_string : ?notes:int -> t -> string
(** One line, without its end; with the member [notes], if that is given. *)

val codec : (t * int option) Dolphin_json.Codec.t
(** Lines, each with the member [notes]. *)

val of_string : string -> (t, string) result
(** Or what is wrong, in a sentence without a full stop. Unknown members are ignored. *)

val of_numbered_string : string -> (t * int option, string) result
(** The same, with the member [notes]. *)

val first_of_string : string -> (t, string) result
(** The same for a first line, which is a header or that of no journal. *)

(** {1:states What is known of vehicles} *)

val of_state : World.vehicle_state -> Dolphin_json.Field.members
(** The members of a [vehicle] line with its known state. *)

val to_state : Dolphin_json.Field.members -> (World.vehicle_state, string) result
(** Reads the output of {!of_state}. *)
