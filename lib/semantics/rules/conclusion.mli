(** The conclusion of a rule: a transition. *)

type t = {
  rules : Rule.t list;  (** the derivation, from the axiom outwards *)
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;  (** in the order in which they are to be carried out *)
  assumed : World.assumption list;  (** its assumptions about an open world; otherwise nothing *)
  otherwise : World.assumption list list;  (** other assumptions with the same conclusion *)
}

val make : ?effects:Effect.t list -> Rule.t -> Label.t -> Configuration.control -> Shared.t -> t
(** [make rule l k s] is the transition by [rule] alone, labelled [l], to <k, s>. *)

val begun : Residual.begun list -> Effect.t list
(** To set the timers, and put the questions. *)

(** {1:ends Ends} *)

val cut : (Residual.timer * Residual.wait) list -> Shared.t -> Effect.t list
(** [cut waits s] ends [waits] and stops all that A runs. *)

val ended : Shared.t -> Configuration.ending -> Configuration.t
(** [ended s e] is the end [e] of a run with shared part [s]: A and B are empty, and N is without pairs
    of the keys of [fresh]. *)

val ending :
  ?waits:(Residual.timer * Residual.wait) list -> ?recruits:Core.vehicle list -> ?before:Effect.t list -> Rule.t list ->
  Label.t -> Shared.t -> Configuration.ending -> t
(** [ending ~waits ~recruits ~before rules l s e] is the transition to [ended s e]. After the effects [before] it
    ends those of
    [waits] (none by default) that [before] does not end, stops all that A runs,
      and releases B and those of [recruits] (none by
    default) that [before] does not release. *)
