(** One run of a program on the simulated fleet, as people see it. *)

type settings = {
  program : Program_file.t;
  scenario : Dolphin_scenario.Scenario.t;
  speed : float option;  (** times real time; [None]: as fast as it goes *)
  seed : int;
  answers : string list;
  supplier : string option;  (** a command *)
  supplier_timeout : float option;  (** seconds *)
  record : Record.settings;  (** what is kept of the run *)
}

val run : settings -> Exit_status.t
(** [run s] runs [s.program] to its end, with the log on standard output and what went wrong on standard error. *)
