(** [dolphin tla --run]: TLC's verdict on a program, in the words of [dolphin explore]. *)

open Dolphin_tlc

type model = {
  files : Tlc_session.model;
  configuration : string;  (** the file of these that says what is checked *)
  invariants : string list;  (** the names there of what is checked of each state *)
  properties : string list;  (** and of each run *)
}

val run :
  Installation.t -> Invocation.mode -> directory:string option -> coverage:bool -> model ->
  Dolphin_explore.Environment.options -> Program_file.t -> Dolphin_semantics.World.t -> Exit_status.t
(** Runs TLC on the model of this program in this world, and prints what it found: whether each property holds; of the
    first that is violated a run, in columns, recovered by its labels. *)
