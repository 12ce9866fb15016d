(** The surroundings of the components of an executing task: the shared part of the configuration, and the
    environment's memory. A is empty here, since the components contain the running tasks. *)

open Dolphin_semantics
open Dolphin_environment

type t = { shared : Shared.t;  (** with an empty A *) outside : Environment.t }

val make : Shared.t -> Environment.t -> t
(** [make s e] is [s], less its A, and [e]. *)

val equal : t -> t -> bool
val hash : t -> int

(** Numbers for surroundings, from 0: the shared states that the encoding speaks of. *)
module Numbers : sig
  type surroundings := t
  type t

  val create : Dolphin_checker.Numbering.t -> t
  val number : t -> surroundings -> int
  val value : t -> int -> surroundings
  val count : t -> int
end
