(** Expressions and statements of the surface language as expressions of the core. What is wrong with them is reported
    to the program's {!Scope}. *)

val env : Scope.program -> Scope.code -> answer:bool -> Checks.env
(** [env p c ~answer] is what it takes to translate the piece [c] of [p] with {!Checks.elaborate} and
    {!Checks.statements}; [answer] is whether [c] is an answer to [ask]. *)
