(** One plan on one vehicle, from the request to the verdict: a pure state machine.

    Source: IMC, PlanControl and PlanControlState, and measurements with DUNE 2026.01: see [docs/imc.md]. In short,
    PlanControlState is repeated about three times a second and on change, goes INITIALIZING (still with the plan
    before), EXECUTING, READY, and keeps the last outcome until the next; a request is answered by up to three replies,
    any of which may be lost, doubled or late.

    {1:rules How it decides}

    Everything is ordered by the vehicle's own time stamps ({!Vehicle_clock}); reports older than the known state are
    ignored.

    - The plan {e runs} once EXECUTING is seen with its name, sent after our request. If the vehicle ran a plan of the
      same name before, a sign of our request is needed too: a reply to it, or INITIALIZING.
    - It is {e done} when READY with its name and outcome SUCCESS was sent after EXECUTING was, or after a positive
      reply to our request, or, both being lost, if the vehicle had another plan's name before.
    - It {e failed} when a FAILURE replies to our request, in the words of that reply; when READY has another outcome
      than SUCCESS; when the vehicle went from INITIALIZING to READY without taking the plan; when it is BLOCKED, and
      then it is ordered to stop unless VehicleState shows rest; when it executes another plan, or has executed one.
      Missing words are waited for, {!grace} long; an error that the vehicle reports stands in for them. None of this
      counts while the request is unanswered and may still take effect: another console may have been quicker, and our
      request takes the vehicle from that one.
    - A request waits until its note is durable ([Leaves]). Until it has left, nothing follows from silence.
    - A request is {e sent again} only after a look: no reply came within {!patience}, and a state that the vehicle sent
      that long after the request shows that it was without effect. After {!most_copies} the plan has failed.
    - A stop is sent again every {!stop_interval} until it is {e confirmed}: a reply, READY or BLOCKED shows that the
      plan engine does not run the plan, and a VehicleState sent later that no maneuver runs. Measured: after a stall
      the engine has lost the plan, is BLOCKED, answers ["no plan is running"], while VehicleState stays MANEUVER and
      the vehicle goes on. Another plan in EXECUTING confirms it too, and of a vehicle that never sends VehicleState
      READY does. If it is not known whether the vehicle took the plan, all this counts one {!patience} after the
      request, which may have been overtaken. Only then is the next start sent.
    - While the vehicle reports MANEUVER a stop is never given up: {!warning} after the first one people get a message,
      after [abort_after] ({!create}) it is ordered to abort, and after {!stop_patience} the next order fails. If
      nothing is heard for {!stop_patience}, the stop is given up.
    - A vehicle that reports MANEUVER, and no plan, a second after our plan was over is ordered to stop.
    - Late copies of our own datagrams are recognised by their replies: a stop that hits the next plan makes it start
      again; a start that comes after its plan was over is stopped; one that comes while the plan runs makes the vehicle
      begin it again, which cannot be prevented ({!Duplicates} detects it). All this is reported as a [Remark].

    {1:adoption What another console began}

    A console that takes over decides in the same way. Its other knowledge is the notes of the other one: the plan
    that the vehicle had named before the request, and whether the vehicle had answered it. A request that was never
    sent is sent now; one that may or may not have left is looked for like one that was not answered. If the vehicle
    named that very plan before, and it is READY, it cannot be known whether the plan has run: the order fails with
    this reason. *)

open Dolphin_imc

type t

(** A plan to run. *)
type order = Attempt.order = {
  plan : string;
  specification : Message.t Message.Plan_specification.t option;  (** [None]: the vehicle knows the plan by name *)
}

(** The meaning of an order without a note: whether a console before this one may have sent it. *)
type doubt =
  | Never_sent  (** It was certainly not sent. *)
  | Lost_note  (** It may have been: the end of the journal may be lost. *)
  | Lost_note_of_repetition
  (** As [Lost_note]; but the vehicle ran a plan of that name for the run before, which its report may be about. *)

