(** Statements whose value is not used and that have no effect: [xs.sort()], [n == 1]. *)

val program : Dolphin_syntax.Ast.program -> Dolphin_syntax.Diagnostic.t list
(** Warnings, one for each of them. The effects of an object of the supplier are unknown, so a program that has one
    gets no warning about its members. *)
