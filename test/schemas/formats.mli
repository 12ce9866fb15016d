(** The formats with a schema in [conformance/schema]. *)

open Dolphin_json

type t =
  | Format : {
      name : string;  (** of the file, without [.schema.json] *)
      title : string;
      codec : 'a Codec.t;
      refuses : bool;  (** whether some values that are valid by the schema are refused *)
    }
      -> t

val all : t list

val find : string -> t
(** [find name] is the format called [name]. Raises [Invalid_argument]. *)

val schema : t -> Yojson.Safe.t
(** The schema of a format. *)
