(** Hash-consing by numbers: equal values have the same number, from 0 in order of first sight. *)

(** Numbers for keys, which [Key.equal] compares. *)
module Make (Key : Hashtbl.HashedType) : sig
  type t

  val create : Numbering.t -> t
  (** [create n] is one of the numberings [n]. *)

  val number : t -> Key.t -> int
  (** [number t x] is the number of [x], a new one if [x] is new.
      @raise Numbering.Closed then, if numberings are closed *)

  val find : t -> Key.t -> int option
  (** [find t x] is the number of [x], if it has one. *)

  val value : t -> int -> Key.t
  (** [value t n] is the value with number [n]. *)

  val count : t -> int
  (** The number of values so far: the next new one gets this number. *)
end
