(** A mission to start from: the files that [dolphin new] writes. Its files are those of [templates/mission]. *)

val write : string -> (unit, Error.t) result
(** [write folder] makes [folder], which must not be there or be empty, with the mission in it. The error is
    {!Error.Bad_input} if something is there, {!Error.Unavailable} if it cannot be written; then nothing is there. *)
