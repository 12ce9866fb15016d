(** Which steps of an executing configuration are enough: a persistent set. docs/explorer.md says why. *)

(** What a step of a part does where it stands. *)
type status =
  | Impossible
  | Moves
  | Ends  (** the run *)
  | Depends of { moves : bool; ends : bool }
  (** on what sensors show, that may show anything: whether it may move, whether it may end the run *)

val choose : Components.t array -> (int -> int -> status) -> (int -> int -> bool) option
(** [choose parts status] is, for the parts that stand side by side, which of the steps that move are enough, or
    [None] if all are needed. Steps are told by position of their part, and place in its [footprints]. [status] is
    asked only as far as needed. Steps that end the run are to be taken in any case, as far as they end it. *)
