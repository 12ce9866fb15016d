(** The vehicles of the network, listed on standard output. *)

val run :
  Dolphin_platform_imc.Udp_platform.options -> Dolphin_imc.Definition.t option -> Interruption.t ->
  as_json:bool -> once:bool -> seconds:float option -> (unit, Error.t) result
(** [run options definition interruption ~as_json ~once ~seconds] listens for [seconds], or until [interruption]
    happens. On a terminal it shows a table that changes, with [as_json] it prints a line each second; with [once], or
    elsewhere, it prints once, at the end. With [definition] the JSON has the messages that each system sends. *)
