(** Bitstate hashing (Holzmann, {e An analysis of bitstate hashing}, 1998): an array of bits in place of a set of
    states. A state is {e marked} by setting the bits that hash functions give for it. A state whose bits are all set
    passes for a marked one, though others may have set them: then it is {e omitted}. *)

type t

val create : bytes:int -> t
(** [create ~bytes] has [8 * bytes] bits, one byte at least. *)

val hashes : int
(** How many hash functions there are. *)

val bytes : t -> int
(** The length of the array, in bytes. *)

val states : t -> int
(** How many states were marked. *)

(** {1:state The present state}

    It is known by numbers: after {!begin_state}, each is given by {!add}, in order. *)

val begin_state : t -> unit
(** From now on {!add} is for another state, of which no number is known yet. *)

val add : t -> int -> unit
(** [add t n] adds [n] to the numbers of the present state. *)

val hash : t -> int
(** One hash of it, with many bits. *)

val is_marked : t -> bool
(** Whether it is marked, or passes for it. *)

val mark : t -> unit
(** [mark t] marks it; it must not be. *)

(** {1:omission What is left out} *)

(** The outcome of a search by bitstate hashing. *)
type summary = {
  bytes : int;
  states : int;
  filled : float;  (** the share of bits that are set *)
  omitted : float;
  (** how many states are expected to be omitted of those that the search came to: a new one is with chance [f^k] where
      the share [f] of bits is set, of [k] hash functions *)
  omission : float;  (** the chance that any is *)
}

val summary : t -> summary
(** Of what was marked so far. Hash functions are taken to be independent, and states omitted to lead to no others. *)
