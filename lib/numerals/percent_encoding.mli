(** Bytes as percent signs with two hexadecimal digits, as in links (RFC 3986, section 2.1). *)

val decoded : string -> string option
(** [decoded "a%20b"] is [Some "a b"]; [None] if a percent sign is not followed by two digits. *)
