(** [dolphin tla --compare]: are TLC's state graph and the explorer's the same? *)

open Dolphin_tlc

val run :
  Installation.t -> directory:string option -> limit:int -> coverage:bool -> Dolphin_tla.Model.file list ->
  Dolphin_environment.Environment.options -> Program_file.t -> Dolphin_semantics.World.t ->
  (Exploration.verdict, Error.t) result
(** [run installation ~directory ~limit ~coverage model options program world] has TLC print the graph of [model], that
    of [program] in [world], explores [program] without reduction, at most [limit] states, and prints whether the two
    graphs are isomorphic with equal labels, derivations and ends, or else the first difference. With [coverage] it also
    prints how often TLC's graph uses each rule. *)
