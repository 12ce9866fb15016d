(** The data of the tests. *)

type vector = { name : string; little : string; big : string; content : Yojson.Safe.t }
(** One packet in both byte orders. [content] is the whole line: header and message. *)

val vectors : vector list Lazy.t
val lifecycle : string list Lazy.t
val flood : string list Lazy.t

val datagrams : string list Lazy.t
(** All packets: the recorded ones, and the vectors in both orders. *)

val json_lines : string -> Yojson.Safe.t list
(** The lines of a file of [data]. *)

val text : string -> string
(** A file of [data]. *)

val of_hex : string -> string
val to_hex : string -> string

val seal : string -> string
(** [seal s] is [s] with the size and the checksum that its header's byte order asks for, if it is long
    enough to have them. *)
