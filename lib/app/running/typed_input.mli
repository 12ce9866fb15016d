(** Inputs as people type them. *)

open Dolphin_semantics

val read : string -> ((string * Core.value) list, string) result
(** [read text] is the pairs in [text]: [abort: true], [target: [1, 2], go: 'north']; a key alone stands for [true].
    Values are data, written as in fleets. Or what is wrong with it. *)

val declared : Core.program -> string -> (unit, string) result
(** [declared p key] is why nobody can post pairs with this key to runs of [p], if so. *)
