(** Polygons of other programs, whose corners are slightly wrong. *)

(** The repaired fault. *)
type change =
  | Spikes  (** the rim went out and back on the same line *)
  | Repetitions  (** a corner followed itself, within a millimetre or so *)
  | Crossings  (** the rim touched or crossed itself, which changes the area by less than a thousandth *)
  | Lost_holes  (** a hole had no extent *)
  | Holes  (** holes met, or reached out of the polygon, by less than a thousandth of the area *)

val polygon : ?holes:Position.t list list -> Position.t list -> (Area.t * change list, Area.error) result
(** [polygon ~holes corners] is {!Area.polygon} if that is an area, with no changes; else the area that was meant, with
    each change once, if the fault is slight; else the error of {!Area.polygon}. [Error Empty] if holes that were cut
    off or united leave less than a thousandth. *)

val pp : Format.formatter -> change -> unit
(** In words, as ["spikes are cut off"]. *)
