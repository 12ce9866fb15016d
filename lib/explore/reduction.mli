(** How much of a state space is looked at. docs/explorer.md says what each reduction keeps, and why. *)

type t =
  | Whole  (** every state *)
  | Partial_order
  (** of orders in which independent steps may come, one. All verdicts are as of the whole; a run that shows a
      violation may be longer than the shortest. *)
