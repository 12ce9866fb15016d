(** A network that loses, doubles and delays datagrams. *)

type quality = {
  loss : float;  (** share of datagrams *)
  duplication : float;  (** share of datagrams *)
  delay : float;  (** greatest, s; each datagram has its own, so that they overtake one another *)
}

type 'a t

val create : Random.State.t -> quality -> 'a t
val send : now:float -> 'a -> 'a t -> unit

val arrived : now:float -> 'a t -> 'a list
(** What arrived until [now] and was not taken yet, in order. *)
