(** Values of N that no step depends on: their keys' pairs are only taken by [_], and given to code that makes a
    task. This code may only print them, use them in names of plans, and post them under such keys again. It makes no
    difference to any step which of them there are, so all of them may as well be one. docs/explorer.md has the
    proof. *)

open Dolphin_semantics
open Dolphin_environment

val unify : Environment.options -> Core.program -> Core.program option
(** [unify o p] is [p] as if it posted one value only under each of these keys, if it has such keys. It goes in step
    with [p]: in each configuration it has the same transitions, in the same order, but for that value. *)
