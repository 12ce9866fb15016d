(** Small programs for cases that random ones seldom meet: each is about a frequent mistake. *)

val loops : Case.t list
(** Those in which a transition may leave all as it is, so that a run without end may look as if it stood still. *)

val verdicts : Case.t list
(** {!loops}, some that end because an awaited event comes, and one that is stuck: on these TLC's own verdicts depend
    on the specification's whole definition of runs. *)

val all : Case.t list
(** These, and those about tasks, questions, calls, interruptions, sensors, losses and vehicles that are late. *)
