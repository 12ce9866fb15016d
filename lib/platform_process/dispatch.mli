(** The known state of an adapter's vehicles, and all orders to them, as a pure state. {!Process_platform} is the
    shell that gives it reports and time, and sends what it orders. [docs/platform.md] defines which side decides
    each question. *)

open Dolphin_platform_protocol
open Dolphin_semantics
open Dolphin_runtime
module Order := Dolphin_platform_protocol.Order

type t

val create :
  platform:string -> identity:(number:int -> Core.vehicle -> Core.platform_task -> string) -> t
(** No vehicle is known, and no adapter runs. [platform] is its name in journals. [identity ~number v task] is
    the request that starts [task] on [v], by the START of this number in the run: the same in each console of the
    run, and never that of another start. *)

val resume : now:float -> announce_period:float -> History.t -> t -> t
(** [resume ~now ~announce_period history d] is [d], as {!create} made it, taking over at [now] from a console that
    died after [history], the part of it that concerns this platform. *)

(** {1:outputs Outputs} *)

(** The orders to send, the notes to keep, and the messages for people, in order. [Keep (v, note)]: keep [note] about
    [v] in the journal. *)
type output =
  | Send of Order.t
  | Keep of Core.vehicle * Yojson.Safe.t
  | Keep_before of Core.vehicle * Yojson.Safe.t * string
  (** Keep it, and when it is durable report so by {!durable}, of this request. *)
  | Keep_and_tell of Core.vehicle * Yojson.Safe.t * int
  (** Keep it, and when it is durable report so to the adapter, by this number. *)
  | Remark of Core.vehicle option * string
  | Give_up of string  (** The adapter is silent: it is to be ended; why. *)

(** {1:inputs Inputs} Times are seconds of our clock, which is never set back. *)

val born : now:float -> Report.greeting -> t -> t * output list
(** An adapter has greeted. It is asked for the outcome of outstanding requests. *)

val died : now:float -> t -> t * output list
(** It is gone: its vehicles have no link. *)

val report : now:float -> Report.t -> t -> t * output list
(** [report ~now r d] is [d] after the adapter reported [r]. *)

val refused : now:float -> string -> t -> t * output list
(** [refused ~now why d]: a line of the adapter is not a report, because of [why]. The adapter is informed, about once
    a second at most, and reports all that it knows again. The user gets a remark as often, with the number of lines. *)

val last_refusals : t -> t * output list
(** The remark on refused lines that waits for its second, if there is one, is made now. *)

val durable : now:float -> string -> t -> t * output list
(** [durable ~now request d]: the note of [Keep_before] with [request] survives this machine now. Its order leaves. *)

val tick : now:float -> t -> t * output list
(** [tick ~now d] is [d] after time has passed until [now]: timers, silences, pings. *)

val due : t -> float
(** When [tick] has something to do next. *)

(** {1:commands Commands} See {!Dolphin_runtime.Platform.S}. *)

val start : now:float -> number:int -> Core.vehicle -> Core.platform_task -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.start}. *)

val stop : now:float -> Core.vehicle -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.stop}. *)

val stop_all : now:float -> t -> t * output list
(** {!stop} of every vehicle that runs something for the program. *)

val bind : Core.vehicle list -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.bind}. *)

val release : Core.vehicle list -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.release}. *)

val set_connection_timeout : Core.vehicle list option -> float -> t -> t * output list
(** As {!Dolphin_runtime.Platform.S.set_connection_timeout}. *)

val telemetry : bool -> t -> t * output list
(** Whether changes of positions and batteries are events from now on. *)

val set_timer : now:float -> Residual.timer -> float -> t -> t
(** As {!Dolphin_runtime.Platform.S.set_timer}. *)

val cancel_timer : Residual.timer -> t -> t
(** As {!Dolphin_runtime.Platform.S.cancel_timer}. *)

(** {1:events Events} *)

val take : t -> (Platform.event * t) option
(** The next event that waits to be handed out. *)

val waiting : t -> bool
(** Whether an event waits to be handed out. *)

val quiet : t -> bool
(** No request lacks its end, but for those whose stop was given up. *)

val unsettled : t -> (Core.vehicle * string) list
(** Vehicles that may still run an unwanted plan, with its name. *)

(** {1:displays For displays} *)

(** The known state of one vehicle. *)
type vehicle = {
  state : World.vehicle_state;
  is_placed : bool;  (** otherwise its position is not known *)
  battery : float option;
  speed : float option;
  plan : string option;  (** that it runs for us *)
  share : float option;
  remaining : float option;
}

val vehicles : t -> vehicle list
(** By id. *)

val ping_interval : float
(** 5 s *)
