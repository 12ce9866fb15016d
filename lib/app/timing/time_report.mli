(** The output of [dolphin time]. *)

module Timed_analysis = Dolphin_time.Timed_analysis

val print :
  ?from:Present.t -> ?deadline:int -> ?slacks:Timed_analysis.slacks -> Program_file.t -> Timed_analysis.outcome -> unit
(** For people: the present [from] that runs go on from, when runs are over and when tasks start and end, with their
    slacks if asked for, the charge left in batteries, the run that ends last, breaks the [deadline] or empties a
    battery, in columns with times, the durations that determine its end, and the unknown ones. *)

val print_run : ?deadline:int -> Program_file.t -> Timed_analysis.outcome -> unit
(** Only the run, after a blank line and its title. *)

val print_failing : Program_file.t -> Timed_analysis.run -> unit
(** A run that fails, in the same form. *)

val time : int -> string
(** Milliseconds as {!Dolphin_time.Bounds.pp_time} has them. *)

val window : Timed_analysis.window -> string
(** ["4:00 to 7:00"]. *)

val moments : Dolphin_time.Timed_system.moment list
(** All of them, in the order of columns. *)

val item : ?at:Dolphin_semantics.Core.site -> Program_file.t -> Dolphin_time.Clocked.pending -> string
(** The awaited event: ["mission.dol:3:10: survey on noptilus-1"]; [at] is the place of a timer. *)

val write_shown :
  ?deadline:int -> Program_file.t -> Fleet_file.t -> string -> Timed_analysis.outcome -> (unit, Error.t) result
(** [write_shown ~deadline program fleet path o] writes the run that {!print} shows, if there is one, into the file
    [path], as {!Witness_file} does. *)

val to_json :
  ?from:Present.t -> ?deadline:int -> ?slacks:Timed_analysis.slacks -> Program_file.t -> Timed_analysis.outcome ->
  Yojson.Safe.t
(** The same for programs; times in seconds. *)
