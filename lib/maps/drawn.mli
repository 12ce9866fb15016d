(** The results of readers of map files, before names and areas are made of them. *)

open Dolphin_geo

(** One thing on a map. Rings may repeat their first corner at the end. *)
type shape =
  | Spot of Position.t
  | Way of Position.t list
  | Ground of ring list  (** polygons, each with its holes *)
  | Sketch of Position.t list  (** an area if it makes one, else a line *)
  | Round of { centre : Position.t; radius : float }
  | Flawed of string  (** no shape can be made of it, for this reason *)
  | Note of string  (** no shape, but a remark for people *)

(** A polygon: its rim, and the rims of its holes. *)
and ring = { rim : Position.t list; holes : Position.t list list }

type t = {
  name : string;  (** [""]: none *)
  place : string;  (** in the file, for messages *)
  shape : shape;
}

exception Wrong of { place : string; why : string }
(** The file is not as its format wants it. Readers raise it, {!Map_file.read} handles it. *)

val wrong : string -> ('a, unit, string, 'b) format4 -> 'a
(** [wrong place format ...] raises {!Wrong}. *)

val each : name:string -> place:string -> (unit -> shape list) -> t list
(** [each ~name ~place f] is the shapes of [f ()]. If [f] raises {!Wrong}, it is one {!Flawed} shape. *)

val left_out : ?name:string -> string -> ('a, unit, string, t list) format4 -> 'a
(** [left_out ~name place format ...] is a {!Note}: [format ...], "and left out". *)

val empty : shape
(** The {!Note} of a shape without positions. *)

val no_geometry : shape
(** The {!Note} of a place without a shape. *)

val some : shape list -> shape list
(** [some shapes] is [shapes], or {!empty} if there are none. *)

val non_empty : shape list -> shape list
(** [non_empty shapes] is [shapes] without {!empty} ones, or {!empty} if none is left. *)

(** {1 Rings}

    In GeoJSON and KML the last position of a ring is the first again. *)

val accuracy : float
(** A millimetre: a ring whose ends are at most that far apart is closed. *)

val gap : Position.t list -> float
(** [gap ring] is the distance of its last position from its first, in metres. *)

val closing : string -> Position.t list -> shape list
(** [closing name ring] is a {!Note} that names the ring and its gap, if that is longer than {!accuracy}. *)

val with_gaps : shape list -> shape list
(** [with_gaps shapes] is [shapes], and {!closing} of each rim and hole of their polygons. *)

val position : string -> latitude:float -> longitude:float -> height:float -> Position.t
(** [position place ...] is that position, or wrong at [place]. *)
