(** The knowledge of a console about the systems around it and its goals for them, and the common part of all
    reactions: to send, to report to the program, to give an input to the execution on a vehicle. {!Station} is its
    public side. *)

open Dolphin_semantics
open Dolphin_runtime
open Dolphin_imc
module Names : Map.S with type key = string
(** Maps by names of systems. *)

module Name_set : Set.S with type elt = string
(** Sets of names of systems. *)

(** As {!Station.settings}. *)
type settings = {
  id : int;
  name : string;
  program : string;
  addresses : Service.address list;
  epoch : float;
  first_request : int;
  payload : (Core.vehicle * string list) list;
  types : (Core.vehicle * string) list;
  type_names : (int * string) list;
  records : bool;
  abort_after : float option;
  run : string;
  jitter : float;
}

type t = {
  settings : settings;
  systems : Systems.t;
  bound : Name_set.t;
  seen : float;  (** when anything happened last; a later time means that this console slept *)
  wary_until : float;
  (** after a sleep, and at a resumption: until then nothing is started; [neg_infinity]: all is well *)
  resuming : bool;  (** [wary_until] is that of a resumption *)
  twin : string option;  (** another console that has the same run: this one commands nothing any more *)
  contests : float Names.t;  (** vehicles that were bound a moment ago: until when others may object *)
  yielded : Name_set.t;  (** bound, but others held them when it mattered *)
  warned : Name_set.t;  (** the warnings given *)
  crowded : bool;  (** more systems than are remembered announced themselves, and people have the message *)
  deferred : Core.platform_task Names.t;  (** tasks to start once it is known who holds the vehicles *)
  claimed : Name_set.t;  (** the last claim to other consoles, each second *)
  held : string Names.t;  (** by other consoles, and by which, in words *)
  telemetry : bool;
  timeouts : float Names.t;
  timeout : float;  (** of vehicles that are not in [timeouts] *)
  timers : Timers.t;
  expected : Expected.t;
  outbox : Outbox.t;
  presence : Presence.t;
  dropped : int Names.t;
  skipped : int;
  accepted : int;
  received : Received.t;
}

(** As {!Station.output}. *)
type output =
  | Send of { address : Service.address; bytes : string }
  | Announce of string
  | Announce_to of Unix.inet_addr * string
  | Keep of Core.vehicle * Durable_note.t
  | Remark of Core.vehicle * string

val create : settings -> t
(** As {!Station.create}. *)

val resume : now:float -> ?lingering:(Core.vehicle * (string * int)) list -> History.outstanding -> t -> t
(** As {!Station.resume}. *)

val timeout_of : Core.vehicle -> t -> float
(** Seconds without a word after which a vehicle has lost its link. *)

val add_timeouts : (Core.vehicle * float) list -> t -> t
(** [add_timeouts ts s] is [s] in which these vehicles have these timeouts, in seconds. *)

val hold : Core.vehicle list -> t -> t
(** [hold vs s] is [s] in which [vs] are bound. *)

(** {1:holds Who holds what} *)

val longest_pause : float
(** 2 s: a console to which nothing happened for longer has slept. *)

val wariness : float
(** 3.5 s: how long claims are listened for after a sleep, and before anything is resumed. *)

val contest : float
(** 0.3 s: how long, and up to that much longer ([jitter]), claims on vehicles that were just bound are listened for. *)

val awake : now:float -> t -> t
(** [awake ~now s] is [s] as something happens. A console to which nothing has happened for longer than
    {!longest_pause} has slept: others hold for free what it held, so it listens first; and silences do not count. *)

val listens : now:float -> t -> bool
(** [listens ~now s] is whether this console, after a sleep or at a resumption, still finds out what others hold. *)

val deferred_until : Core.vehicle -> t -> float
(** Until when no task of the vehicle is started. *)

val taken_by_another : Core.vehicle -> t -> string option
(** The holder of the vehicle, in words, though it is bound here: another console had it first. *)

val find : Core.vehicle -> t -> Node.t option
(** [find v s] is the system with this name, if it is known. *)

val update : Node.t -> t -> t
(** [update n s] is [s] with [n] in place of the system with its address. *)

val again : Node.t -> t -> Node.t
(** [again n s] is [n] as it is in [s]. *)

val held_by : Node.t -> Core.vehicle list
(** The holdings of the console [n]. *)

val is_of_this_run : Node.t -> t -> bool
(** The console has the same run, by a copy of its journal. *)

val with_claims : t -> t
(** [with_claims s] is [s] after a change of other consoles' holdings. Those of this run do not count: one of the two
    consoles gives way ([twin]). *)

val state_of : now:float -> Node.t -> t -> World.vehicle_state
(** [state_of ~now n s] is {!Node.state} of [n], with the settings and holdings of [s]. *)

(** {1:sending Sending} *)

val encode : now:float -> dst:int -> Message.t -> t -> (string, Error.encode) result
(** [encode ~now ~dst m s] is the packet with [m] from this console to the system [dst]. *)

val to_node : now:float -> Node.t -> Message.t -> t -> output list
(** Nothing, if it has no address. *)

val announcement : now:float -> t -> string
(** The packet that announces this console. *)

val query : now:float -> Node.t -> t -> t * output list
(** Asks for its list of entities. *)

val holds : now:float -> t -> Name_set.t
(** The bound vehicles, and those that may still run a plan of this console. *)

val claims : now:float -> t -> output list
(** Announces the holdings of this console to all others. *)

(** {1:telling Telling the program} *)

val push : Platform.event -> t -> t
(** [push e s] is [s] with [e] after the events that wait to be handed out. *)

val tell : ?urgent:bool -> now:float -> Node.t -> t -> t
(** [tell ~now n s] reports the known state of [n], if it is a vehicle. *)

val gone : Node.t -> t -> t
(** [gone n s]: nothing is heard any more under the name of [n]. *)

val tell_all : now:float -> Core.vehicle list -> t -> t
(** [tell_all ~now vs s] is {!tell} of each of [vs] that is known. *)

(** {1:executions Executions} *)

val carry_out : now:float -> Node.t -> Execution.output list -> t -> t * output list
(** [carry_out ~now n outputs s] is the consequences of the execution on [n], which is in [s]. Commands are left out
    after a sleep that {!awake} has not noticed yet, while {!listens}, and if [s] has a [twin]; executions repeat them
    later. They are left out also if another console had [n] first: then a task that was to be started fails. *)

val command : now:float -> Execution.input -> Node.t -> t -> t * output list
(** [command ~now input n s] gives [input] to the execution on [n]. *)

val command_all : now:float -> Execution.input list -> Node.t -> t -> t * output list
(** One after another. *)

val for_each : (Node.t -> t -> t * output list) -> t -> t * output list
(** [for_each f s] is [(s, [])] with [f] carried out for each system in turn. *)
