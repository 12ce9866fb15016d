(** The systems that have announced themselves, by IMC address and by name. *)

open Dolphin_semantics

type t

val none : t
(** No system has announced itself. *)

val find : Core.vehicle -> t -> Node.t option
(** [find name x] is the system that announced itself last under [name]. *)

val find_id : int -> t -> Node.t option
(** [find_id id x] is the system with the IMC address [id]. *)

val announced : Node.t -> t -> t
(** [announced n x] is [x] after [n] announced itself: its name is its own from now on. *)

val update : Node.t -> t -> t
(** [update n x] is [x] with [n] in place of the earlier state of that system; its name is as before. *)

val taken : now:float -> id:int -> Core.vehicle -> t -> Node.t option
(** [taken ~now ~id name x] is the system other than [id] that has the name, and was heard of in the last
    {!Node.absence} seconds. *)

val remove : Node.t -> t -> t
(** [remove n x] is [x] without [n]. *)

val cardinal : t -> int
(** How many there are. *)

val exists : (Node.t -> bool) -> t -> bool
(** Whether some system is so. *)

val to_list : t -> Node.t list
(** All systems, by IMC address. *)
