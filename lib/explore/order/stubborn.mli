(** Which steps of an executing configuration are enough: a stubborn set, for components that may be cut off.
    docs/explorer.md proves it. *)

(** The part that a step changes: the component itself (level 0), or the nest that many levels above. That is
    replaced, or is [over]. If a round of a [repeat] without a number of rounds begins, the step [closes] a cycle,
    perhaps. It is taken by itself, or [on_event]. *)
type move = { level : int; over : bool; closes : bool; on_event : bool }

(** The effect of a step at its place. *)
type status =
  | Impossible
  | Moves of move
  | Ends  (** the run *)
  | Depends of { moves : move list; ends : bool }
  (** on open sensors: how it may move, whether it may end the run *)

(** A component, or a nest with its cuts: its place, and the footprints of its steps. *)
type component = { place : Layout.place; analysis : Step_footprints.t }

val choose : component array -> posts:Footprint.t -> (int -> int -> status) -> (int -> int -> bool) option
(** [choose components ~posts status] is which of the steps that move are enough, or [None] if all are needed. A step
    is given by the index of its component, and its index in [footprints] there. [status] is asked only as far as
    needed. [posts] is the footprint of all inputs that may still come: if all steps are needed, so are these. Steps
    that end the run are to be taken in any case, as far as they end it. *)
