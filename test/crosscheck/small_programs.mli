(** Small programs for what random ones seldom meet: each is about what goes wrong most easily somewhere. *)

val loops : Case.t list
(** Those in which a transition may leave all as it is, so that a run that goes on for ever may look as if it stood
    still. *)

val verdicts : Case.t list
(** {!loops}, some that end because what they wait for comes, and one that is stuck: on these TLC's own verdicts
    depend on all that the specification says of runs. *)

val all : Case.t list
(** These, and those about tasks, questions, calls, interruptions, sensors, losses and vehicles that are late. *)
