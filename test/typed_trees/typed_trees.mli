(** The compiler's typed trees (cmt and cmti files) of a build, for tests that read code. *)

val below : ?interfaces:bool -> string list -> string list
(** [below ~interfaces folders] is the paths of the typed trees below [folders], in order of their names; those of
    interfaces, by default left out, if [interfaces].
    @raise Failure if there are none: such a test would check nothing. *)
