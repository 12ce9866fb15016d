(** Walks over the expressions of code, with the code that it makes or holds: each piece once. *)

open Core

val parts : expression -> expression list
(** [parts e] is the expressions directly in [e], in the order in which they stand. The code that [e] makes or holds is
    not among them. *)

val assigned : expression -> (int * expression) list
(** [assigned e] is the global variables that [e] itself assigns, or the end of the task that it makes, each with the
    expression of its value. *)

val computed_keys : string option list -> expression list -> expression list
(** [computed_keys keys arguments] is the expressions of the keys that are computed, of a [Post], [Consume] or [Poll] of
    [keys] with these arguments. *)

val pieces : program -> lambda list
(** [pieces p] is the code of [p] outside of other code: the script, the functions, the task of [onInterrupt]. *)

val iter : (expression -> unit) -> lambda list -> unit
(** [iter f ls] is [f] of the expressions of [ls], and of the code that they make or hold. *)

val iter_within : (lambda -> expression -> unit) -> lambda list -> unit
(** [iter_within f ls] is [f l e] for each expression [e] that [iter] has, where [l] is the code that owns it. *)

val iter_called : (expression -> unit) -> program -> unit
(** [iter_called f p] is [f] of the expressions of code that others call: the functions of [p], and the closures that
    these and the script make or hold. *)
