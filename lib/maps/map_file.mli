(** Maps from files of other programs. *)

open Dolphin_geo

type thing = Point of Position.t | Line of Position.t list  (** of at least two *) | Area of Area.t

type t = {
  things : (string * (thing, string) result) list;
  (** by name, in the order of the file; [Error why] where a feature makes no thing, [why] with its place in the
      file *)
  notes : string list;  (** what is left out, and what was repaired: each a sentence with its place in the file *)
}

val read : path:string -> string -> (t, string) result
(** [read ~path text] is what the map with this contents has. The end of [path] says which format it is: one of
    {!formats}. A feature that has the name of an earlier one is ["NAME 2"], or the next number that is not another
    feature's name. A feature without a name is ["area 1"], ["line 1"], ["point 1"] or ["feature 1"], counted by kind.
    [Error why] if the file as a whole is not as its format wants it, or if no feature of it makes a thing and some
    should: what is wrong, and where, in one sentence. *)

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
