(** Maps from files of other programs.

    {[
      open Dolphin_maps

      let map =
        {|{ "type": "Feature", "properties": { "name": "buoy" },
            "geometry": { "type": "Point", "coordinates": [-8.7062, 41.185] } }|}

      let () =
        match Map_file.read ~path:"harbour.geojson" map with
        | Ok { things = [ ("buoy", Ok (Point p)) ]; notes = [] } -> assert (p.latitude = 41.185)
        | _ -> assert false

      let () = assert (Result.is_error (Map_file.read ~path:"harbour.geojson" "{}"))
    ]} *)

open Dolphin_geo

(** A feature of a map. *)
type thing = Point of Position.t | Line of Position.t list  (** of at least two *) | Area of Area.t

type t = {
  things : (string * (thing, string) result) list;
  (** by name, in the order of the file; [Error why] where a feature makes no thing, [why] with its place in the
      file *)
  notes : string list;  (** the omissions and repairs: each a sentence with its place in the file *)
}

val read : path:string -> string -> (t, string) result
(** [read ~path text] is the features of the map with this contents. The end of [path] determines its format: one of
    {!formats}. A feature that has the name of an earlier one is ["NAME 2"], or the next number that is not another
    feature's name. A feature without a name is ["area 1"], ["line 1"], ["point 1"] or ["feature 1"], counted by
    kind. [Error why] if the file as a whole breaks its format, or if it has features and all of them are faulty: the
    fault and its place, in one sentence. *)

(** The contents of a map as drawn; whether they make areas is not checked. *)
type outline = Outline.t =
  | Spot of Position.t
  | Way of Position.t list
  | Rings of Position.t list list  (** rims and holes: a place is inside if it is within an odd number of them *)
  | Round of { centre : Position.t; radius : float  (** m *) }

val outlines : path:string -> string -> ((string * outline) list, string) result
(** [outlines ~path text] is the features of the map, by their names in it, [""] without one; else as {!read}. *)

val formats : string list
(** Ends of files' names: [".geojson"] and so on. *)

val most_bytes : int
(** 20 million: longer files, and archives that are longer unpacked, are errors. *)
