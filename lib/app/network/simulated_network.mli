(** Simulated vehicles on the network. *)

module Network := Dolphin_sim_imc.Network

val run :
  Network.settings -> Interruption.t -> log:string option -> lasts:float option -> started:(Network.vehicle -> unit) ->
  (unit, Error.t) result
(** [run s interruption ~log ~lasts ~started] puts the vehicles of [s] on the network, for [lasts] seconds or until
    [interruption] happens. [started] gets each vehicle once all of them can be found. The file [log] gets what they
    are commanded and do, a JSON object a line. *)
