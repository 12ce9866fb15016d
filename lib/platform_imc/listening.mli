(** What follows from datagrams: who has announced, who said what, what other consoles hold. *)

open Station_state

val datagram : now:float -> from:Unix.inet_addr -> ?len:int -> string -> t -> t * output list
(** {!Station.datagram} *)

val most_nodes : int
(** So many systems are known at once. *)
