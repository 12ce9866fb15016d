(** JSON of the values of fields. *)

type t = Yojson.Safe.t

val int : int -> t
(** A number. *)

val int64 : int64 -> t
(** A number. *)

val float : float -> t
(** A number; a value without a number in JSON is a string: ["NaN"], ["Infinity"], ["-Infinity"]. *)

val text : string -> t
(** A string; bytes that are not UTF-8 become U+FFFD. *)

val raw : string -> t
(** A string of hexadecimal digits, two for each byte. *)

val inline : ('a -> t) -> 'a option -> t
(** [null] for [None]. *)

val list : ('a -> t) -> 'a list -> t
(** A list, element by element. *)

val message : string -> (string * t) list -> t
(** [message name fields] is the object with ["abbrev": name] and [fields]. *)
