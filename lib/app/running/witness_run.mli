(** A recorded run ({!Dolphin_trace.Witness}), step by step, on standard output. *)

open Dolphin_semantics

val print :
  Program_file.t ->
  Fleet_file.t ->
  drawing:Drawing.t option ->
  string ->
  (Configuration.ending option, Error.t) result
(** [print program fleet ~drawing path] takes the steps that the file [path] records and prints the log, with the
    numbers of the steps in place of times. If there is a [drawing], the run is drawn there, too. It is the run's
    ending; [None] if it stops before, or repeats without end. The error is {!Error.Bad_input}: the file is not a
    recorded run, or [program] cannot take a step of it; or that the picture cannot be written. *)
