(** Methods that call a closure for each item of their subject, as [xs.collect { ... }] does. The machine makes the
    calls; this module chooses them, and combines their results. *)

open Core

val find : value -> string -> value list -> (Code.iteration * closure * value list) option
(** [find subject name arguments] is the method [name] of [subject], if it is one of these: with its closure, and the
    results to start from. *)

val items : value -> value array
(** [items subject] is the items of the calls, in order. *)

val arguments : Code.iteration -> closure -> value -> value -> int -> value list -> value list
(** [arguments iteration closure subject item index gathered] is the arguments of [closure] for [item]. One with two
    parameters gets the key and value of a map's entry, or the item and its index; [gathered] are the results so far,
    latest first. *)

val early : Code.iteration -> value -> value -> value option
(** [early iteration item result] is the method's value, if the result for [item] settles it. *)

val conclude : Code.iteration -> value -> value array -> value list -> (value, string) result
(** [conclude iteration subject items gathered] is the method's value once every item had its call. *)