(** Times [sent] are by the vehicle's clock as {!Vehicle_clock.observe} returns them. Only messages of this vehicle, and
    only replies to this console, are given. *)
type input =
  | Start of order
  | Stop
  | Reply of { sent : float; reply : Message.t Message.Plan_control.t }
  | State of { sent : float; state : Message.Plan_control_state.t }
  | Vehicle of { sent : float; state : Message.Vehicle_state.t }
  | Log of { sent : float; entry : Message.Log_book_entry.t }
  | Abort of string  (** The console of this name ordered the vehicle to abort. *)
  | Stopped_by of string  (** The console of this name ordered the vehicle to stop its plan. *)
  | Lost of string  (** The link is given up; why. *)
  | Adopt of { order : order; stopped : bool; notes : Durable_note.t list; doubt : doubt  (** latest first *) }
  (** A console before this one was ordered to start [order], and if [stopped] to stop it again, and then died;
      [notes] is its notes since then; if there are none, [doubt] counts. To be given to an execution that
      has nothing to do, once there is a {!report}. *)
  | Leaves of float
  (** The last request to start leaves at that time, and not at once; [infinity]: not known yet. *)
  | Tick  (** Time has passed. *)

(** The messages to send, the notes to keep and the events to report, in order. *)
type output =
  | Keep of Durable_note.t  (** In case that the console dies: before what follows is sent. *)
  | Send of Message.t  (** To the vehicle. *)
  | Done
  | Failed of string  (** Why; without a full stop. *)
  | Remark of string  (** For people: a request that may take effect twice, a stop given up. *)

val create : ?abort_after:float -> request:int -> unit -> t
(** Nothing to do; requests are numbered from [request], modulo 65536. A vehicle that still maneuvers [abort_after]
    seconds after the order to stop is ordered to abort, once a second; by default never. *)

val step : now:float -> clock:Vehicle_clock.t -> input -> t -> t * output list
(** [step ~now ~clock i x] is [x] after [i] at [now] (s, our clock). After each [Start], and each [Adopt] that is not
    [stopped], there is exactly one [Done] or [Failed], unless [Stop] or another [Start] comes before. *)

val due : t -> float
(** When [Tick] has something to do, by our clock; [infinity] if never. *)

val idle : t -> bool
(** [idle x]: no plan is ordered, and no stop waits for its confirmation. *)

val owes : t -> bool
(** [owes x]: [Done] or [Failed] is still to come. *)

val is_settled : now:float -> t -> bool
(** [is_settled ~now x]: [x] is {!idle}, and no request of ours may still take effect. If one does after all, it is
    stopped. *)

val unsettled : now:float -> t -> string option
(** [unsettled ~now x] is the unwanted plan that the vehicle may still run: its stop is not confirmed, or it was
    given up and the vehicle has been silent since, or the request for it may still take effect. *)

val report : t -> Plan_report.t option
(** The vehicle's last report on its plan. *)

(** {1:displays For displays} *)

(** How far a request has come. *)
type stage = Attempt.stage = Starting | Running | Stopping

(** The present plan of the vehicle, for displays. *)
type progress = {
  plan : string;
  stage : stage;
  share : float option;  (** of the plan, from 0 to 1, as the vehicle estimates it *)
  remaining : float option;  (** seconds, as the vehicle estimates them *)
}

val progress : t -> progress option
(** Of the ordered plan. *)

val executing : t -> string option
(** The plan that the vehicle reports to execute, ours or not. *)

(** {1:constants Constants} Seconds, but for the first. *)

val most_copies : int
(** 10; 3 while the vehicle is BLOCKED. *)

val patience : float
(** 1 s: longer than a reply takes, and than a datagram stays on its way. *)

val grace : float
(** 1 s. *)

val stop_interval : float
(** 0.5 s. *)

val stop_patience : float
(** 60 s. *)

val warning : float
(** 5 s. *)
