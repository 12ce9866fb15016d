(** The successors of states, computed once: the searches for the latest and for the earliest dates meet the same
    states, and so do displayed runs. *)

type t

(** The reductions: docs/time.md. *)
type reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

val create : ?course:Course.t -> reduction -> Clocked.options -> t
(** [create ~course r o] knows nothing yet. The vehicle of [course] is like no other, and its ends are not inert. *)

val options : t -> Clocked.options
(** The options of {!create}. *)

val course : t -> Course.t option
(** The course of {!create}. *)

val likeness : t -> Canonical_state.t option
(** [None] if states that are alike are not taken for one. *)

val inert : t -> Clocked.state -> Inert.item list
(** [inert t s] is the inert ends of [s] that are left out. *)

(** A step, with what is known of the state that it leads to. *)
type successor = {
  step : Clocked.step;
  inert : Inert.item list Lazy.t;  (** in the state that it leads to *)
  spelled : Canonical_state.execution -> Canonical_state.spelled;  (** that state, which belongs to the execution *)
}

val all : t -> Clocked.state -> successor list
(** [all t s] is {!Clocked.all_steps} of [s].
    @raise Dolphin_environment.Environment.Unclear *)

val ticking : t -> (unit -> unit) -> (unit -> 'a) -> 'a
(** [ticking t tick f] is [f ()], in which [tick] is called at each step that is computed. It may raise. *)

val tick : t -> unit -> unit
(** [tick t ()] is that of {!ticking}; nothing outside of it. *)

val followed : t -> Clocked.state -> successor list
(** [followed t s] is {!Clocked.steps} of [s], reduced in the same way. *)

val steps : t -> Clocked.state -> Clocked.step list
(** Those of {!followed}. *)
