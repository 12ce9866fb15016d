(** Whether a transition matches the step that a case expects. *)

val label : string -> string -> bool
(** [label expected seen] is whether they are equal, or differ only by wording in parentheses that [expected] leaves
    out. *)

val difference : Case.seen -> Dialogue.transition -> string option
(** [difference expected t] is the difference of [t] from the expectation, in a sentence without a full stop; [None]
    if it matches. *)
