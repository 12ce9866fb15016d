(** The present of a run, as its journal records it, from which all that may still happen is explored. The run may be
    over at any moment, go on, or have lost its console. *)

open Dolphin_semantics
open Dolphin_environment

type t

val load :
  string -> set:(string * string) list -> fleet:string option -> journal:string ->
  (t * Program_file.t * Fleet_file.t, Error.t) result
(** [load path ~set ~fleet ~journal] is the present of the run [journal] ({!Run_folder.journal}) for the program in the
    file [path], that program, and the fleet. By default the program's parameters are set as those of the run were, and
    the fleet is that of the run, or if it had none, {!Fleet_file.load_for} the program. The program may have changed
    since the run began, if the run so far is the beginning of one of its runs. The error, {!Error.Bad_input}, is the
    first line of the journal that no run of the program has, or that the run is over. *)

val start : t -> Environment.options -> Core.program -> Environment.options * (Configuration.t * Environment.t)
(** [start p options program] is the state to explore from, and the options to explore it by: questions, calls and
    inputs so far are counted, and vehicles whose connection is lost are {!Environment.without_contact}. *)

val world : t -> Dolphin_scenario.Scenario.t -> World.t
(** [world p s] is {!Scenario_world.seen} of [s] and the vehicles that the run knows. *)

val timed : t -> Dolphin_time.Clocked.options -> Dolphin_time.Clocked.options * Dolphin_time.Timed_analysis.start
(** [timed p options] is the same for {!Dolphin_time.Timed_analysis.run}: tasks and timers have gone on since they
    began, and vehicles at rest stand where they were seen last. *)

val running : t -> Dolphin_time.Clocked.options -> (Dolphin_time.Clocked.pending * int) list
(** {!Dolphin_time.Dated_run.running}, at [p]. *)

val remarks : t -> Program_file.t -> Fleet_file.t -> string list
(** Sentences on the differences from the run: a program or a fleet that has changed since, vehicles out of contact. *)

val pp : Format.formatter -> t -> unit
(** ["from 12:04 of mission.run, after 31 transitions"]. *)

val to_json : t -> Yojson.Safe.t
(** Its journal, its time in seconds, and the number of its transitions. *)
