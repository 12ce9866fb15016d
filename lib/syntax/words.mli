(** The tokens of reserved words, by {!Construct}. *)

val tokens : (string * Grammar.token) list
(** Each reserved word, and ["_"], with its token. *)

val place : Grammar.token -> Construct.place option
(** How the word stands that a token is, if it is one; of an [until] or a [during] behind a task it is
    {!Construct.Limits}. *)

val is_word : Grammar.token -> bool
(** Whether the token is a reserved word that is not a constant. *)

val continues : Grammar.token -> bool
(** Whether the word belongs to the task before it: [then], [ensure]. *)

val begins_task : Grammar.token -> bool
(** Whether a task can begin with the word. *)

val takes_code : Grammar.token -> bool
(** Whether code in braces follows the word, as in [until { C }]. *)
