(** What a search for the earliest dates has found, without the search: another process can send it. *)

open Dolphin_semantics
module Limits = Dolphin_checker.Limits

type 'run t = {
  endings : (Timed_system.ending * Timed_system.date) list;
  tasks : (Timed_system.task * (Timed_system.moment * Timed_system.date) list) list;
  missed : (Core.site * Timed_system.date) list;  (** the [within] that are missed in some run *)
  first : 'run option;  (** one that ends first *)
  stopped : Limits.bound option;
  states : int;
  depth : int;
  bytes : int;
}

val nothing : Limits.bound -> 'run t
(** [nothing bound] is of a search that has not even begun, because of [bound]. *)

val with_run : ('a -> 'b) -> 'a t -> 'b t
(** [with_run f e] is [e] with [f] of its run. *)
