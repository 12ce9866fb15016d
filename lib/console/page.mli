(** The page of a console, as it was built: files that are read once. *)

type t

val load : string option -> t
(** [load folder] is the files of [folder], or with [None], or where there are none, a page that says how to build
    it. *)

val find : t -> string list -> Dolphin_http.Response.t option
(** [find p path] is the file with this path. *)

val folder : unit -> string option
(** Where the built page is: in [DOLPHIN_CONSOLE] of the environment; in [share/dolphin/console] beside the [bin] of the
    installed command; in [_build/console] of the sources that it was built from. *)
