(** Requests of HTTP/1.1, as far as a console on one's own machine needs them. Pure.

    {[
      open Dolphin_http

      let () =
        match Request.of_head "GET /api/file?path=a%20b.dol HTTP/1.1\r\nHost: localhost" with
        | Ok (request, 0) ->
          assert (request.path = [ "api"; "file" ]);
          assert (Request.parameter request "path" = Some "a b.dol");
          assert (Request.header request "host" = Some "localhost")
        | _ -> assert false
    ]} *)

type t = {
  verb : string;  (** ["GET"], as it was sent *)
  path : string list;  (** its parts, decoded, without empty ones: [["api"; "file"]] *)
  query : (string * string) list;  (** decoded *)
  headers : (string * string) list;  (** names in small letters *)
  body : string;
}

val header : t -> string -> string option
(** [header r name] is the header [name], in small letters; [None] if it is missing or was sent twice. *)

val parameter : t -> string -> string option
(** [parameter r name] is the first value of [name] in the query. *)

(** Why one is refused. *)
type fault =
  | Malformed of string  (** a sentence without a full stop *)
  | Too_large
  | Unsupported of string

val of_head : string -> (t * int, fault) result
(** [of_head text] is the request whose lines before the empty one are [text], with an empty body, and how many bytes
    its body has. Bodies of unknown length are not supported, nor are methods and versions that HTTP/1.1 does not have.
*)

val keeps_alive : t -> bool
(** Whether the client goes on with this connection. *)
