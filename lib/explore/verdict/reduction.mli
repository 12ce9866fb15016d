(** The explored part of a state space. docs/explorer.md defines and justifies the properties that each reduction
    preserves. *)

type t =
  | Whole  (** every state *)
  | Vehicles
  (** one state of each class that exchanging vehicles identifies. All verdicts, and the lengths of shortest runs, are
      as of the whole. *)
  | Partial_order
  (** one of the orders in which independent steps may come. All verdicts are as of the whole; a run that shows a
      violation may be longer than the shortest. *)
  | Symmetry  (** one state of each class that symmetry identifies. All verdicts are as of the whole. *)
  | All  (** both *)

val by_order : t -> bool
(** Whether it leaves out orders of independent steps. *)

val by_symmetry : t -> bool
(** Whether it leaves out states that are others up to symmetry. *)

val without_symmetry : t -> t
(** [without_symmetry r] is [r], but for symmetry. *)

val names : t -> string list
(** Of the reductions: ["partial order"], ["symmetry"]. *)
