(** Programs of several files: [include 'lib.dol'] at the top of a program stands for the statements of that file,
    which is named relative to the file that includes it. A file is included once, at its first mention. *)

type whole = {
  text : string;
  (** all that was read, one file after the other: offsets of locations are offsets in it, lines and columns are those
      of the files *)
  files : string list;  (** the files, that of the program first *)
}

val beside : string -> string -> string
(** [beside file path] is the file that the text in [file] calls [path]. *)

val from : string -> string -> string
(** [from file path] is the name in [file] of the file [path]: such that [beside file (from file path)] is [path].
    The prelude, and of a relative path and an absolute one, [path] as it is. *)

val program :
  read:(string -> (string, string) result) ->
  file:string ->
  string ->
  whole * (Ast.program, Diagnostic.t list) result
(** [program ~read ~file source] is as {!Parse.program}, with its included files. [read path] is the text of a file,
    or why it cannot be read. *)
