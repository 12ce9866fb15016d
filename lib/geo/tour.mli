(** In which order to go along strips: short ways found by trying. *)

(** A strip along a part of {!Bands}, from its left to its right end or back. *)
type strip = { part : int; rightwards : bool }

val shortest : Bands.part array -> strip list
(** [shortest parts] has each part once. Strips that follow one another without a choice, part above part, are gone
    along there and back; the order of these stacks is the best one for up to {!most_exact} strips or stacks, and else
    the best of those that go on to the nearest stack, after moving single stacks as long as that makes the tour
    shorter. Of best tours it is the one that begins highest, and to the right. *)

val most_exact : int
(** 8. *)

val way : Bands.part array -> strip -> strip -> (float * float) list
(** [way parts a b] are the points between the end of [a] and the beginning of [b]: from part to part through their
    gates, so that it is never farther from the region than one and a half times the height of a band. [[]] if a
    straight line will do, and where there is no way through the region. *)

val length : Bands.part array -> strip list -> float
