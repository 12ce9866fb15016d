(** Which steps of an executing configuration are enough: a persistent set, as far as what is cut off allows.
    docs/explorer.md says why. *)

(** What becomes of a component that moves: something takes its place (level 0), or that of the nest so many levels
    above, or it is [gone]. *)
type landing = { level : int; gone : bool }

(** What a step does where it stands. *)
type status =
  | Impossible
  | Moves of landing
  | Ends  (** the run *)
  | Depends of { moves : landing list; ends : bool }
  (** on what sensors show, that may show anything: how it may move, whether it may end the run *)

(** A part, or a nest with its cuts. *)
type component = { place : Layout.place; analysis : Step_footprints.t }

val choose : component array -> (int -> int -> status) -> (int -> int -> bool) option
(** [choose components status] is which of the steps that move are enough, or [None] if all are needed. Steps are told
    by index of their component, and place in its [footprints]. [status] is asked only as far as needed. Steps that end
    the run are to be taken in any case, as far as they end it. *)
