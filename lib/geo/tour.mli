(** In which order to go along strips: short ways found by trying. *)

(** A strip along a part of {!Bands}, from its left to its right end or back. *)
type strip = { part : int; rightwards : bool }

type t
(** Parts, and ways between strips along them that were asked for. It is mutable. *)

val make : Bands.part array -> t
(** [make parts] is [parts], of which no way has been asked for. *)

val shortest : t -> strip list
(** [shortest t] has each part once. Strips that follow one another without a choice, part above part, are gone
    along there and back; the order of these stacks is the best one for up to {!most_exact} strips or stacks, and else
    the best of those that go on to the nearest stack, after moving single stacks as long as that makes the tour
    shorter. Of best tours it is the one that begins highest, and to the right. *)

val most_exact : int
(** 8. *)

val way : t -> strip -> strip -> (float * float) list
(** [way t a b] are the points between the end of [a] and the beginning of [b]: from part to part through their
    gates, so that it is never farther from the region than one and a half times the height of a band. [[]] if a
    straight line suffices, or if the region has no way. *)

val length : t -> strip list -> float
(** [length t strips] is the length of the tour along [strips], in the unit of [parts]: the strips, and the ways between
    them as {!way} has them. *)
