(** Programs in the world of a fleet as models in TLA+. *)

type t = {
  files : Dolphin_tla.Model.file list;
  environment : Dolphin_environment.Environment.options;
  world : Dolphin_semantics.World.t;
}

val make :
  ?tick:int ->
  answers:string list -> faults:Dolphin_environment.Faults.t -> Program_file.t -> Fleet_file.t -> (t, Error.t) result
(** [make ~tick ~answers ~faults program fleet] is the model, with the times of the fleet in ticks of [tick]
    milliseconds, by default those of [Dolphin_tla.Times.tick]. The error, {!Error.Bad_text}, has the places in the
    fleet or in the program of the parts without a meaning in TLA+. *)
