(** What follows from datagrams: who has announced, who said what, what other consoles hold. *)

open Dolphin_semantics
open Station_state

val datagram : now:float -> from:Unix.inet_addr -> ?len:int -> string -> t -> t * output list
(** {!Station.datagram} *)

val most_nodes : int
(** So many systems are known at once. *)

val take_over : now:float -> Node.t -> Station_state.t -> Station_state.t * Station_state.output list
(** [take_over ~now n s] does what was intended for the expected vehicle [n], if it has said what it runs and it is
    known who holds it. *)

val let_go : now:float -> Core.vehicle list -> Station_state.t -> Station_state.t
(** [let_go ~now vs s] is [s] after another console may have released [vs]. *)
