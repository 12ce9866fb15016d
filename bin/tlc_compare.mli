(** [dolphin tla --compare]: are TLC's state graph and the explorer's the same? *)

open Dolphin_tlc

val run :
  Installation.t -> directory:string option -> limit:int -> coverage:bool -> Dolphin_tla.Model.file list ->
  Dolphin_environment.Environment.options -> Program_file.t -> Dolphin_semantics.World.t -> Exit_status.t
(** Has TLC print the graph of the model, explores without reduction, at most [limit] states, and prints whether the two
    are isomorphic with equal labels, derivations and ends, or else the first difference. With [coverage], how often
    TLC's graph uses each rule is printed too. *)
