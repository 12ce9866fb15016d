(** From the abstract syntax to the core: names become places, constructs become operations, and every error that can
    be known is reported before anything moves.

    {[
      open Dolphin_syntax
      open Dolphin_semantics

      let elaborate text =
        Elaborate.program ~source_name:"a.dol" (Result.get_ok (Parse.program ~file:"a.dol" text))

      let () =
        assert (Result.is_ok (elaborate "v = pick { count 1 }\nexecute v: task('survey1')"));
        match elaborate "message speeed" with
        | Error [ fault ] -> assert (fault.code = Diagnostic.Unknown_name)
        | _ -> assert false
    ]} *)

module Diagnostic = Dolphin_syntax.Diagnostic

val program :
  source_name:string ->
  Dolphin_syntax.Ast.program ->
  (Core.program * Diagnostic.t list, Diagnostic.t list) result
(** [program ~source_name ast] is the core program of [ast], and warnings; or the errors, with the warnings. The errors
    are: unknown names, settings, constants and units; numbers of arguments and kinds of literals; script statements
    inside of a task's code; assignments to captured locals; [break], [return], [_] and [ignore()] out of place; one
    vehicle needed twice at once, where the check can see that; inline plans without a place. No file can be read for
    [map]. *)

val program_at :
  place:Dolphin_geo.Position.t option ->
  source_name:string ->
  Dolphin_syntax.Ast.program ->
  (Core.program * Diagnostic.t list, Diagnostic.t list) result
(** [program_at ~place ~source_name ast] is the same; unless [ast] declares a place for its plans, that is [place]. *)

val program_with_charts :
  chart:(string -> (Chart.t, string) result) ->
  source_name:string ->
  Dolphin_syntax.Ast.program ->
  (Core.program * Diagnostic.t list, Diagnostic.t list) result
(** [program_with_charts ~chart ~source_name ast] is the same; [chart path] is the [map] of the file [path], or its
    fault. Plans without a place are not checked: a fleet may have one for them. *)

val plans_without_place :
  chart:(string -> (Chart.t, string) result) -> Dolphin_syntax.Ast.program -> Diagnostic.t list
(** [plans_without_place ~chart ast] is the errors of a program without a default place, in a fleet without one:
    {!Default_place.missing}. *)

val known_plans :
  chart:(string -> (Chart.t, string) result) -> place:Dolphin_geo.Position.t option -> Dolphin_syntax.Ast.program ->
  (Dolphin_syntax.Ast.expression * Dolphin_plans.Inline_plan.t) list
(** [known_plans ~chart ~place ast] is the plans that are known before the program runs, where [place] is that of plans
    which have none: {!Fence_declarations.plans}. *)

val answer : Core.program -> string -> (Core.closure, string) result
(** [answer p text] is the expression [text], to be evaluated with the variables of [p] in sight, or what is wrong with
    it in one sentence. [yes] and [y], [no] and [n], in small or large letters, are the truth values, whatever variables
    [p] has. *)

val expression : Core.program -> globals:string list -> Dolphin_syntax.Ast.expression -> (Core.closure, string) result
(** [expression p ~globals e] is [e] in the core; [globals] are further variables, numbered after those of [p]. *)
