(** The parts of a task: traversals that need no rule of a constructor are functions of them. *)

open Core

(** A function for each kind of part. *)
type mapper = {
  part : task -> task;
  code : closure -> closure;
  value : value -> value;
  vehicle : vehicle -> vehicle;
}

val map_ensured : (value -> value) -> ensured -> ensured
(** [map_ensured f d] is [d] with [f x] for the value [x] in it. *)

val map : mapper -> task -> task
(** [map m t] is [t] with each part replaced by its image: the tasks directly in it, code, the values of [ensure],
    and the vehicles of [T[V]]. The functions are applied once a part, from left to right. *)

val parts : task -> task list
(** [parts t] is the tasks directly in [t], from left to right: of [t1 >> t2], [t1] and [t2]. Those that code would
    give are not seen. *)
