(** The values that a fleet file is written with. Nothing is computed in it: numbers with or without a unit, texts and
    places that have a name. *)

open Dolphin_syntax

(** The dimension of a number with a unit. *)
type dimension = Length | Time | Speed | Angle | Share

type t =
  | Number of float * dimension option
  (** in metres, seconds, metres per second, degrees or shares of 1; [None]: without a unit *)
  | Text of string
  | Position of Dolphin_geo.Position.t
  | Unknown  (** the word [unknown]: a value that a vehicle does not report *)

val dimension : string -> dimension option
(** [dimension name] is the dimension of unit [name]: [Some] for each of {!Dolphin_semantics.Operators.unit_names}. *)

val read : Ast.expression -> (t, Diagnostic.t) result
(** [read e] is the value that [e] spells: [2], [-8.7], [30.seconds], ['x8-02'], [Location.APDL]. *)

val describe : t -> string
(** [describe x] is [x] in words: ["a time"], ["the number 3"], ["the text 'x'"]. *)
