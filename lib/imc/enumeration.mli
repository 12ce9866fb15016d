(** Numbers that have names. *)

(** The numbers of one enumeration, as a type. *)
module type S = sig
  type t
  (** One constructor for each name, and [Other n] for values without one: IMC's enumerations grow, and a value that
      a later version added is kept. [Other n] is only for such [n]. *)

  val of_int : int -> t
  (** The value that has this number, or [Other]. *)

  val to_int : t -> int
  (** [to_int (of_int n) = n]. *)

  val name : t -> string
  (** The name in IMC's definition, ["METERS_PS"]; of [Other n], [n] in decimals. *)

  val to_json : t -> Yojson.Safe.t
  (** The name as a string; of [Other n], the number. *)

  val pp : Format.formatter -> t -> unit
  (** {!name}. *)
end
