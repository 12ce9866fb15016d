(** Reads message definitions from [IMC.xml], the protocol's official description.

    The file is the user's: any version, extended or not. Sources: [IMC.xsd] beside it. *)

(** The first fault of a document, with its place and its reason. *)
type error = {
  line : int;  (** The end of the faulty tag, from 1; 0 if the fault is not of one tag. *)
  column : int;
  why : string;
}

val parse : string -> (Definition.t, error) result
(** [parse text] is the definition in the XML document [text]. *)

val read : string -> (Definition.t, error) result
(** [read path] is [parse] of the file at [path], or the reason why that cannot be read. *)

val pp_error : Format.formatter -> error -> unit
(** ["12:24: <message>: the attribute id is missing"]. *)
