(** Whether a vehicle took one request to start a plan more than once, by its own words.

    A network may duplicate a request on its way, and the vehicle begins the plan again with each copy that arrives.
    Repeated reports do not show that. But each time that it takes a request it reports so in several ways, each with
    a time stamp of its own: it is enough to hear one of these signs twice, or a sign of the beginning after one that
    the plan executes. Their stamps distinguish the signs themselves from copies of them that the network made. They
    are measured with DUNE 2026.01: replies, PlanControlState, and the entries of its log book. *)

open Dolphin_imc

type t

val nothing : t
(** No request was sent. *)

val request : plan:string -> number:int -> after:float -> busy:bool -> t
(** [request ~plan ~number ~after ~busy] is the knowledge about the request [number] to start [plan] when it is sent.
    Messages that the vehicle sent until [after], by its clock (s), do not count. [busy]: it was at that plan
    already, so that EXECUTING proves nothing. *)

(** {1:signs Signs} Sent at [sent] by the vehicle's clock, as {!Vehicle_clock.observe} returns it; in any order. *)

val reply : sent:float -> Message.t Message.Plan_control.t -> t -> t
(** A reply to a request of ours. *)

val state : sent:float -> Message.Plan_control_state.t -> t -> t
(** Its report on its plan. *)

val log : sent:float -> Message.Log_book_entry.t -> t -> t
(** An entry of its log book. *)

(** {1:detection Detection} *)

val detected : t -> (t * string) option
(** [detected x] is [Some (x', plan)] once the signs prove that [plan] was begun more than once for one request, or
    for another console's besides; [x'] reports it again only when the plan has begun once more. *)
