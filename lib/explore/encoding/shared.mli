(** What the parts of an executing task share: the store, N, B, and what the outside remembers. *)

open Dolphin_semantics
open Dolphin_environment

type t = {
  store : Store.t;
  tuples : Tuples.t;
  bound : Core.vehicle list;
  outside : Environment.t;
}

val equal : t -> t -> bool
val hash : t -> int

val of_configuration : Configuration.t -> Environment.t -> t

val under : Configuration.control -> t -> Configuration.t
(** [under control s] is [s] as a configuration in which no task runs. *)
