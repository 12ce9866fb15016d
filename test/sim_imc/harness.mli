(** One vehicle and one console, without a network: requests, answers, and their times. *)

open Dolphin_imc
open Dolphin_sim_imc

type t

val console : int
(** The console's number as an IMC system, [0x4ABC]; it is called ["ccu-test"] and takes packets at 127.0.0.1:6001. *)

val vehicle : int
(** The vehicle's number, [0x001A]. *)

val settings :
  ?speed:float ->
  ?contact_period:float ->
  ?strict:bool ->
  ?refuses:string ->
  ?blocks:(float * float) list ->
  ?losses:float list ->
  ?seed:int ->
  string ->
  Vehicle_node.settings
(** [settings source] is those for the first vehicle of the fleet file [source]. By default, contacts are seen at
    once. *)

val make : Vehicle_node.settings -> t
val epoch : float

(** {1:time Time} *)

val now : t -> float

val until : t -> float -> unit
(** [until s time] lets time pass; a vehicle to which nothing happens any more without any time passing fails the
    test. *)

(** {1:console The console} *)

val announce : ?id:int -> ?port:int -> t -> unit
val send : ?id:int -> ?dst:int -> ?host:string -> t -> Message.t -> unit
(** A packet to the data port, by default for the vehicle. *)

val join : t -> unit
(** Announces and sends a Heartbeat. *)

val beat_until : t -> float -> unit
(** [beat_until s time] is {!until}, with a Heartbeat each second. *)

val start : ?dst:int -> ?arg:Message.t -> ?flags:Message.Plan_control.Flags.t -> t -> int -> string -> unit
(** [start s number plan] sends a START. *)

val stop : t -> int -> unit

(** {1:vehicle The vehicle} *)

type heard = { time : float; announced : bool; packet : Packet.t }

val heard : t -> heard list
(** All that it sent since the last call of {!forget}. *)

val forget : t -> unit
val node : t -> Vehicle_node.t
val activities : t -> Activity.t list

val count : t -> Message.t -> int
(** [count s m] is how many messages with the number of [m] are in {!heard}. *)

val summary : t -> string list
(** What matters of {!heard}, a line for each change of PlanControlState and VehicleState and for each reply. *)

val summarise : Packet.t list -> string list
(** {!summary} of any packets, and a line for each line of the log book about plans and for each reply of the plan
    database. *)

val story : t -> string list
(** {!summarise} of {!heard}. *)

val kind : string -> string
(** The first word of such a line. *)
