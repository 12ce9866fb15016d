(** Calls of a supplier in random programs. *)

open Dolphin_semantics

val within : Dolphin_syntax.Ast.program QCheck2.Gen.t -> Dolphin_syntax.Ast.program QCheck2.Gen.t
(** [within programs] is programs that call a supplier in between, after their picks: for values, truth values,
    objects and tasks, and, as a fault, in task code. The global [g] must have a value. *)

val names : string list
(** The calls that have replies. *)

val replies : string -> (Core.value, string) result list list
(** By name of the call, the possible replies at each time, the last for all later ones: as fleets and explorers have
    it. Not every call has a reply. *)

val answering : Dolphin_environment.Environment.options
(** The default, in which questions are answered by 1 or 2 at first and by 0 later, and calls by {!replies}. *)
