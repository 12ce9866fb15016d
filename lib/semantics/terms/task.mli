(** The parts of a task: traversals that need no rule of a constructor are functions of them. *)

open Core

(** A function for each kind of part. *)
type mapper = { part : task -> task; code : closure -> closure; vehicle : vehicle -> vehicle }

val map : mapper -> task -> task
(** [map m t] is [t] with each part replaced by its image: the tasks directly in it, code, and the vehicles of [T[V]].
    The functions are applied once a part, from left to right. *)

val parts : task -> task list
(** [parts t] is the tasks directly in [t], from left to right: of [t1 >> t2], [t1] and [t2]. Those that code would
    give are not seen. *)
