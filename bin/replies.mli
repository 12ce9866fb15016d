(** What the fleet replies to calls of a supplier where there is no process that does. *)

val call : called:string list -> Dolphin_scenario.Scenario.t -> Dolphin_runtime.Driver.call
(** [call ~called scenario] replies to each call what [scenario] has for it the first time, the second and so on; of
    several replies, the first. [called] is the calls that were replied to before, by their names. The error says what
    there might be. *)
