(** What a rule concludes: a transition. *)

type t = {
  rules : Rule.t list;  (** the derivation, from the axiom outwards *)
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;  (** in the order in which they are to be carried out *)
  assumed : World.assumption list;  (** what of an open world it takes for granted; otherwise nothing *)
}

val make : ?effects:Effect.t list -> Rule.t -> Label.t -> Configuration.control -> Shared.t -> t
(** [make rule l k s] is the transition by [rule] alone, labelled [l], to <k, s>. *)

val timers_started : (Residual.timer * float) list -> Effect.t list
(** To set these timers, with their seconds. *)

(** {1:ends Ends} *)

val cut : Residual.timer list -> Shared.t -> Effect.t list
(** [cut timers s] cancels [timers] and stops all that A runs. *)

val ended : Shared.t -> Configuration.ending -> Configuration.t
(** [ended s e] is the end [e] of a run with shared part [s]: A and B are empty. *)

val ending :
  ?timers:Residual.timer list -> ?before:Effect.t list -> Rule.t list -> Label.t -> Shared.t ->
  Configuration.ending -> t
(** [ending ~timers ~before rules l s e] is the transition to [ended s e]. After the effects [before] it cancels those
    of [timers] (none by default) that [before] does not cancel, stops all that A runs, and releases B. *)
