(** The activity of a simulated vehicle: an entry of the log with the vehicle and its command. *)

(** A request as it came. *)
type request = {
  plan : string;
  number : int;  (** its [request_id] *)
  by : int;  (** the system that sent it *)
  sent : float;
  (** its time stamp: two requests that are one datagram, which the network has doubled, have the same *)
}

type t =
  | Started of { request : request; inline : bool; instead : string option }
  (** It runs a plan, one that came with the request ([inline]) or one that it knows; [instead] of the plan that it was
      running, which may be the same. *)
  | Refused of { request : request; why : string; instead : string option }
  (** It was ordered to start a plan and does not; [instead] is the plan that it was running, and that has ended with
      this. *)
  | Stopped of { request : request; plan : string option }
  (** It was ordered to stop, and has ended [plan]; [None]: it ran none. *)
  | Ignored of { request : request; why : string }  (** A request that it does not answer, or does not support. *)
  | Completed of request  (** The plan that was requested has ended well. *)
  | Failed of { request : request; why : string }
  | Aborted of { by : int; plan : string option }
  | Blocked of { plan : string option }  (** It cannot run plans for a while. *)
  | Unblocked
  | Lost of { request : request }  (** Its plan engine has lost the plan that was requested; the maneuver goes on. *)

val to_json : time:float -> vehicle:string -> t -> Yojson.Safe.t
(** [to_json ~time ~vehicle a] is an object of [time] (s), [vehicle], and [did], the name of the constructor in small
    letters. Requests add [command] (["START"], ["STOP"], or ["?"] of ignored ones), [plan], [request_id], [by] and
    [sent]. A vehicle logs ["started"] once for each time that it begins a plan. *)
