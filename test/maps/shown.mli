(** Maps in a line of text, and parts of GeoJSON. *)

open Dolphin_geo

val at : ?height:float -> float -> float -> Position.t
(** [at latitude longitude]. *)

val case : string -> (unit -> unit) -> unit Alcotest.test_case
val check : string -> string -> string -> unit
(** [check what expected found]. *)

val shown : string -> string -> string
(** [shown path text] is the things of the map [text] by their names, then its notes; or what is wrong with it. *)

val feature : ?properties:string -> string -> string -> string
(** [feature kind coordinates] is a feature of GeoJSON, by default with the name ["a"]. *)

val collection : string list -> string
val square : string
(** A ring of some 111 m. *)
