(** The lines on the socket of a run, which docs/socket.md describes: requests and replies. *)

open Dolphin_json

(** A request of a client. *)
type request =
  | Status
  | Follow
  | Stop
  | Post of { key : string; value : Yojson.Safe.t }
  | Replace of { program : string; set : (string * string) list option; hash : string option }
  (** [program] is an absolute path. *)

(** The kind of a fault: docs/socket.md has the meaning of each. *)
type code =
  | No_json
  | Bad_request
  | Unknown_request
  | Not_declared
  | Bad_value
  | No_journal
  | Ended
  | Too_many
  | Bad_program
  | Differs
  | Busy

type status = { program : string; time : float; inputs : string list; questions : string list }
(** What a run is at this time: the path of its program, seconds since the start, declared keys, open questions. *)

(** The content of a reply. *)
type reply =
  | Done of float option  (** at this time of the run *)
  | Status_is of status
  | Wrong of code * string  (** with a message *)

type 'a numbered = { id : Yojson.Safe.t option; content : 'a }
(** A reply has the [id] of its request. *)

val request_of_string : string -> (request numbered, reply numbered) result
(** [request_of_string line] is the request of a line, or the reply to one that is not valid. *)

val request : request numbered Codec.t
(** Requests. *)

val reply : reply numbered Codec.t
(** Replies. *)

(** A line, in either direction. *)
type line = Request of request numbered | Reply of reply numbered

val line : line Codec.t
(** Lines in either direction, as [conformance/schema/socket.schema.json] describes them. *)
