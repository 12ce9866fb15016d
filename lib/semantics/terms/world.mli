(** What the program can learn of the vehicles around it: the sensors' side of a configuration. The semantics only
    reads it; a driver keeps it up to date. *)

type vehicle_state = {
  id : Core.vehicle;
  kind : string;  (** ["UUV"], ["UAV"], ["USV"], ["ROV"], ... *)
  payload : string list;  (** the devices that it carries *)
  position : Dolphin_geo.Position.t;
  battery : float;  (** what is left, from 0 (empty) to 1 (full) *)
  connected : bool;  (** whether it can be picked now *)
}

type t

val empty : t
(** Nothing is known of any vehicle. *)

val add : vehicle_state -> t -> t
(** [add s w] is [w] in which vehicle [s.id] has state [s]. A vehicle keeps its place in the order in which vehicles
    were first heard of. *)

val find : Core.vehicle -> t -> vehicle_state option
(** What is known of it, if anything. *)

val vehicles : t -> vehicle_state list
(** All vehicles ever heard of, in the order of first hearing. *)

val carries : string list -> vehicle_state -> bool
(** [carries devices s] is whether [s] carries each of [devices]; names are compared without regard to case. *)

(** {1:open Worlds that leave something open}

    A driver knows what sensors show. Whoever looks at all that may happen does not: in an {e open} world, batteries and
    positions may show one of several values, or any. The transition function then gives the transitions for all that
    may be shown, each with what it assumes. Within one step a sensor does not change; from one step to the next it
    may show anything anew. *)

type assumption =
  | Late of Core.vehicle  (** it was first heard of after all others so far *)
  | Missing of Core.vehicle  (** it is not in reach *)
  | Charged of Core.vehicle * float  (** its battery shows this *)
  | Placed of Core.vehicle * Dolphin_geo.Position.t  (** it is seen there *)
  | Claim of string * bool  (** this comparison with what a sensor shows holds, or does not *)

val pp_assumption : Format.formatter -> assumption -> unit
(** ["battery(x8-02) is 0.2"], ["battery(x8-02) < 0.3 is true"], ["x8-02 is missing"]. *)

val open_battery : Core.vehicle -> float list -> t -> t
(** [open_battery v xs w] is [w] in which the battery of [v] shows one of [xs], whenever the program looks; if there are
    none, any value. *)

val open_position : Core.vehicle -> Dolphin_geo.Position.t list -> t -> t
(** Likewise where [v] is seen. *)

val is_open : t -> bool
(** Whether some sensor may show several values. *)

val suppose : assumption list -> t -> t
(** [suppose assumed w] is [w] if that is so. Of what is assumed, nothing is open any more. *)

val cases : t -> (t -> 'a) -> (assumption list * 'a) list
(** [cases w f] is the results of [f], which calls {!section:look}, on [w] with all that [w] leaves open assumed in
    each possible way, as far as [f] asks for it. If it asks for nothing, that is [[ ([], f w) ]]. [f] is begun anew for
    each. *)

val outcomes : equal:('a -> 'a -> bool) -> t -> (t -> 'a option) -> (assumption list * 'a) list
(** [outcomes ~equal w f] is the different ones of the results in {!cases}, each with what is assumed where it came
    first. If it is one, and there is one in each case, nothing has to be assumed. *)

(** {1:look To look}

    Of an open world these may be called inside of {!cases} only. *)

val battery : t -> vehicle_state -> float option
(** [battery w s] is what the battery of [s] shows; [None] if that may be anything. *)

val position : t -> vehicle_state -> Dolphin_geo.Position.t option
(** [position w s] is where [s] is seen; [None] if that may be anywhere. *)

val place : t -> vehicle_state -> Dolphin_geo.Position.t
(** [place w s] is [position w s], or if that may be anything, [s.position]: for picking and allocating. *)

val claim : t -> string -> bool
(** [claim w text] is whether a comparison with what may be anything holds. *)

val claimed : t -> string -> bool option
(** [claimed w text] is [claim w text] if that is known. *)

val claims : t -> int
(** How many were made. *)
