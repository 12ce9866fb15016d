(** The page of a console, as it was built: files that are read once. *)

type t

val load : string option -> t
(** [load folder] is the files of [folder], or with [None], or if they are missing, a page about building it. *)

val find : t -> Dolphin_http.Request.t -> Dolphin_http.Response.t option
(** [find p r] is the file that [r] asks for, compressed if [r] accepts gzip, or 304 if the client has it (by its
    [ETag]). *)

val folder : unit -> string option
(** Where the built page is: in [DOLPHIN_CONSOLE] of the environment; in [share/dolphin/console] beside the [bin] of the
    installed command; in [_build/console] of the sources that it was built from. *)
