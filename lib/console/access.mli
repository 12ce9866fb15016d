(** Who may ask a console: its own pages, and programs of this machine; no page of anybody else. Pure. *)

val check : port:int -> Dolphin_http.Request.t -> (unit, int * string) result
(** [check ~port r] refuses, with a status and a sentence, what was not meant for this console or comes from the page of
    another: a [Host] that is not the loopback address (names that were bound to it lead here otherwise), a foreign
    [Origin], and changes that are not sent as JSON, which no page can send elsewhere unasked. *)

val headers : (string * string) list
(** What all replies have: nothing but the console's own files is loaded into its page, nobody may frame it. *)
