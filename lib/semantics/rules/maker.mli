(** Code that makes tasks: in the place of a task, and in [fresh]. It may only compute. *)

open Core

val deepest : int
(** The limit on closures in tasks that closures give, and on [fresh] in a task of [fresh]. *)

val task_of :
  closure -> value list -> depth:int -> Shared.t -> Shared.t -> value -> Code.deed list -> (task, Fault.t) result
(** [task_of code given ~depth s s' x ds] is the task that [code] gives, which ran in [s] with the arguments [given]: it
    computed [x], did [ds], and left [s']. It is a fault if [x] is not a task, if the code did anything, or if [depth]
    is too deep. *)

val opened :
  ?held:vehicle list Lazy.t -> program -> World.t -> Shared.t -> numbers:Residual.timer Seq.t -> depth:int -> task ->
  (World.t * (Allocation.opened, Fault.t) result) Decision.t
(** [opened p w s ~numbers ~depth t] is the task of each [fresh] in [t], and of those inside of it, with keys of the
    first of [numbers], in the world that the code has seen. The fault is that of the first code that fails. *)
