(** IMC's own definitions, for the tests: separate from the library's definition page. *)

type field = {
  name : string;
  typ : string;  (** As IMC spells it: [uint8_t], [message-list]. *)
  unit : string option;
  restriction : string option;  (** [message-type]. *)
  values : (int * string) list;
}

type message = { id : int; name : string; fields : field list }

val messages : message list Lazy.t
val groups : (string * string list) list Lazy.t
val message : string -> message

val admitted : string option -> message list
(** The possible contents of an inline message. *)

val number : field -> int -> Yojson.Safe.t
(** How a number in this field is to be shown. *)

val shown : Yojson.Safe.t -> Yojson.Safe.t
(** [shown m] is the message [m] of a vector, where numbers stand for enumerations and bits, in the form
    of {!Dolphin_imc.Message.to_json}. *)
