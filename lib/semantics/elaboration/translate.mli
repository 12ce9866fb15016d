(** Expressions and statements of the surface language as expressions of the core. Their faults are reported to the
    program's {!Scope}. *)

val env : Scope.program -> Scope.code -> answer:bool -> Checks.env
(** [env p c ~answer] is the environment that translates the piece [c] of [p] with {!Checks.elaborate} and
    {!Checks.statements}; [answer] is whether [c] is an answer to [ask]. *)
