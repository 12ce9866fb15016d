(** Which steps of an executing configuration are enough: a persistent set, as far as what is cut off allows.
    docs/explorer.md says why. *)

(** What a step does where it stands. *)
type status =
  | Impossible
  | Moves of { level : int; gone : bool }
  (** something takes the place of the component (level 0), or of the nest so many levels above, or it is [gone] *)
  | Ends  (** the run *)

(** A part, or a nest with its cuts. *)
type component = { place : Shape.place; analysis : Components.t }

val choose : component array -> (int -> int -> status) -> (int -> int -> bool) option
(** [choose components status] is which of the steps that move are enough, or [None] if all are needed. Steps are told
    by index of their component, and place in its [footprints]. [status] is asked only as far as needed. Steps that end
    the run are to be taken in any case. *)
