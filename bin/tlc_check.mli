(** [dolphin tla --run]: TLC's verdict on a program, in the words of [dolphin explore]. *)

open Dolphin_tlc

type settings = {
  mode : Invocation.mode;
  directory : string option;  (** where the model is kept; otherwise it is gone afterwards *)
  strict : bool;  (** also that nothing halts and that no tuples are left *)
}

val run :
  Installation.t -> settings -> Dolphin_tla.Model.file list -> Dolphin_environment.Environment.options -> Program_file.t ->
  Dolphin_semantics.World.t -> Exit_status.t
(** Runs TLC on the model of this program in this world, and prints what it found: whether each property holds; of the
    first that is violated a run, in columns, recovered by its labels. *)
