(** Checks of requests: a console answers its own pages, programs of this machine, and clients with a token; never a
    page of another server. *)

(** What a client may do: each role may do what those before it may. *)
type role = Operators.role = Watches | Answers | Steers

type t = {
  port : int;
  tls : bool;  (** its addresses begin with [https] *)
  operators : Operators.operator list;  (** none on the loopback address: every client there steers *)
  proxy_header : string option;  (** in small letters: a proxy on this machine names the operator by it *)
}

val scheme : t -> string
(** [http] or [https]. *)

val check : t -> Dolphin_http.Request.t -> (role, int * string) result
(** [check a r] is the role of the client that sent [r]. It refuses, with a status and a sentence, requests that were
    not meant for this console or come from the page of another: a [Host] that is not its own (names that were bound to
    the loopback address lead here otherwise), a foreign [Origin], and changes that are not sent as JSON, which no page
    can send elsewhere unasked. Where there are tokens, requests of the interface need one, as a [Bearer] or in the
    cookie that {!enter} sets. With a [proxy_header], a request has the name of an operator there instead, once, and
    its [Host] is the proxy's. *)

val operator : t -> Dolphin_http.Request.t -> string option
(** [operator a r] is the name of the operator who sent [r], by the token or by the proxy, if there is one. *)

val rank : t -> Dolphin_http.Request.t -> Dolphin_http.Server.rank
(** [rank a r] is [Trusted] for a request of a client that may steer or answer, [Guest] for one that may watch,
    [Unknown] for one without a token or that {!check} refuses. *)

val enter : t -> Dolphin_http.Request.t -> (string * string) list option
(** [enter a r] is the headers of the reply to [r] if it is of a link with a token, [/?token=...]: a cookie that scripts
    cannot read, and where the page is. *)

val without : t -> string -> t
(** [without a name] is [a] without the operator [name]. *)

val check_proxy_header : string -> (string, string) result
(** [check_proxy_header text] is [text] in small letters if it is the name of a header for operators: [X-...]. *)

val is_loopback : Unix.inet_addr -> bool
(** Whether only this machine can connect to the address: [127.0.0.0/8] and [::1]. *)

val check_tiles : string -> (string, string) result
(** [check_tiles url] is [url] if it is an address of tiles of a map: [https://tile.example/{z}/{x}/{y}.png]. *)

val headers : tiles:string option -> (string * string) list
(** Headers of all replies: a page loads only the console's own files, and tiles of the map from [tiles]; other pages
    may not frame it. *)
