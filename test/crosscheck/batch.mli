(** TLC and the explorer side by side, on several programs at once. *)

open Dolphin_tlc

type verdict =
  | Agrees  (** isomorphic graphs, with equal labels, effects, derivations and ends *)
  | Differs of Dolphin_lts.Isomorphism.difference  (** left is the explorer's graph *)
  | Not_printed  (** TLC printed no state of it *)

type result = {
  name : string;  (** of the case *)
  source : string;
  states : int;
  transitions : int;
  verdict : verdict;
}

type t = {
  results : result list;
  warnings : string list;  (** the warnings of SANY and TLC *)
  used : string -> int;  (** in how many of TLC's transitions the rule of this name stands in the derivation *)
  counted : Action_counts.count list;  (** by TLC itself, if it was to *)
}

type prepared
(** A program, translated and explored. *)

type unfit =
  | Refused of string  (** by the translation: why *)
  | Too_large
  | Unsettled of string  (** more than comparisons depends on a sensor: why the explorer gives up *)

val prepare : limit:int -> Case.t -> (prepared, unfit) Stdlib.result
(** [prepare ~limit c] explores at most [limit] states. *)

val case : prepared -> Case.t
val constants : prepared -> Family.constant list

val states : prepared -> int
val transitions : prepared -> int
(** How many of each the explorer found. *)

val uses : prepared -> Dolphin_semantics.Rule.t -> bool
(** Whether the rule stands in the derivation of some transition that the explorer found. *)

val run :
  ?coverage:bool -> Installation.t -> specification:(string * string) list -> prepared list -> (t, string) Stdlib.result
(** [run i ~specification ps] is the result, or TLC's error. Counts of TLC that differ from its printed graph are
    wrong too. With [coverage], TLC takes an action for each rule, and counts them. *)

val in_directory : (string * string) list -> (string -> 'a) -> 'a
(** [in_directory files f] is [f d] where [d] is a directory with these files, which is gone afterwards. *)
