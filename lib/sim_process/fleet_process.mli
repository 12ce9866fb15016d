(** A simulated fleet that speaks the platform protocol on standard input and output, as an adapter does. *)

(** The options of the simulated adapter. *)
type settings = {
  scenario : Dolphin_scenario.Scenario.t;
  seed : int;
  speed : float;  (** seconds of the fleet that pass in one *)
  state : string option;  (** a file in which the fleet outlives this process *)
}

val run : settings -> (unit, string) result Lwt.t
(** Resolves when the input has ended, or all is closed. The error is the reason why the state is not available; the
    greeting has it too. *)
