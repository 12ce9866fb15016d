(** Constant expressions of TLA+, as text. *)

type t =
  | Integer of int
  | Boolean of bool
  | String of string
  | Tuple of t list
  | Record of (string * t) list
  | Set of t list
  | Name of string  (** an operator without arguments *)

val least : int
(** -(2^31 - 1): the least whole number that TLC computes with. *)

val greatest : int
(** The whole numbers that TLC computes with are of 32 bits. *)

val strings : string list -> t
(** [strings texts] is the tuple of them. *)

val pp : Format.formatter -> t -> unit
(** On one line. *)

val comment : string -> string
(** [comment text] is [text] as it may stand after [\*]: on one line. *)
