(** What surrounds the parts of an executing task: the shared part of the configuration, and what the outside remembers.
    A is left out, for the parts say what they run: it is empty here. *)

open Dolphin_semantics
open Dolphin_environment

type t = { shared : Shared.t;  (** with an empty A *) outside : Environment.t }

val make : Shared.t -> Environment.t -> t
(** [make s e] is [s], less its A, and [e]. *)

val equal : t -> t -> bool
val hash : t -> int
