(** Skeletons of code: code without the pairs of N that it names one by one, and without texts for people. Found in
    the code with its captured values, without running it. *)

open Dolphin_semantics

type context
(** The skeletons of a program's code, memoised, and the numbers of its pairs. Mutable. *)

val context : Dolphin_checker.Numbering.t -> Core.program -> context
(** [context n p] is for the code of [p]; its numbers are of the numberings [n]. *)

(** {1:pairs Pairs of N} *)

val pair : context -> string -> Core.value -> int
(** [pair c k x] is a number for the pair [k: x]. *)

val key_of : context -> int -> string
(** [key_of c n] is the key of the pair with number [n]. *)

val value_of : context -> int -> Core.value
(** [value_of c n] is the value of the pair with number [n]. *)

val may_be_named : Core.value -> bool
(** [may_be_named x] is whether pairs with the value [x] can be renamed. *)

(** {1:skeletons Skeletons} *)

type t = {
  number : int;  (** code with the same number and the same pairs does the same *)
  pairs : int array;  (** those that the code names, in the order of its text *)
  fixed : Footprint.Pairs.t;  (** those that it may touch in other ways: they cannot be renamed *)
  unclear : bool;  (** it may do anything, or depend on an error's text *)
}

val of_code : context -> handler:bool -> Core.closure -> t
(** [of_code c ~handler f] is the skeleton of [f], which gets an error if it is a [handler]. Code that calls other code,
    or reads sensors, is opaque: no other code has its number. *)
