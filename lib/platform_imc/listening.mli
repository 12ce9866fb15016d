(** The consequences of datagrams: the announced systems, their reports, the holdings of other consoles. *)

open Dolphin_semantics
open Station_state

val datagram : now:float -> from:Unix.inet_addr -> ?len:int -> string -> t -> t * output list
(** {!Station.datagram} *)

val most_nodes : int
(** The number of systems that are known at once. *)

val take_over : now:float -> Node.t -> Station_state.t -> Station_state.t * Station_state.output list
(** [take_over ~now n s] takes the action for the expected vehicle [n], if it has reported its plan and its holder is
    known. *)

val let_go : now:float -> Core.vehicle list -> Station_state.t -> Station_state.t
(** [let_go ~now vs s] is [s] after another console may have released [vs]. *)
