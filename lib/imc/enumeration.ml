module type S = sig
  type t

  val of_int : int -> t
  val to_int : t -> int
  val name : t -> string
  val to_json : t -> Yojson.Safe.t
  val pp : Format.formatter -> t -> unit
end
