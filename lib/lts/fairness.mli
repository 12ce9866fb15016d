(** Strongly connected components, and runs that never end: a prefix, and a cycle that is repeated for ever. *)

type t
(** The components of a graph, or of the part of it that some transitions form. They are numbered from 0; a transition
    between two leads to the lower number. Nothing here takes stack. *)

val components : ?keep:(int -> int -> int -> bool) -> Graph.t -> t
(** [components g] is the strongly connected components of the states of [g] that can be reached. With [keep], only
    transitions for which [keep s l s'] holds are there, and the states that the initial one reaches by {e all}
    transitions. It takes linear time. *)

val count : t -> int

val component : t -> int -> int option
(** [component c s] is the component of state [s], or [None] if [s] cannot be reached. *)

val size : t -> int -> int
val iter_states : t -> int -> (int -> unit) -> unit

val iter_inside : t -> int -> (int -> int -> int -> unit) -> unit
(** [iter_inside c i f] is [f s l s'] for each (kept) transition within component [i]. *)

val cyclic : t -> int -> bool
(** Whether there is a transition within the component: a run can stay in it for ever. *)

val closed : t -> int -> bool
(** Whether no (kept) transition leaves the component. *)

type lasso = {
  prefix : Reachability.run;  (** from the initial state *)
  cycle : Reachability.run;  (** from where the prefix ends, back to it; never empty *)
}

val lasso : ?through:(int -> int -> int -> bool) -> t -> (int -> bool) -> lasso option
(** [lasso c p] is a shortest run into a cyclic component for which [p] holds, and there a shortest cycle from where it
    enters; [None] if there is no such component. The prefix takes any transitions, the cycle those that were kept. If
    [through] is given, the cycle takes every transition of the component for which [through s l s'] holds; then it
    need not be shortest, and takes time for each of those transitions. So a run that is fair in that each of some
    actions occurs again and again is found with a [p] that accepts the components that have them all, and these
    actions as [through]. *)

val pp_lasso : Format.formatter -> lasso -> unit
(** The labels: [a b (c d) for ever]. *)
