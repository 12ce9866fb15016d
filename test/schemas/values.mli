(** Random JSON that is valid by a schema. *)

val of_schema : document:(string -> Yojson.Safe.t) -> Yojson.Safe.t -> Yojson.Safe.t QCheck2.Gen.t
(** [of_schema ~document schema] is valid values. [document file] is the schema in another file. *)
