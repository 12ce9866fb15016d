(** Comparisons with readings, by their texts as the semantics spells them: ["battery(a) < 0.3"]. *)

type t = string * bool
(** A text, and whether the comparison holds. *)

val contradict : t -> t -> bool
(** [contradict a b] is whether no quantity has both outcomes: the same text with another one, or comparisons of one
    operand with numbers that no number satisfies. Texts that cannot be compared do not contradict each other. *)

val is_kept_by_growth : of_operand:string -> t -> bool
(** [is_kept_by_growth ~of_operand c] is whether [c] is a comparison of this operand with a number, and once it holds it
    holds however much the operand grows: [("now() > 60", true)] with [~of_operand:"now()"]. *)

val negated : string -> string
(** [negated text] spells the comparison that holds where [text] does not: ["battery(a) >= 0.3"]. *)
