(** Links from a file of an archive to other files of it, as RFC 3986 resolves them. *)

val targets : from:string -> string -> string list
(** [targets ~from href] is the names that the file to which [href] links may have in the archive, the likeliest first:
    [targets ~from:"maps/doc.kml" "../no%20fly.kml#a"] is [["no fly.kml"; "no%20fly.kml#a"]]. The second one, as
    written, is of archives whose links are not escaped. Empty if [href] leaves the archive: it has a scheme or host, is
    absolute, or goes up too far. *)
