(** The groups of all tasks that a program executes, each found when the task is about to be executed. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create : Environment.options -> Core.program -> Symmetry.shareds -> t

exception Unclear
(** The same handler of errors can change places with others in one execution and not in another. If one of them has run,
    it is then not known whether the others do. *)

val find : t -> Residual.t -> Shared.t -> Symmetry.t option
(** [find f r s] is for [r], about to be executed where [s] is shared; [None] if nothing can change places. Groups are
    numbered from 1; equal ones have the same number.
    @raise Unclear *)

val handlers_alike : t -> (Task_isomorphism.label list -> unit) -> unit
(** [handlers_alike f note] calls [note] with handlers that all run in some run if one of them does. *)

val is_used : t -> bool
(** Whether there is any group. *)
