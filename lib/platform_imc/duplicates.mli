(** Whether a vehicle took one request to start a plan more than once, by its own words.

    A network may double a request on its way, and a vehicle begins the plan anew with each copy that arrives. Nothing
    that a vehicle repeats tells of it; but each time that it takes a request it says so several times, each with a time
    stamp of its own, and it is enough to hear one of these words twice, or one of the beginning after one that the plan
    executes. Stamps tell the words themselves from copies of them that the network made. The words are measured with
    DUNE 2026.01: replies, PlanControlState, and the entries of its log book. *)

open Dolphin_imc

type t

val nothing : t
(** No request was sent: nothing is heard. *)

val request : plan:string -> number:int -> after:float -> busy:bool -> t
(** [request ~plan ~number ~after ~busy] is what is known of the request [number] to start [plan] when it is sent. What
    the vehicle had said by [after], by its clock, is of before. [busy]: it was at that plan already, so that it proves
    nothing that it executes it. *)

(** {1:words What the vehicle says} Sent at [sent] by its clock, as {!Vehicle_clock.observe} returns it; in any
    order. *)

val reply : sent:float -> Message.t Message.Plan_control.t -> t -> t
(** A reply to a request of ours. *)

val state : sent:float -> Message.Plan_control_state.t -> t -> t
(** What it says of its plan. *)

val log : sent:float -> Message.Log_book_entry.t -> t -> t
(** An entry of its log book. *)

(** {1:verdict Verdict} *)

val twice : t -> (t * string) option
(** [twice x] is [Some (x', plan)] once what was heard proves that [plan] was begun more than once for one request, or
    for another console's besides; [x'] does not tell it again. *)
