(** Code up to names: what two pieces of code have in common that differ only in the pairs of N they name one by one,
    and in
    texts for people. Found in the code, with what it has captured, without running it. *)

open Dolphin_semantics

type context

val context : Core.program -> context

(** {1:pairs Pairs of N} *)

val pair : context -> string -> Core.value -> int
(** [pair c k x] is a number for the pair [k: x]. *)

val key_of : context -> int -> string
val value_of : context -> int -> Core.value

(** {1:patterns Patterns} *)

type t = {
  skeleton : int;
  (** all of the code but its pairs and texts: where it is the same, and the pairs are, the code does the same *)
  pairs : int array;  (** that the code names, in the order of its text *)
  fixed : Footprint.Pairs.t;  (** pairs that it may touch in other ways *)
  unclear : bool;  (** it may do anything, or depend on what an error says *)
}

val of_code : context -> handler:bool -> Core.closure -> t
(** [of_code c ~handler f] is the pattern of [f], which gets an error if it is a [handler]. Code that calls other code,
    or reads
    sensors, is like no other. *)
