(** Random programs that pick vehicles, give them tasks and release them, in worlds with vehicles that are alike. *)

open Dolphin_semantics

type t = { text : string; world : string * World.t; invariant : string  (** a condition to check *) }

val worlds : (string * World.t) list
(** By their fleet entries. *)

val gen : t QCheck2.Gen.t
(** Few of them distinguish vehicles that are alike: by name, order, place or battery. A third have a supplier. *)

val replies : string -> (Core.value, string) result list list
(** The supplier's replies to a call, as in [Environment.options]: vehicles [b] and [c] and their names among it. *)

val print : t -> string
