(** Random walks through a state graph: their choices, and an estimate of the unvisited states. The states that a
    visited one leads to are {e seen}. *)

type t

val create : seed:int -> t
(** [create ~seed] has drawn nothing and visited no state. *)

(** {1:chance Chance} *)

val draw : t -> int -> int
(** [draw t n] is a number from 0 on, below [n]. The same numbers are drawn with the same seed, by every version of the
    compiler. *)

(** {1:states States} *)

val see : t -> int -> from:int -> unit
(** [see t i ~from:j] notes that state [i] has been seen first, from [j]. *)

val from : t -> int -> int
(** [from t i] is the state from which [i] was seen first. *)

val begin_walk : t -> unit
(** Counts one walk more. *)

val is_new : t -> int -> bool
(** [is_new t i] is whether [i], which is seen, has not been visited. *)

val visited : t -> int
(** How many states were visited. *)

val visit : t -> int -> unit
(** [visit t i] counts that a walk is in state [i]. *)

(** {1:estimates Estimates} *)

(** The outcome of random walks. *)
type summary = {
  seed : int;
  walks : int;
  steps : int;  (** visits *)
  visited : int;  (** states *)
  unvisited : float;
  (** Good and Turing's estimate of the chance that a visit is to a state not visited before: the share of the visits
      that were the only one of their state *)
  states : float;
  (** Chao's estimate of how many states walks can visit, which is rather too low: [visited + f1 (f1 - 1) / 2 (f2 + 1)]
      where [f1] states were visited once and [f2] twice; but at least as many as were seen *)
}

val summary : t -> seen:int -> summary
(** [summary t ~seen] is for [seen] states, visited or not. Nothing is estimated where all that were seen were
    visited. *)
