(** For how long vehicles are under way, at most: from the start of a task until its end. *)

open Dolphin_semantics

type t = (Core.vehicle * int) list
(** Milliseconds, in all, for each vehicle; {!unknown} without a bound. *)

val unknown : int
(** The greatest integer: there is no bound. *)

val of_step :
  Clocked.options -> Zone_node.t -> Zone.t -> Zone_node.arrow -> Canonical_state.execution option -> t
(** [of_step o before zone arrow e] is the count for [arrow], which is taken in [zone] of [before] and leads to the
    execution [e]: of the tasks that it ends, the greatest values of their clocks. Inert ends are counted as they
    begin; tasks that automorphisms map to others, all at the beginning of the execution, as often as they may run. *)
