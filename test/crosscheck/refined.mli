(** Whether the specification refines [spec/Abstract.tla], by TLC. *)

open Dolphin_tlc

type specification := (string * string) list
(** The modules of [spec/]: names and texts. *)

val theorems : Installation.t -> specification -> (unit, string) result
(** [theorems i specification] is whether the theorems of [Abstract.tla] hold in all small states
    ([spec/models/SmallAbstract.tla]); or TLC's error. *)

val programs : Installation.t -> specification -> Batch.prepared list -> (unit, string) result
(** [programs i specification ps] is whether the transitions of each of [ps] are events of [Abstract.tla]
    ([DolphinRefinement.tla]), and their states of the right types; or TLC's error, with the program. *)

val report : Installation.t -> limit:int -> batch:int -> Case.t list -> Comparison.count
(** [report i ~limit ~batch cases] is {!theorems}, and {!programs} of those of [cases] that have at most [limit]
    states, [batch] at a time; with a line for the result. *)
