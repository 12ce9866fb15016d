(** The message where the grammar cannot go on. *)

val fault :
  source:string -> tokens:Token.t array -> index:int -> acceptable:(Grammar.token -> bool) -> Diagnostic.t
(** [fault ~source ~tokens ~index ~acceptable] explains why token [index] of [tokens] cannot stand there, where the
    grammar would take the tokens that are [acceptable]. *)
