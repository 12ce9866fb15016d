(** [dolphin tla --run]: TLC's verdict on a program, in the words of [dolphin explore]. *)

open Dolphin_tlc

(** The options of a check. *)
type settings = {
  mode : Invocation.mode;
  directory : string option;  (** the folder of the model; otherwise it is removed afterwards *)
  strict : bool;  (** also that nothing halts and that no tuples are left *)
  notice : string -> unit;  (** shows how workers join a server *)
}

val run :
  Installation.t -> settings -> Dolphin_tla.Model.file list -> Dolphin_environment.Environment.options ->
  Program_file.t ->
  Dolphin_semantics.World.t -> (Exploration.verdict, Error.t) result
(** [run installation s model options program world] runs TLC on [model], that of [program] in [world], and prints
    what it found on standard output: whether each property holds; of the first that is violated a run, in columns,
    recovered by its labels. An interrupted check is {!Error.Inconclusive}; earlier results are printed. *)
