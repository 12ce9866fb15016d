(** Programs as text, in one canonical form: four spaces of indentation, no parentheses but those needed, prefix
    forms of the task operators. Comments are not in the syntax tree and so not in the text.

    {[
      open Dolphin_syntax

      let program = Result.get_ok (Parse.program ~file:"a.dol" "execute uuv: task('survey1')>>(task('home'))")
      let () = assert (Format.asprintf "%a" Print.program program = "execute uuv: task('survey1') >> task('home')\n")
    ]} *)

val program : Format.formatter -> Ast.program -> unit
(** [program ppf p] prints [p] such that reading it again gives [p] with other locations. *)

val expression : Format.formatter -> Ast.expression -> unit
(** [expression ppf e] prints [e] in the same way. *)

val until : Ast.on_cut -> string
(** [until on_cut] is ["until"] or ["assure"]. *)

val give_back : string
(** The procedure that posts the pairs of a guard again: ["giveBack"]. *)

val during : Ast.on_cut -> string
(** [during on_cut] is ["during"] or ["within"]. *)

val operator : Ast.binary -> string
(** [operator o] is its spelling, [">>"]. *)
