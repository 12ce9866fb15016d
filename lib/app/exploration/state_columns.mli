(** States in columns, as [dolphin successors] writes them: numbers of the same kind side by side, so that other
    programs handle them many at a time. *)

type t

val create : unit -> t
(** No states. *)

(** A state as others know it. *)
type state = {
  digest : string;  (** of [text]; 16 bytes *)
  parent : string;  (** the first 8 bytes of the digest of a state that leads here *)
  kind : int;  (** a byte, as in docs/successors.md *)
  text : string;
}

val add : t -> state -> unit
(** [add c s] adds [s] after the others. *)

val count : t -> int
(** The number of states. *)

val states : t -> state list
(** [states c] is the states added to [c], in that order. *)

val write : out_channel -> t -> unit
(** [write out c] writes how many bytes [c] takes, and [c]. *)
