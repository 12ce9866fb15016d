(** Walks over the expressions of code, with the code that it makes or holds: each piece once. *)

open Core

val parts : expression -> expression list
(** [parts e] is the expressions directly in [e], in the order in which they stand. The code that [e] makes or holds is
    not among them. *)

val assigned : expression -> (int * expression) list
(** [assigned e] is the global variables that [e] itself assigns, or the end of the task that it makes, each with the
    expression of its value. *)

(** The key of a pair, in the code that posts it or asks for it. *)
type key = Written of string | Computed of expression

val pairs : string option list -> expression list -> (key * expression) list
(** [pairs keys arguments] is each key with the expression of its value, of a [Post], [Consume] or [Poll] of [keys] with
    these arguments; nothing if it is of a map. *)

val pieces : program -> lambda list
(** [pieces p] is the code of [p] outside of other code: the script, the functions, the task of [onInterrupt]. *)

val iter : (expression -> unit) -> lambda list -> unit
(** [iter f ls] is [f] of the expressions of [ls], and of the code that they make or hold. *)

val iter_within : (lambda -> expression -> unit) -> lambda list -> unit
(** [iter_within f ls] is [f l e] for each expression [e] that [iter] has, where [l] is the code that owns it. *)

val iter_called : (expression -> unit) -> program -> unit
(** [iter_called f p] is [f] of the expressions of code that others call: the functions of [p], and the closures that
    these and the script make or hold. *)
