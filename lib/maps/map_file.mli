(** Maps from files of other programs. *)

open Dolphin_geo

type thing = Point of Position.t | Line of Position.t list  (** of at least two *) | Area of Area.t

val read : path:string -> string -> ((string * thing) list, string) result
(** [read ~path text] is what the map with this contents has, by name, in the order of the file. The end of [path] says
    which format it is: one of {!formats}. What has no name is ["area 1"], ["line 1"], ["point 1"], counted by kind;
    what has the name of another is ["NAME 2"]. Or what is wrong with it, and where, in one sentence. *)

(** What stands on a map as it is drawn; whether it makes an area is nobody's business. *)
type outline =
  | Spot of Position.t
  | Way of Position.t list
  | Rings of Position.t list list  (** rims and holes: a place is inside if it is within an odd number of them *)
  | Round of { centre : Position.t; radius : float  (** m *) }

val outlines : path:string -> string -> ((string * outline) list, string) result
(** [outlines ~path text] is what the map has, by the names that stand in it, [""] where none does; else as {!read}. *)

val formats : string list
(** Ends of files' names: [".geojson"] and so on. *)

val most_bytes : int
(** 20 million: longer files, and archives that are longer unpacked, are errors. *)
