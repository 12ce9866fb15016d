(** {!Vehicle_model} on a real socket of 127.0.0.1: it announces itself and speaks to every console that spoke to it.
    Other than DUNE it need not have heard the console's announcement: a machine has ports for five such systems. *)

type t

val start :
  ?quality:Network.quality -> ?seed:int -> ?multiplier:float -> ?date:(unit -> float) ->
  announce_ports:int list -> id:int -> name:string ->
  fate:(string -> Vehicle_model.fate) -> unit -> t
(** Runs until {!stop}. [quality] (perfect by default) is that of the network both ways. Telemetry is [multiplier] times
    (1) as frequent as usual. Packets are stamped with [date] (by default the time of day). *)

val model : t -> Vehicle_model.t

val ends : t -> (float * string) list
(** When READY with success was first sent for each plan that ended well, by {!Dolphin_runtime.Clock.system}; latest
    first. *)

val starts : t -> (float * string) list
(** When requests to start came, by {!Dolphin_runtime.Clock.system}; latest first. *)

val stop : t -> unit Lwt.t
