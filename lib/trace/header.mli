(** What a journal begins with: of which program, on which fleet, how and when. *)

(** A file as it was when the run began. *)
type source = {
  path : string;
  hash : string;  (** the MD5 digest of its text, in hexadecimal *)
}

type t = {
  program : source;
  fleet : source option;  (** [None]: the built-in fleet *)
  platform : string;  (** ["sim"] *)
  seed : int;
  speed : float option;  (** times real time; [None]: as fast as it goes *)
  started : string;  (** by the clock of the console, in UTC: ["2026-03-01T12:00:00Z"] *)
}

val source : path:string -> string -> source
(** [source ~path text] is the file [path] whose contents are [text]. *)

val version : int
(** Of the format: 1. *)

val to_json : t -> Yojson.Safe.t
val of_json : Yojson.Safe.t -> (t, string) result
(** Refuses what is no journal, and journals of other versions. *)
