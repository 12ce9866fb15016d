(** Maps as pictures, in MBTiles: a database of SQLite that has square tiles of the Mercator projection. It may be
    hostile: it is only read, and no tile is read that takes a search through all of them. *)

type t = {
  minimum : int;  (** from the metadata, else of the tiles themselves *)
  maximum : int;  (** zoom levels that there are; at level [z] the world is [2 ** z] tiles wide *)
  bounds : (float * float * float * float) option;  (** west, south, east, north, in degrees, if the file has them *)
  attribution : string;  (** the attribution; [""]: the file has none *)
}

val read : string -> (t, string) result
(** [read path] is the description of the tiles at [path], or the reason why they cannot be shown, in a sentence.
    Without zoom levels in the metadata the index has to find them. *)

(** A picture as the file has it. *)
type image = { kind : string;  (** its media type *) bytes : string }

val tile : string -> zoom:int -> column:int -> row:int -> (image option, string) result
(** [tile path ~zoom ~column ~row] is that tile, counted from the west and the north; [None] if it does not exist. *)

val deepest : int
(** 24: the deepest level of zoom. *)

val most_bytes : int
(** 2 million: longer tiles are left out. *)
