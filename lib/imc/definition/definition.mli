(** The messages: ids, names, fields, types, units.

    A definition comes from the project's own page ({!Def_file}), from which the typed messages are
    generated, or from a user's [IMC.xml] ({!Imc_xml}). *)

(** {1:numbers Numbers and their meaning} *)

(** The numbers on the wire: unsigned, signed and floating-point ones, with their bits. *)
type scalar = U8 | U16 | U32 | I8 | I16 | I32 | I64 | F32 | F64

val scalar_name : scalar -> string
(** ["u8"], ["f64"]: as {!Def_file} spells it. *)

type named = { value : int; name : string; title : string }
(** A value with a name: [2 METERS_PS -- Meters per second]. *)

type names = {
  shared : string option;  (** The name of the set, if several messages share it. *)
  members : named list;  (** In the order of the definition. *)
}

type meaning =
  | Quantity of named list
  (** A plain number. The names are exceptions to its unit: [65535] is [ALT_UNKNOWN]. *)
  | Enumeration of names  (** One of the named values, or a value that a later version added. *)
  | Bits of names  (** A union of named bits. *)

(** {1:messages Messages} *)

(** The type of a field on the wire. *)
type typ =
  | Number of scalar * meaning
  | Text of { tuples : bool }
  (** A [u16] length and that many bytes, UTF-8 by custom. [tuples]: of the form [a=1;b=2]. *)
  | Raw  (** A [u16] length and that many bytes. *)
  | Inline of string option
  (** A message or none; [Some name] restricts it to a message or a group. *)
  | List of string option  (** Any number of messages, with the same restriction. *)

(** A field of a message, in the order of the wire. *)
type field = {
  name : string;
  typ : typ;
  unit : string option;  (** Unit of the number: [rad], [m/s], [%]. *)
  title : string;  (** Its description, when the name does not suffice. May be empty. *)
}

(** A message: its number on the wire, its abbreviation (["EstimatedState"]), its title in words. *)
type message = { id : int; name : string; title : string; fields : field list }

(** Messages that may stand in the same fields, by their abbreviations. *)
type group = { name : string; members : string list }

(** {1:definitions Definitions} *)

type t
(** A set of messages in which every name that is mentioned is defined. *)

(** A definition that contradicts itself. *)
type fault = { about : string;  (** The message or group that is at fault. *) why : string }

val make :
  enumerations:(string * named list) list ->
  bits:(string * named list) list ->
  groups:group list ->
  message list ->
  (t, fault) result
(** [make ~enumerations ~bits ~groups ms] is the definition of [ms], or why it cannot be: two messages
    with one id or name, or a name that stands for nothing. *)

val enumerations : t -> (string * named list) list
(** The shared enumerations. *)

val bits : t -> (string * named list) list
(** The shared sets of bits. *)

val groups : t -> group list
(** In the order of definition. *)

val messages : t -> message list
(** In the order of definition. *)

val find : t -> int -> message option
(** [find d id] is the message with the number [id]. *)

val find_name : t -> string -> message option
(** The message of this abbreviation. *)

val admits : t -> string -> message -> bool
(** [admits d name m]: [name] is that of [m], or of a group with [m] in it. *)

val difference : t -> than:t -> string -> string option
(** [difference d ~than:d' name] is why the message [name] of [d] looks otherwise on the wire than that of [d'], in
    words; [None] if it does not, or [d'] has none. Names of fields, units and values may differ. *)

val pp : Format.formatter -> t -> unit
(** The definition as {!Def_file} spells it: if [d] was read by {!Def_file.parse}, then
    [Def_file.parse (Format.asprintf "%a" pp d)] is [Ok d]. *)
