(** The surroundings of the components of an executing task: the shared part of the configuration, and the
    environment's memory. A is empty here, since the components contain the running tasks. *)

open Dolphin_semantics
open Dolphin_environment

type t = { shared : Shared.t;  (** with an empty A *) outside : Environment.t }

val make : Shared.t -> Environment.t -> t
(** [make s e] is [s], less its A, and [e]. *)

val equal : t -> t -> bool
(** Whether the shared parts and the memories are the same. *)

val hash : t -> int
(** Equal surroundings have equal hashes. *)

(** Numbers for surroundings, from 0: the shared states that the encoding speaks of. *)
module Numbers : sig
  type surroundings := t
  type t

  val create : Dolphin_checker.Numbering.t -> t
  (** No surroundings have a number. *)

  val number : t -> surroundings -> int
  (** [number t s] is the number of [s], a new one if [s] is new. @raise Dolphin_checker.Numbering.Closed then, if
      numberings are closed *)

  val value : t -> int -> surroundings
  (** [value t n] is the surroundings with number [n]. *)

  val count : t -> int
  (** The number of surroundings so far. *)
end
