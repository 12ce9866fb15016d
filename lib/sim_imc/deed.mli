(** What a simulated vehicle did, for the log of who was commanded what. *)

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
  (** It runs a plan, that it was given with the request or knows; [instead] of the plan that it was running, perhaps
      the same. *)
  | Refused of { request : request; why : string; instead : string option }
  (** It was told to start a plan and does not; [instead] is the plan that it was running and is not any more. *)
  | Stopped of { request : request; plan : string option }
  (** Told to stop, it ended [plan]; [None]: there was none. *)
  | Ignored of { request : request; why : string }  (** A request that has no answer, or not one of its own. *)
  | Completed of request  (** The plan that was so requested has ended well. *)
  | Failed of { request : request; why : string }
  | Aborted of { by : int; plan : string option }
  | Blocked of { plan : string option }  (** It cannot run plans for a while. *)
  | Unblocked

val to_json : time:float -> vehicle:string -> t -> Yojson.Safe.t
(** [to_json ~time ~vehicle d] is an object of [time], [vehicle], and [did], the name of the constructor in small
    letters; of requests also [command], ["START"] or ["STOP"] or for ignored ones ["?"], [plan], [request_id], [by],
    [sent].
    A START that made the vehicle run its plan has [did] = ["started"], once for every time that it did. *)
