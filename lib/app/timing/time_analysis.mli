(** How early and how late the runs of a program in a file do what they do, with a fleet. *)

module Timed_analysis = Dolphin_time.Timed_analysis

(** The options of an analysis; [None]: no limit. *)
type settings = {
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  deadline : int option;  (** milliseconds *)
  workers : int;  (** processes that look for slacks *)
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  timeout : float option;
}

val run :
  ?from:Present.t -> interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> settings ->
  Program_file.t -> Fleet_file.t -> Timed_analysis.outcome
(** How a program's runs may go, by default from the beginning, or from the present [from] of one. [interrupted] and
    [progress] are as in {!Dolphin_checker.Limits}. *)

(** A task that a vehicle carries out. *)
type running = {
  vehicle : Dolphin_semantics.Core.vehicle;
  plan : string;
  ends : Dolphin_time.Bounds.t;  (** since the start of the run, by the durations of the fleet *)
}

val running : from:Present.t -> settings -> Program_file.t -> Fleet_file.t -> running list
(** [running ~from s program fleet] is the tasks that run at [from]. One may have run for longer than the fleet has
    it. *)

val slacks :
  interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> settings -> Program_file.t ->
  Fleet_file.t -> Timed_analysis.outcome -> Timed_analysis.slacks
(** {!Timed_analysis.slacks} of the result of {!run}, with the same settings. *)

val duration : string -> (int, string) result
(** [duration text] is the milliseconds that [text] spells, as fleets do: ["40.min"], ["90.seconds"], seconds without a
    unit; or what is wrong with it. *)
