(** Whether a transition matches the step that a case expects. *)

val label : string -> string -> bool
(** [label expected seen] is whether they are equal, or differ only by wording in parentheses that [expected] leaves
    out. *)

val difference : Case.seen -> Dialogue.transition -> string option
(** [difference expected t] is how [t] differs from what is expected, in a sentence without a full stop; [None] if it
    matches. *)
