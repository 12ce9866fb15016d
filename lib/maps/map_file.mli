(** Maps from files of other programs. *)

open Dolphin_geo

type thing = Point of Position.t | Line of Position.t list  (** of at least two *) | Area of Area.t

val read : path:string -> string -> ((string * thing) list, string) result
(** [read ~path text] is what the map with this contents has, by name, in the order of the file. The end of [path] says
    which format it is: one of {!formats}. What has no name is ["area 1"], ["line 1"], ["point 1"], counted by kind;
    what has the name of another is ["NAME 2"]. Or what is wrong with it, and where, in one sentence. *)

val formats : string list
(** Ends of files' names: [".geojson"] and so on. *)

val most_bytes : int
(** 20 million: longer files, and archives that are longer unpacked, are errors. *)
