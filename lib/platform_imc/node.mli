(** A system on the network as this console knows it: its identity, its address, its last reports. *)

open Dolphin_semantics
open Dolphin_imc

type t = private {
  id : int;  (** The IMC address, in headers. *)
  name : string;
  kind : Message.System_type.t;
  hosts : Unix.inet_addr list;  (** It announced itself from there, or announces that address. *)
  address : Service.address option;  (** The address to send to. *)
  clock : Vehicle_clock.t;
  execution : Execution.t;
  first_announced : float;
  last_announced : float;
  last_heard : float;  (** Anything but an announcement; [neg_infinity] if never. Our clock, s, as those before. *)
  position : (float * Dolphin_geo.Position.t) option;  (** With the vehicle's time, as those that follow. *)
  located : float option;  (** Our clock: when it last reported a position, in the last {!currency} seconds. *)
  depth : float option;  (** metres below the surface, as reported with the position *)
  altitude : float option;  (** metres above the ground, in the same report *)
  announced_position : Dolphin_geo.Position.t option;
  mode : (float * Message.Vehicle_state.Op_mode.t) option;
  error : string;  (** The last error of its VehicleState, [""] if none. *)
  battery : (float * float) option;  (** From 0 to 1. *)
  speed : (float * float) option;
  readings : (string * (float * float)) list;  (** By {!Dolphin_imc.Measurement}, in order. *)
  entities : string list option;  (** Labels of its entity list. *)
  queries : int;  (** How often the entity list was asked for. *)
  freed : float option;  (** Our clock: when it was ready again after it had not been, and no plan of ours ran. *)
  claim : (float * Claim.t) option;  (** Of a console: its holdings, with the time of its claim (our clock). *)
  moved : (Service.address * float) option;  (** Its earlier address, with the time of its last announcement (our
                                                 clock). *)
  shared : float option;  (** Our clock: when another system with its IMC address was last heard on its host. *)
}

(** {1:discovery Discovery} *)

val make :
  now:float -> from:Unix.inet_addr -> ?abort_after:float -> request:int -> Packet.t -> Message.Announce.t -> t
(** [make ~now ~from ~request p a] is the system that announced itself for the first time, by the packet [p] with [a].
    Its requests will be numbered from [request]; [abort_after]: see {!Execution.create}. *)

(** A message for people, once of each [about]. *)
type warning = { about : string; text : string }

(** The meaning of an announcement with the IMC address of a system. *)
type announcement =
  | Own of t * warning option  (** It announced itself again. *)
  | Other of t * warning option
  (** Another system did: it came from none of the system's hosts, or names the system otherwise, and the system was
      heard of in the last {!absence} seconds. *)

val announce :
  now:float -> from:Unix.inet_addr -> may_rename:bool -> Packet.t -> Message.Announce.t -> t -> announcement
(** [announce ~now ~from ~may_rename p a n] is the meaning of [a] for [n]. Another name is believed at once from the
    address of [n], if it [may_rename]. Two systems with one IMC address cause a warning; if they are on one host, so
    that their datagrams cannot be distinguished, [n] cannot be picked while both announce themselves. *)

val place : t -> string
(** Its name and address, as in [lauv-1 at 127.0.0.1:6002]. *)

val unshared : t -> t
(** [unshared n] is [n] that has its IMC address alone again. *)

val belongs : Unix.inet_addr -> t -> bool
(** [belongs host n] is whether datagrams of [n] may come from [host]. *)

val rest : float
(** 1 s: the time, plus [jitter] (0 s), for which a vehicle that was busy must be ready before it can be picked.
    Between two plans of another program it is ready for about a millisecond (measured). *)

val currency : float
(** 2 s: a vehicle that has not reported its position for this time cannot be picked. *)

val absence : float
(** 30 s: three announcements are missing. After that a system may come back elsewhere. *)

(** {1:telemetry Its reports} *)

val hear : now:float -> ?jitter:float -> own:int -> Packet.t -> t -> t * Execution.output list
(** [hear ~now ~jitter ~own p n] is [n] after its packet [p] came, and the consequences for its plan. Replies of
    PlanControl count if they are for the console [own]; values that are NaN, or out of range, are left out.

    The position is EstimatedState's reference point, moved [x] metres north and [y] metres east over the ground, [z]
    metres down. A depth counts for vehicles that dive or float, an altitude for others: divers count it from the sea
    floor. Negative ones mean none. The battery is FuelLevel's percentage, as a share. *)

val command : now:float -> Execution.input -> t -> t * Execution.output list
(** [command ~now i n] gives [i] to [n]'s execution. *)

val unlocated : t -> t
(** [unlocated n] is [n] that has not reported its position for {!currency}. *)

val rested : t -> t
(** [rested n] is [n] that has been ready for {!rest}. *)

val unclaimed : t -> t
(** [unclaimed n] is [n] that holds nothing any more. *)

val overslept : now:float -> float -> t -> t
(** [overslept ~now gap n] is [n] if this console did not listen for [gap] seconds until [now]. *)

val let_go : now:float -> jitter:float -> t -> t
(** [let_go ~now ~jitter n] is [n], which another console held until now: it can be picked in [jitter] seconds. *)

val queried : t -> t
(** [queried n] is [n] that was asked for its entity list once more. *)

(** {1:state As programs see it} *)

val is_vehicle : t -> bool
(** Whether its type is one that runs plans. *)

val silent : now:float -> timeout:float -> t -> bool
(** [silent ~now ~timeout n] is whether nothing but announcements was heard of [n] for [timeout] seconds. *)

val state :
  now:float -> timeout:float -> kind:string -> payload:string list option -> held:string option -> bound:bool -> t ->
  World.vehicle_state
(** [state ~now ~timeout ~kind ~payload ~held ~bound n] is [n] for programs, as a vehicle of type [kind]. It is
    connected if it is a vehicle and not silent, and ready if it has a plan of ours or {!Readiness} is ready, {!rest}
    is over, and no other console holds it ([held]: the holder). Unless it is [bound], it must be heard to have
    stopped a plan of ours, and its position must be current ({!currency}). It carries [payload], or else the
    entities of its list. Until it reports them its battery is unknown, and its place is the announced one. *)

val mode : names:(int * string) list -> t -> string
(** ["SERVICE"], ["MANEUVER"] ..., by [names] first; ["-"] if not known. *)

val last_sign : t -> float
(** When, by our clock, anything was heard of it last, announcements included. *)
