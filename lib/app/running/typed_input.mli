(** Inputs as people type them. *)

open Dolphin_semantics

val read : string -> ((string * Core.value) list, string) result
(** [read text] is the pairs in [text]: [abort: true], [target: [1, 2], go: 'north']; a key alone stands for [true], and
    so does [yes], as [no] for [false]. Values are data, written as in fleets. Or what is wrong with it. *)

val declared : Core.program -> questions:string list -> string -> (unit, string) result
(** [declared p ~questions key] is the reason why pairs with this key cannot be posted to a run of [p] now, if any:
    it is neither an input that [p] declares, nor one of the prompts of the open [questions]. *)

val is_of_kind : Core.program -> string -> Core.value -> bool
(** [is_of_kind p key x] is whether [x] may be a value of the input [key]: if [p] declares it [of: 'vehicle'], only a
    set of one vehicle may. *)

val fits : Core.program -> string -> Core.value -> (unit, string) result
(** [fits p key x] is why [x] cannot be posted with a key that is {!declared}, if so: questions take yes or no, and
    inputs values that are {!is_of_kind}. *)
