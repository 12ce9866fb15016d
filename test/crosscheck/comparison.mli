(** Many programs, given to TLC and to the explorer; the results are printed. *)

open Dolphin_tlc

type count = { programs : int; failures : int }

val passed : count -> bool
(** Something was compared, and all agreed. *)

val thousands : int -> string
(** ["12,568"]. *)

val batches : int -> 'a list -> 'a list list
(** [batches n xs] is [xs] by [n]s, in their order; the last batch may be smaller. *)

val in_halves : ('a list -> int) -> 'a list -> int
(** [in_halves f xs] is [f] of the first half of [xs] plus [f] of the rest, in this order: to find the few programs of
    many at which TLC fails. *)

val prepare : limit:int -> Case.t list -> Batch.prepared list
(** Those of the programs that can be given to TLC, and have at most [limit] states. *)

val graphs : string -> Installation.t -> limit:int -> batch:int -> Case.t list -> count
(** [graphs title i ~limit ~batch cases] compares the state graphs of [cases], [batch] programs at a time, and prints
    a line of them all, after one for each difference. *)

val verdicts : Installation.t -> Case.t list -> count
(** [verdicts i cases] compares TLC's own verdicts with the explorer's, on those of [cases] that have at most 300
    states: TLC takes minutes for the temporal properties of some programs of a thousand. *)
