(** The certificate by which a console proves to pages and programs of other machines that they reach it, and by which
    they encrypt all that they send. *)

open Dolphin_app

type t = {
  context : Ssl.context;  (** TLS 1.2 or later *)
  fingerprint : string;  (** SHA-256 of the certificate, in hexadecimal digits *)
}

val load : certificate:string -> key:string -> (t, Error.t) result
(** [load ~certificate ~key] has the chain of certificates of the file [certificate] and the private key of [key], both
    in PEM. *)

val own : name:string -> (t, Error.t) result
(** [own ~name] is a certificate that signs itself, for [name], a host name or an address. It is kept among the files of
    the user's state, so that its fingerprint stays the same, and made by the command [openssl] if it is missing or
    expires within 30 days. *)

val with_fingerprint : t -> string -> string
(** [with_fingerprint c link] is [link] with the fingerprint as its fragment: [#sha256=...]. *)
