(** alloc(T, V): the vehicles of a task's parts, decided when [execute] starts, or when a task is made. See
    docs/semantics.md, "Allocation". *)

open Core

val fresh : task -> closure list
(** [fresh t] is the code of each [fresh] in [t], from left to right; not of those in tasks that such code gives. *)

(** The result of {!Maker.opened} for the [fresh] in a task. [tasks] has the numbers of its keys and its task
    for each of them, from left to right, followed by those inside of that task. [numbers] are left for timers,
    questions, recruits and places. *)
type opened = { tasks : (Residual.timer list * task) list; numbers : Residual.timer Seq.t }

val allocate : World.t -> vehicle list -> opened -> task -> ((Residual.t, Fault.t) result, World.question) result
(** [allocate w b o t] is [t], with [o] for its [fresh], and with a vehicle of [b] (B, in pick order) for each of its
    platform tasks, not yet activated. Branches of [|] get different vehicles, other parts may share and prefer to;
    [T[V]] restricts [T] to [V]; an inline plan's payload and vehicles are requirements. Of the feasible allocations
    it is the one with the fewest vehicles, then the least total straight-line distance from the vehicles' positions
    in [w] to the plans' reference positions, then by pick order. The fault names the task and the missing device. If
    [w] leaves open where a vehicle is, the question asks for it. *)

val allocate_made :
  World.t -> vehicle list -> opened -> Residual.request -> task ->
  ((vehicle list * Residual.t, Fault.t) result, World.question) result
(** [allocate_made w b o request t] is the vehicles of [b] that [t] gets, in pick order, and the rest of [t], as
    {!allocate} has it, within the vehicles that [request] allows. *)
