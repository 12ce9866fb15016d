(** A recorded run ({!Dolphin_trace.Witness}), step by step, on standard output. *)

open Dolphin_semantics

val print :
  Program_file.t ->
  Fleet_file.t ->
  drawing:Drawing.t option ->
  string ->
  (Configuration.ending option, Error.t) result
(** [print program fleet ~drawing path] takes the steps that the file [path] records and prints the log of what happens,
    with the numbers of the steps where times would be. If there is a [drawing], the run is drawn there, too. It is how
    the run ends; [None] if it stops before, or goes on for ever. The error is {!Error.Bad_input}: the file is no
    recorded run, or [program] cannot take a step of it; or that the picture cannot be written. *)
