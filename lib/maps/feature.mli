(** The contents of a map that programs exchange. *)

open Dolphin_geo

(** A place of a track, with the time at which it was passed. *)
type sample = { time : float;  (** seconds since the beginning of 1970, in UTC *) position : Position.t }

(** The place of a feature. *)
type geometry =
  | Point of Position.t
  | Line of Position.t list  (** of at least two *)
  | Track of sample list list  (** parts in sight of each other, none of them empty, in order of time *)

(** The value of a property. *)
type property = Text of string | Number of float

type t = { name : string; geometry : geometry; properties : (string * property) list }

val begin_of_year : int -> float
(** [begin_of_year y], from year 1 on, is when it begins in UTC, in seconds since the beginning of 1970. *)

val utc : float -> string
(** [utc seconds] is a time as all formats write it: ["2026-03-01T12:00:00Z"], with milliseconds if it has some. Years
    have four digits: a later time is the end of the year 9999. *)

val parts : Position.t list -> Position.t list list
(** [parts line] is [line], cut where it crosses the meridian of 180 degrees: no part does. *)
