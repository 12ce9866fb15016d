(** Numbers for values: equal values have the same number, from 0 in order of first sight. *)

module Make (Key : Hashtbl.HashedType) : sig
  type t

  val create : unit -> t

  val number : t -> Key.t -> int
  (** [number t x] is the number of [x], a new one if [x] is new. *)

  val find : t -> Key.t -> int option
  val value : t -> int -> Key.t
  val count : t -> int
end
