(** Sets of named bits. *)

(** Sets of the bits that one message defines. *)
module type S = sig
  type t = private int
  (** The union of some bits, of those without a name too. *)

  val none : t
  (** No bit. *)

  val of_int : int -> t
  (** The bits that are 1 in a number. *)

  val to_int : t -> int
  (** The number in which just these bits are 1. *)

  val mem : t -> t -> bool
  (** [mem x y]: every bit of [x] is in [y]. *)

  val ( + ) : t -> t -> t
  (** Union. *)

  val ( - ) : t -> t -> t
  (** Difference. *)

  val to_json : t -> Yojson.Safe.t
  (** {!names} as a list. *)

  val pp : Format.formatter -> t -> unit
  (** ["CALIBRATE IGNORE_ERRORS"]. *)
end

(** Sets of the bits that [names] names, each a number in which just that bit is 1. *)
module Make (_ : sig
    val names : (int * string) list
  end) : S

val names : (int * string) list -> int -> string list
(** [names ns x] spells [x] with the names [ns]: the one name for all of [x], if it has one; otherwise the names of
    its single bits, and the rest in hexadecimal, ["0x40"]. *)
