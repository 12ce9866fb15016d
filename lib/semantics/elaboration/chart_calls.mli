(** [map 'harbour.geojson']: the contents of another program's map file, a constant of the program. *)

module Ast = Dolphin_syntax.Ast

val word : string
(** ["map"]. *)

val paths : Ast.program -> (string * Dolphin_syntax.Location.t) list
(** The files that a program names so, each as its text finds them, in the order of the text. *)

val is_call : Scope.program -> string -> bool
(** [is_call p name] is whether a call of [name] means this: a function or a variable of the program may be called
    [map] too. *)

val file : Ast.expression -> (string * Dolphin_syntax.Location.t) option
(** The file that a call [map 'FILE'] names, as {!paths} has it. *)

val assigned : Ast.program -> (string * string) list
(** Variables that surely are such a map, each with its file. *)

val note : Scope.program -> string * string -> unit
(** Notes the names that the map of such a variable has. *)

val warnings : Dolphin_syntax.Location.t -> string -> Chart.t -> Dolphin_syntax.Diagnostic.t list
(** [warnings at path chart] is the differences between [chart] and the file [path], which is named at [at]; of many
    differences the first and the number of others. *)

val elaborate : Checks.env -> Dolphin_syntax.Location.t -> Ast.argument list -> Core.expression
(** A call of [map]. *)

val check_member : Checks.env -> Ast.expression -> string Ast.located -> unit
(** [check_member env subject name] reports a [name] that the map [subject] does not have, or that is flawed there. *)
