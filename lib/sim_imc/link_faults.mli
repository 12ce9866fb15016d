(** The effects of a bad link on datagrams, each by itself: some are lost, some come twice, some are held back so
    that later ones overtake them, all are late. *)

type t = {
  loss : float;  (** how often, from 0 to 1; and so on *)
  duplication : float;
  reordering : float;  (** how often one is held back, for {!held_back} *)
  delay : float * float;  (** at least, at most, seconds *)
}

val none : t
(** Every datagram arrives once, at once. *)

val held_back : float * float
(** 10 ms to 100 ms. *)

val delays : seed:int -> link:string -> number:int -> t -> float list
(** [delays ~seed ~link ~number f] is the delay of each copy of the [number]-th datagram on [link] that arrives: of
    none, if it is lost. Nothing else decides about it; so a datagram's luck is the same in each run. *)
