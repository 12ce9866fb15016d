(** Who may ask a console: its own pages, and programs of this machine, or who has a token; no page of anybody else. *)

(** Whoever watches may not command. *)
type role = Steers | Watches

type tokens = { steer : string; watch : string }

type t = {
  port : int;
  tls : bool;  (** its addresses begin with [https] *)
  tokens : tokens option;  (** [None]: on the loopback address, where all who can connect may steer *)
}

val scheme : t -> string
(** [http] or [https]. *)

val fresh : unit -> tokens
(** Tokens that nobody guesses: 128 bits each. *)

val check : t -> Dolphin_http.Request.t -> (role, int * string) result
(** [check a r] is what whoever sends [r] may do. It refuses, with a status and a sentence, what was not meant for this
    console or comes from the page of another: a [Host] that is not its own (names that were bound to the loopback
    address lead here otherwise), a foreign [Origin], and changes that are not sent as JSON, which no page can send
    elsewhere unasked. Where there are tokens, requests of the interface need one, as a [Bearer] or in the cookie that
    {!enter} sets. *)

val rank : t -> Dolphin_http.Request.t -> Dolphin_http.Server.rank
(** [rank a r] is [Trusted] for a request of a client that may steer, [Guest] for one that may watch, [Unknown] for one
    without a token or that {!check} refuses. *)

val enter : t -> Dolphin_http.Request.t -> (string * string) list option
(** [enter a r] is the headers of the reply to [r] if it is of a link with a token, [/?token=...]: a cookie that scripts
    cannot read, and where the page is. *)

val check_tiles : string -> (string, string) result
(** [check_tiles url] is [url] if it is an address of tiles of a map: [https://tile.example/{z}/{x}/{y}.png]. *)

val headers : tiles:string option -> (string * string) list
(** What all replies have: nothing but the console's own files is loaded into its page, and the tiles of the map if
    [tiles] says from where; nobody may frame it. *)
