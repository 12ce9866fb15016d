(** From text to raw tokens: what a token is, not yet where statements end. *)

type raw = {
  tokens : Token.t list;           (** In order; the last is [EOF]. A [;] is a [SEPARATOR]. *)
  faults : Diagnostic.t list;      (** In order. The tokens stand as if each fault were mended. *)
}

val scan : file:string -> string -> raw
(** [scan ~file source] is the raw tokens of [source], in which every name is [NAME], every opening brace is
    [LBRACE], and [until] and [during] are [UNTIL] and [DURING]. *)

val words : string list
(** The words that are no names, in order. *)
