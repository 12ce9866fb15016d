(** [dolphin tla --compare]: are TLC's state graph and the explorer's the same? *)

open Dolphin_tlc

val run :
  Installation.t -> directory:string option -> limit:int -> configuration:string -> Tlc_session.model ->
  Dolphin_explore.Environment.options -> Program_file.t -> Dolphin_semantics.World.t -> Exit_status.t
(** Has TLC print the graph under [configuration], explores without reduction, and prints whether the two are isomorphic
    with equal labels, derivations and ends, or else the first difference. *)
