(** Going through runs of an implementation: along given traces, and through all that there are. Everything here may
    raise {!Dialogue.Trouble}. *)

module Rules : Set.S with type elt = string
(** Sets of rules, by their names. *)

type found = (unit, string) result * Rules.t
(** The fault, in a sentence without a full stop; and the rules of the transitions that were taken. *)

val trace : Dialogue.ask -> Dialogue.place -> Case.step list -> found
(** [trace ask place steps] checks that the run in which the leftmost transition is taken, and events come as in
    [steps], is [steps], and that no further step follows. *)

val admits : Dialogue.ask -> Dialogue.place -> Case.step list -> found
(** [admits ask place steps] checks that some run begins with [steps]. *)

val forbids : Dialogue.ask -> Dialogue.place -> Case.step list -> found
(** [forbids ask place steps] checks that some run begins with all of [steps] but the last, and none with all. *)

(** The outcomes of all runs. *)
type all = {
  outcomes : Case.outcome list;  (** each once; ["stuck"] are those that do not end and cannot go on *)
  rules : Rules.t;
}

val all : Dialogue.ask -> Case.environment -> Dialogue.place -> (all, string) result
(** An error if there are too many configurations. *)
