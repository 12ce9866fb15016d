(** A console on the network: all that it knows of the systems around it and all that it wants of them, as a pure state.
    {!Udp_platform} is the shell that gives it datagrams and time, and sends what it wants sent.

    Source: IMC, Announce, Heartbeat, EntityList, PlanControl; measured with DUNE 2026.01: see [docs/imc.md]. *)

open Dolphin_semantics
open Dolphin_runtime

type t

(** The settings. *)
type settings = {
  id : int;  (** The console's IMC address, from 0x4000 to 0x5FFF, other than those of other consoles. *)
  name : string;  (** As other systems see it. *)
  program : string;  (** The name of its file, as other consoles see it. *)
  addresses : Service.address list;  (** The addresses to which vehicles can send, announced to them. *)
  epoch : float;  (** The date of time 0 of our clock: seconds since 1970-01-01 00:00 UTC. *)
  first_request : int;  (** The first number of requests. *)
  payload : (Core.vehicle * string list) list;  (** Devices of vehicles, in place of their entity lists. *)
  types : (Core.vehicle * string) list;  (** Types of vehicles, in place of the announced ones. *)
  type_names : (int * string) list;  (** Of types for which IMC 5.4 has no names. *)
  records : bool;  (** Whether {!received} is kept. *)
  abort_after : float option;  (** See {!Execution.create}. *)
  run : string;  (** The run of the program: the identity in its journal; [""]: none is announced. *)
  jitter : float;
  (** From 0 to 1 s, by chance: how much later than others this console sees that a vehicle is free. *)
}

val create : settings -> t
(** No system is known; an announcement is due. *)

val resume :
  now:float -> ?lingering:(Core.vehicle * (string * int)) list -> Dolphin_runtime.History.outstanding -> t -> t
(** [resume ~now ~lingering outstanding s] is [s], as {!create} made it, taking over at [now] from a console that
    died. The vehicles that it held, and those that it had commanded, are expected: their orders are settled when
    they have reported their plans ({!Execution}), and they may be commanded before they are heard. A vehicle that is
    not heard within its connection timeout fails its task. Timers go on. Vehicles of [lingering] (none), which
    {!Durable_note.lingering} gives, are stopped when they are heard. *)

(** {1:time Input}

    [now] is in seconds on a clock of ours that is never set back; it starts at 0. *)

(** The messages to send, the notes to keep and the events to report, in order. *)
type output =
  | Send of { address : Service.address; bytes : string }  (** From the data port. *)
  | Announce of string
  (** To the announcement ports at 224.0.75.69, the broadcast address and 127.0.0.1. *)
  | Announce_to of Unix.inet_addr * string  (** To the announcement ports there. *)
  | Keep of Core.vehicle * Durable_note.t  (** In case that the console dies: before what follows is sent. *)
  | Remark of Core.vehicle * string  (** For people: something unusual that is not the end of a task. *)

val datagram : now:float -> from:Unix.inet_addr -> ?len:int -> string -> t -> t * output list
(** [datagram ~now ~from ~len bytes s] is [s] after the first [len] bytes (all) of [bytes] came as one datagram. Nothing
    is kept of [bytes]. Whatever they are, no exception is raised.

    Datagrams without a reader are skipped by their header; of the others, those are counted and dropped ({!dropped})
    that are broken, of ourselves, of systems that have not announced themselves, or from a host that is not the
    sender's. They change nothing else. *)

val tick : now:float -> t -> t * output list
(** Time has passed: announcements, heartbeats, requests sent again, timers, silences. *)

val due : t -> float
(** When [tick] has something to do next. *)

(** {1:commands Commands} See {!Dolphin_runtime.Platform.S}. *)

val start : now:float -> Core.vehicle -> Core.platform_task -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.start}. *)

val stop : now:float -> Core.vehicle -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.stop}. *)

val bind : now:float -> Core.vehicle list -> t -> t * output list
(** Other consoles get a claim ({!Claim}). If there are any, tasks of these vehicles start {!Station_state.contest}
    later: a console that hears meanwhile that a console with a lower IMC address holds one, too, has lost it, and
    its tasks fail. *)

