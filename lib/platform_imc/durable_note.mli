(** Knowledge about a plan's execution that the vehicle itself does not report, and that a console which takes over
    from one that died needs: the notes of {!Execution} that journals keep. *)

open Dolphin_semantics

type t =
  | Asked of { plan : string; request : int; before : (string * bool) option }
  (** A request to start [plan] is about to be sent. [before]: the plan that the vehicle named last, and whether it was
      busy with it; [None] if it had named none. *)
  | Taken of { request : int }  (** The vehicle answered that it takes the plan. *)
  | Runs of { request : int }  (** The vehicle was seen to execute it. *)
  | Over of { request : int }  (** It was stopped, and the vehicle confirmed that; or the vehicle rests after all. *)
  | May_run of { plan : string; request : int }
  (** The plan is over for the program, but the vehicle may still run it: it is stopped until it rests. *)

val is_write_ahead : t -> bool
(** Whether the note must be durable before what follows is sent: of [Asked]. *)

val to_json : t -> Yojson.Safe.t
(** An object, as journals keep it. *)

val of_json : Yojson.Safe.t -> t option
(** [of_json (to_json n)] is [Some n]; [None] for any other value. *)

(** The combined content of the notes on one request. *)
type knowledge = {
  request : int;
  before : (string * bool) option;
  taken : bool;
  runs : bool;
  over : bool;
}

val lingering : (Core.vehicle * t) list -> (Core.vehicle * (string * int)) list
(** [lingering notes] is the vehicles that may still run a plan that is over for the program, with the plan and the
    number of its request, by [notes], in order: [May_run] without an [Over] or another request since. *)

val knowledge : plan:string -> t list -> knowledge option
(** [knowledge ~plan notes] is the content of [notes], latest first, about the latest request for [plan]; [None]:
    none was ever sent. *)
