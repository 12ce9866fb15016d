(** Rests of plans that are known before a program runs not to have one: the way of the plan is not described, or it
    depends on the place where it begins. *)

module Ast = Dolphin_syntax.Ast

val program : Constants.t Lazy.t -> Ast.program -> Dolphin_syntax.Diagnostic.t list
(** [program constants ast] is the errors of the calls in [ast] of [p.rest(...)], and of [withBreaks], [onlyWhile] and
    [commanded] of the prelude, where the plan is known so. *)
