(** From text to raw tokens: the kinds of tokens, before the ends of statements are known. *)

type raw = {
  tokens : Token.t list;           (** In order; the last is [EOF]. A [;] is a [SEPARATOR]. *)
  faults : Diagnostic.t list;      (** In order. The tokens stand as if each fault were mended. *)
}

val scan : file:string -> string -> raw
(** [scan ~file source] is the raw tokens of [source], in which every name is [NAME], every opening brace is
    [LBRACE], and [until] and [during] are [UNTIL] and [DURING]. *)

val words : string list
(** The reserved words, in order. *)
