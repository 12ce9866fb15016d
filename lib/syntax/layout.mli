(** The ends of statements, and the meaning of a name or a brace: all facts about lines that the grammar does not
    need. *)

val arrange : source:string -> Brackets.t -> Token.t array
(** [arrange ~source brackets] is the tokens of [brackets] with a [SEPARATOR] between every two statements, and
    nowhere else but where a [;] stands wrong, in which
    - a name that is called without parentheses is [COMMAND], a builder's name before a brace is [BUILDER];
    - a brace is [BLOCK] if it opens statements, [TRAILING] if it opens a closure after a call, else [LBRACE];
    - [until] and [during] after a task are [AFTER_UNTIL] and [AFTER_DURING];
    - a word of a construct is a [NAME] after a point, and before a colon. *)

val builder : string -> Ast.builder option
(** [builder x] is the builder that the name [x] stands for before a brace. *)

val is_incomplete : Grammar.token -> bool
(** [is_incomplete t] is whether no statement can end with [t], so that the next line belongs to it. *)

val continues : Grammar.token -> bool
(** [continues t] is whether no statement can begin with [t], so that it belongs to the line before. *)
