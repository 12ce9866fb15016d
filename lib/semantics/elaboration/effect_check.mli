(** Statements that give a value to nobody and do nothing else: [xs.sort()], [n == 1]. *)

val program : Dolphin_syntax.Ast.program -> Dolphin_syntax.Diagnostic.t list
(** Warnings, one for each of them. Of what an object of the supplier may do nothing is known, so a program that has
    one is not warned of its members. *)
