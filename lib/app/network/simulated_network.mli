(** Simulated vehicles on the network. *)

module Network := Dolphin_sim_imc.Network

val run :
  Network.settings -> Interruption.t -> log:string option -> lasts:float option -> started:(Network.vehicle -> unit) ->
  (unit, Error.t) result
(** [run s interruption ~log ~lasts ~started] puts the vehicles of [s] on the network, for [lasts] seconds or until
    [interruption] happens. [started] is told of each vehicle once all of them can be found. What they are commanded and
    do goes into the file [log], a JSON object a line. *)