val claims : now:float -> t -> output list
(** Announces to other consoles the vehicles that this one holds: the bound ones, and those that may still run a plan
    of its own. *)

val release : now:float -> Core.vehicle list -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.release}: other consoles get a claim without these vehicles. *)

val set_timer : now:float -> Residual.timer -> float -> t -> t
(** As {!Dolphin_runtime.Platform.S.set_timer}. *)

val cancel_timer : Residual.timer -> t -> t
(** As {!Dolphin_runtime.Platform.S.cancel_timer}. *)

val set_connection_timeout : Core.vehicle list option -> float -> t -> t
(** As {!Dolphin_runtime.Platform.S.set_connection_timeout}. *)

val telemetry : now:float -> bool -> t -> t
(** Whether changes of positions and batteries of bound vehicles are events from now on. *)

val leaves : now:float -> at:float -> Core.vehicle list -> t -> t
(** [leaves ~now ~at vs s]: the requests to start for [vs] last leave at [at], not when they were made; [infinity]:
    not known yet. *)

val stop_all : now:float -> t -> t * output list
(** Stops what still runs for the program. *)

(** {1:events Output} *)

val take : t -> (Platform.event * t) option
(** The next event that waits to be handed out. *)

val waiting : t -> bool
(** Whether there is one. *)

val resuming : t -> bool
(** It is still listened whether the run lives elsewhere: nothing was commanded since {!resume}. *)

val twin : t -> string option
(** Another console that has the same run, by a copy of its journal, and to which this one gives way: it commands
    nothing and reports no event any more. Of two that are resumed at once, or both slept, or met late, the one with
    the higher IMC address gives way; else the one that is resumed or slept. *)

val commands : now:float -> t -> t * bool
(** Whether messages that waited for the disk may leave. A console that slept does not know yet what others hold,
    and one that has a {!twin} commands nothing: then they are dropped, and executions repeat them. *)

val owes_stop : t -> bool
(** A vehicle that is to be stopped was not heard yet, since {!resume}. *)

val quiet : now:float -> t -> bool
(** No plan is ordered, no stop waits for its confirmation, and no request of ours may still take effect. *)

val unsettled : now:float -> t -> (Core.vehicle * string) list
(** Vehicles that may still run a plan though the program does not want it any more: it was stopped or given up, and
    they have not been heard to have ended it. *)

(** {1:displays For displays} *)

(** A system as [dolphin fleet] shows it. *)
type system = {
  node : Node.t;
  state : World.vehicle_state;
  age : float;  (** seconds since it was heard of *)
  linked : bool;  (** telemetry comes *)
}

val systems : now:float -> t -> system list
(** All systems that have announced, by name. *)

val received : int -> t -> (int * Received.entry) list
(** [received id s] is the messages of the system [id], read or not, if the settings keep them. *)

val plan : Core.vehicle -> t -> Execution.progress option
(** The plan that the vehicle runs for the program. *)

val dropped : t -> (string * int) list
(** Datagrams that were dropped, by reason ({!Dolphin_imc.Error.label} for broken ones), in alphabetical order. *)

val skipped : t -> int
(** Datagrams of no interest. *)

val accepted : t -> int
(** Datagrams that were neither dropped nor skipped. *)

(** {1:constants Constants} Seconds, but for the last. *)

val announce_interval : float
(** 10 s, and at once when a system is new. *)

val eager_announce_interval : float
(** 1 s while a vehicle has announced itself and not yet spoken to us: it may have missed our announcement. *)

val heartbeat_interval : float
(** 1 s: DUNE falls silent 30 s after the last. *)

val eager_heartbeat_interval : float
(** 0.2 s to a system that has announced and not yet spoken to us: it takes notice of us by our first packet after our
    announcement. Entity lists that did not come are asked for again as often. *)

val most_nodes : int
(** 2000: as many systems are remembered. *)
