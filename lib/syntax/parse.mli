(** Reading programs. No text makes these functions raise, or overflow the stack.

    {[
      open Dolphin_syntax

      let () =
        assert (Result.is_ok (Parse.program ~file:"hello.dol" "message 'hello'"));
        match Parse.program ~file:"hello.dol" "message 'hello'\nhalt 'no" with
        | Ok _ -> assert false
        | Error faults -> assert ((List.hd faults).at.start.pos_lnum = 2)
    ]} *)

val program : file:string -> string -> (Ast.program, Diagnostic.t list) result
(** [program ~file source] is the program that [source] spells, or what is wrong with it: at least one
    diagnostic and at most {!most_faults}, in the order of the text. [file] is only a name. *)

val expression : file:string -> string -> (Ast.expression, Diagnostic.t list) result
(** [expression ~file source] is the one expression that [source] spells, such as the answer to an [ask]. *)

val most_faults : int
(** 20. *)
