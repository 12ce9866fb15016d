(** From the abstract syntax to the core: names become places, constructs become operations, and every error that can
    be known is reported before anything moves. *)

module Diagnostic = Dolphin_syntax.Diagnostic

val program :
  source_name:string ->
  Dolphin_syntax.Ast.program ->
  (Core.program * Diagnostic.t list, Diagnostic.t list) result
(** [program ~source_name ast] is the core program of [ast], and warnings; or the errors, with the warnings. Checked
    are: unknown names, settings, constants and units; numbers of arguments and kinds of literals; operations of the
    script inside of a task's code; assignments to captured locals; [break], [return], [_] and [ignore()] out of
    place; one vehicle needed twice at once, where that can be seen. No file can be read for [map]. *)

val program_with_charts :
  chart:(string -> (Chart.t, string) result) ->
  source_name:string ->
  Dolphin_syntax.Ast.program ->
  (Core.program * Diagnostic.t list, Diagnostic.t list) result
(** [program_with_charts ~chart ~source_name ast] is the same; [chart path] is the [map] of the file [path], or its
    fault. *)

val known_plans :
  chart:(string -> (Chart.t, string) result) -> Dolphin_syntax.Ast.program ->
  (Dolphin_syntax.Ast.expression * Inline_plan.t) list
(** [known_plans ~chart ast] is the plans that are known before the program runs: {!Fence_declarations.plans}. *)

val answer : Core.program -> string -> (Core.closure, string) result
(** [answer p text] is the expression [text], to be evaluated with the variables of [p] in sight, or what is wrong with
    it in one sentence. [yes] and [y], [no] and [n], in small or large letters, are the truth values, whatever variables
    [p] has. *)

val expression : Core.program -> globals:string list -> Dolphin_syntax.Ast.expression -> (Core.closure, string) result
(** [expression p ~globals e] is [e] in the core; [globals] are further variables, numbered after those of [p]. *)
