(** Programs and fleets, as files that a person edits. *)

val all : string list -> (string list, Error.t) result
(** [all paths] is the files of [paths]: of a folder, those in it and in the folders below it whose names end in [.dol],
    [.dolphin] or [.fleet], in order; folders whose names begin with a [.] or a [_] are passed over. *)

val formatted : file:string -> string -> (string, Error.t) result
(** [formatted ~file source] is {!Dolphin_syntax.Formatting.program}. *)

val replace : string -> string -> (unit, Error.t) result
(** [replace path text] makes [text] the contents of the file [path], at once: readers see the old contents or the
    new. *)
