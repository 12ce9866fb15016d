(** A request to start a plan, as the vehicle was sent it: perhaps in several copies, perhaps by a console that has
    died. *)

open Dolphin_imc

(** A plan to run. *)
type order = {
  plan : string;
  specification : Message.t Message.Plan_specification.t option;  (** [None]: the vehicle knows the plan by name *)
}

type t = {
  order : order;
  request : int;  (** its [request_id] *)
  copies : int;  (** the number of copies sent *)
  last_sent : float;  (** when the last copy was, by our clock (s); [infinity]: it still waits to leave *)
  asked : float;  (** the vehicle's clock then, at most (s) *)
  awake : float option;  (** when, by its clock, the vehicle first sent anything {!reading} or more after [asked] *)
  before : Plan_report.t option;  (** the vehicle's last report when the request was first sent *)
  after : float;  (** the time of its last report before, by its clock *)
  accepted : float option;  (** when, by its clock, it first answered that it takes the plan *)
  answered : bool;  (** it answered in any way *)
  adopted : bool;  (** the request was that of a console that has died *)
  initialised : bool;  (** INITIALIZING was seen since *)
}

val patience : float
(** 1 s: longer than a reply takes, and than a datagram stays on its way. *)

val reading : float
(** 0.25 s: longer than a vehicle that sends datagrams leaves one unread. One that was stopped, or had no processor, for
    a while may send its reports first, and then read the request that waits at its socket. *)

val make : now:float -> clock:Vehicle_clock.t -> request:int -> before:Plan_report.t option -> order -> t
(** The first copy, sent at [now]. *)

val adopted : now:float -> clock:Vehicle_clock.t -> order -> Durable_note.knowledge -> t
(** The request of a console that has died, as far as the notes record it. Every later report of the vehicle is later
    than all that the other console did. *)

val send_again : now:float -> clock:Vehicle_clock.t -> t -> t
(** One copy more, sent at [now]. *)

val leaves : at:float -> clock:Vehicle_clock.t -> t -> t
(** The last copy leaves at [at] (s) and not when it was made; [infinity]: not known yet. *)

val hears : clock:Vehicle_clock.t -> t -> t
(** Anything came of the vehicle, which [clock] has observed. *)

val start : t -> Message.t
(** The request to start. *)

val stop : request:int -> t -> Message.t
(** The request, with a number of its own, to stop that plan. *)

val was_busy_with : string -> t -> bool
(** [was_busy_with plan a]: the vehicle was at [plan] when the request was first sent. *)

val accepted_before : Plan_report.t -> t -> bool
(** [accepted_before r a]: the vehicle had taken the plan when it sent [r]. *)

val effect_time : t -> float
(** When, by the vehicle's clock, the request took effect, at the earliest. *)

val may_arrive : now:float -> t -> bool
(** [may_arrive ~now a]: a copy of the request may still be on its way. *)

val is_open : t -> bool
(** Whether a copy of the request may take effect by the vehicle's answers: it has not answered, or not each copy. *)

val is_past : now:float -> Plan_report.t -> t -> bool
(** [is_past ~now r a]: no copy is on its way any more, and the vehicle sent [r] after the last one had arrived, if
    it ever did: [r] shows the final effect of the request. *)

val was_read : Plan_report.t -> t -> bool
(** [was_read r a]: the vehicle sent [r] after it had been awake for {!reading} since the last copy came, if it did: it
    has read that copy. *)

(** {1:notes What is to be kept} *)

(** How far a request has come that is not over yet. *)
type stage = Starting | Running | Stopping

val notes : before:(t * stage) option -> after:(t * stage) option -> Durable_note.t list
(** [notes ~before ~after] is the notes to keep of a step, in order. *)
