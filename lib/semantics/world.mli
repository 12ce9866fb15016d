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

val add : vehicle_state -> t -> t
(** [add s w] is [w] in which vehicle [s.id] has state [s]. A vehicle keeps its place in the order in which vehicles
    were first heard of. *)

val find : Core.vehicle -> t -> vehicle_state option

val vehicles : t -> vehicle_state list
(** All vehicles ever heard of, in the order of first hearing. *)

val carries : string list -> vehicle_state -> bool
(** [carries devices s] is whether [s] carries each of [devices]; names are compared without regard to case. *)
