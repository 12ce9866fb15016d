(** Brackets and their partners. *)

type t = {
  tokens : Token.t array;          (** The tokens, in which every bracket has its partner. *)
  partner : int array;             (** The place of a bracket's partner; -1 for other tokens. *)
  faults : Diagnostic.t list;      (** The brackets without a partner: those are dropped, or given one. *)
}

val limit : int
(** The deepest nesting of brackets that is read: 1,000. *)

val most_tokens : int
(** The most tokens that are read, ends of lines among them: 500,000. *)

val match_up : Token.t array -> (t, Diagnostic.t) result
(** [match_up tokens] pairs the brackets of [tokens]: parentheses, square brackets, braces, and holes
    of strings. It is an error if they nest deeper than {!limit}, or if there are more than {!most_tokens}. *)
