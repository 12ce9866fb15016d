(** The successors of states, computed once: the searches for the latest and for the earliest dates meet the same
    states, and so do displayed runs. *)

type t

(** The reductions: docs/time.md. *)
type reduction = Nothing | Inert_ends | Inert_ends_and_likeness

val create : ?course:Course.t -> reduction -> Timed.options -> t
(** [create ~course r o] knows nothing yet. The vehicle of [course] is like no other, and its ends are not inert. *)

val options : t -> Timed.options
val course : t -> Course.t option

val likeness : t -> Likeness.t option
(** [None] if states that are alike are not taken for one. *)

val inert : t -> Timed.state -> Inert.item list
(** [inert t s] is the inert ends of [s] that are left out. *)

type successor = {
  step : Timed.step;
  inert : Inert.item list Lazy.t;  (** in the state that it leads to *)
  spelled : Likeness.execution -> Likeness.spelled;  (** that state, which belongs to the execution *)
}

val all : t -> Timed.state -> successor list
(** [all t s] is {!Timed.all_steps} of [s].
    @raise Dolphin_environment.Environment.Unclear *)

val followed : t -> Timed.state -> successor list
(** [followed t s] is {!Timed.steps} of [s], reduced in the same way. *)

val steps : t -> Timed.state -> Timed.step list
(** Those of {!followed}. *)
