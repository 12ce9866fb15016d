(** Whether a transition is the one that a case speaks of. *)

val label : string -> string -> bool
(** [label expected seen]: they are equal; or what is in the parentheses of [seen] is wording, and [expected] leaves it
    out. *)

val difference : Case.seen -> Dialogue.transition -> string option
(** [difference expected t] is in what [t] is not as expected, in a sentence without a full stop. *)
