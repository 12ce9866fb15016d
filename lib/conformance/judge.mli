(** Judging an implementation by a case of the corpus. *)

(** A deviation from the expectation. *)
type failure = {
  kind : string;  (** the expectation: ["trace"]; or ["covers"]; or ["implementation"], which did not answer *)
  why : string;  (** one sentence without a full stop *)
}

(** The judgement of a case: the failed expectations, and the rules that were taken, sorted. *)
type verdict = { failures : failure list; rules : string list  (** that were taken, sorted *) }

val judge : Dialogue.ask -> Case.t -> verdict
(** [judge ask case] checks every expectation of [case]. *)

val passes : Case.t -> verdict -> bool
(** [passes case verdict] is whether [verdict] is as it should be: without failures, or for a case that must fail with
    failures of just those kinds. *)
