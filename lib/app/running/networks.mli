(** The vehicles of a run that is not simulated: those that speak IMC, those of adapters, or both at once. *)

open Dolphin_semantics
open Dolphin_runtime

(** The platforms that a user asks for. *)
type choice = {
  imc : Dolphin_platform_imc.Udp_platform.options option;
  adapters : string list;  (** commands ([docs/platform.md]) *)
}

val is_any : choice -> bool
(** Whether a user asks for some platform; otherwise the fleet is simulated. *)

val name : choice -> string
(** As the headers of journals have it: ["imc"], ["process"], ["imc+process"]. *)

val options_of : string -> string list
(** [options_of name] is the options that choose the platforms [name]: ["--imc"], ["--platform"]. *)

(** How far a vehicle is with its plan, by its own estimate. *)
type estimate = {
  vehicle : string;
  plan : string;
  share : float;  (** from 0 to 1 *)
  remaining : float option;  (** seconds *)
}

(** A platform of a run, with what is known only of platforms of its kind. *)
type opened = {
  part : Several.part;
  estimates : unit -> estimate list;
  leave : unit -> unit Lwt.t;  (** closes it and stops nothing: vehicles go on with their tasks *)
}

(** The arguments that a run gives its platforms. *)
type surroundings = {
  program : string;  (** the name of its file *)
  run : string;  (** the run's identity; [""] if it has none *)
  note : Core.vehicle option -> string -> unit;
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  sync : (unit -> unit Lwt.t) option;
  past : (float * History.t) option;  (** of a run that is resumed: the time, and its history *)
}

val open_ : choice -> surroundings -> (opened, string) result Lwt.t
(** The error names the unavailable one; the others are left then, and so are those that are open if it is cancelled. *)
