(** How operators, words and texts are spelt. *)

(** {1:precedence Precedence}

    An expression stands without parentheses where its level is at least the one asked for. *)

val whole : int
(** The lowest level: where [waitFor { } then t] may stand bare. *)

val conditional : int
(** Of [c ? a : b] and [a ?: b]. *)

val range : int
(** Of [1..3]. *)

val unary : int
(** Of [-e] and [!e]. *)

val postfix : int
(** The highest level: of names, calls, members, elements. *)

val level_of_operator : Ast.binary -> int
(** [level_of_operator o] is the level of [a o b]; the right operand needs one more. *)

val level : Ast.expression -> int
(** [level e] is the level of [e] as it is spelt. *)

(** {1:words Words and texts} *)

val operator : Ast.binary -> string
(** [operator o] is ["+"] for [Add], and so on. *)

val until : Ast.on_cut -> string
(** [until on_cut] is ["until"] or ["assure"]. *)

val during : Ast.on_cut -> string
(** [during on_cut] is ["during"] or ["within"]. *)

val builder : Ast.builder -> string
(** [builder b] is ["pick"] for [Pick], and so on. *)

val escaped : quote:char -> string -> string
(** [escaped ~quote text] is [text] as it stands between two [quote]. *)

val quoted : string -> string
(** [quoted text] is the string literal of [text]. *)

val key_name : string -> string
(** [key_name k] is [k] as the key of an argument or of a map's entry: quoted, unless it is a name. *)

val decimal : float -> string
(** [decimal x] is the shortest decimal that is read as [x]. *)
