(** Comparisons with readings, by their texts as the semantics spells them: ["battery(a) < 0.3"]. *)

type t = string * bool
(** A text, and whether the comparison holds. *)

val contradict : t -> t -> bool
(** [contradict a b] is whether no quantity has both outcomes: the same text with another one, or comparisons of one
    operand with numbers that no number satisfies. Texts that cannot be compared do not contradict each other. *)

val negated : string -> string
(** [negated text] spells the comparison that holds where [text] does not: ["battery(a) >= 0.3"]. *)
