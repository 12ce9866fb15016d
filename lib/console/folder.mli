(** The folder that a console shows: its programs, fleets, journals and layers of the map. Nothing outside of it is read
    or written, whatever path is asked for and whatever links there are. *)

type t

val make : string -> (t, string) result
(** [make path] is the folder [path], or why there is none. *)

val root : t -> string
(** Its real path. *)

(** The kind of a file, by the end of its name. *)
type kind = Program | Fleet | Journal | Layer

val shapes : string list
(** Ends of the names of layers that are shapes, not tiles: all of {!Dolphin_maps.Map_file.formats} but [.json]. *)

val kind : string -> kind option
(** What a file is, by the end of its name: [.dol] or [.dolphin], [.fleet], [.run], and for layers
    [.mbtiles] or one of {!Dolphin_maps.Map_file.formats} but [.json]. *)

val list : t -> (kind * string) list
(** Its files, by their paths from {!root}, in order: those in it and in the folders below it, at most 2,000. Links,
    hard ones too, and names that begin with [.], [_] or [-] or have control characters are passed over. *)

val find : t -> string -> (string, string) result
(** [find f path] is the real path of the file [path] of [f]. The error is the reason why it is not shown: it is
    elsewhere, hidden, of no {!kind}, no regular file, or a hard link. *)

val place : t -> string -> (string, string) result
(** [place f path] is likewise where the file [path] is or would be: its folder must be there. *)

val may_read : t -> string -> (unit, string) result
(** [may_read f path] says whether what a text names, a file to include or a map, may be read: only a file that {!find}
    finds, or a map in JSON. The error does not depend on the reason, so it does not disclose which files there are. *)

val inside : t -> string -> string option
(** [inside f path] is the path from {!root} of the file with the path [path], if {!find} finds it. *)
