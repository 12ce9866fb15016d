(** One run of a program, on the simulated fleet or on the vehicles of a network, as people see it. *)

type settings = {
  program : Program_file.t;
  scenario : Dolphin_scenario.Scenario.t;  (** on a network, only its answers matter *)
  network : Dolphin_platform_imc.Udp_platform.options option;  (** [None]: the simulated fleet *)
  speed : float option;  (** times real time; [None]: as fast as it goes *)
  seed : int;
  answers : string list;
  supplier : string option;  (** a command *)
  supplier_timeout : float option;  (** seconds *)
  record : Record.settings;  (** what is kept of the run *)
  resumed : Resumed.t option;  (** a run that is gone on with *)
}

val run : settings -> Exit_status.t
(** [run s] runs [s.program] to its end, with the log on standard output and what went wrong on standard error. *)
