(** The groups of automorphisms of all tasks that a program executes ({!Task_group}). The group of an execution fixes
    every N with which it is seen to begin, so a configuration in which a task executes has one group, wherever the task
    began. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create : tick:(unit -> unit) -> Environment.options -> Core.program -> Symmetry.t -> Task_group.shareds -> t option
(** [create ~tick o p s n] is [None] if [s] exchanges no subtasks. [tick] is called repeatedly where {!find} takes
    long; its exceptions pass through [find]. *)

val find : t -> Residual.t -> Surroundings.t -> Task_group.t option
(** [find f r s] is the group of [r], about to be executed with shared [s]; [None] if it is trivial. Groups are numbered
    from 1; equal ones have the same number.
    @raise Symmetry.Broken if it is not what it was for the same execution before, or if an error handler is exchanged
    with others in one execution and not in another: once it has run, it would not be known whether the others do. *)

val equivalent_handlers : t -> (Task_isomorphism.label list -> unit) -> unit
(** [equivalent_handlers f note] calls [note] with each orbit of handlers: if one of them runs in some
    run, each does. *)

val is_used : t -> bool
(** Whether some group is not trivial. *)
