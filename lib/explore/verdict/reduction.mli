(** How much of a state space is looked at. docs/explorer.md says what each reduction keeps, and why. *)

type t =
  | Whole  (** every state *)
  | Partial_order
  (** of orders in which independent steps may come, one. All verdicts are as of the whole; a run that shows a
      violation may be longer than the shortest. *)
  | Symmetry  (** of states that differ by exchanging things that are alike, one. All verdicts are as of the whole. *)
  | All  (** both *)

val by_order : t -> bool
val by_symmetry : t -> bool
val without_symmetry : t -> t

val names : t -> string list
(** Of the reductions: ["partial order"], ["symmetry"]. *)
