(** The place of inline plans without one of their own: [locate P] at the top of a program. *)

module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

val word : string
(** ["locate"]. *)

val is_declaration : Ast.statement -> bool
(** Whether the statement is [locate ...], which declares the place if it stands at the top of a program. *)

val read : Constants.t -> Dolphin_syntax.Location.t -> Ast.argument list ->
  (Dolphin_geo.Position.t, Diagnostic.t list) result
(** [read constants at arguments] is the place that [locate] declares; [at] is the site of [locate]. *)

val of_program : Constants.t Lazy.t -> Ast.program -> (Dolphin_geo.Position.t option, Diagnostic.t list) result
(** [of_program constants ast] is the place that [ast] declares, if it does, or what is wrong with that. The variables
    that it names are computed only if there is a declaration. *)

val missing : Constants.t Lazy.t -> Ast.program -> Diagnostic.t list
(** [missing constants ast] is the inline plans of [ast] that are known to need a place, and have none where the program
    has none: one error each, at the first maneuver that needs it. [constants] has no place either; it is computed only
    where code in a plan decides. Other plans without a place end in a fault when they are built. *)
