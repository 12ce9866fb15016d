(** Parts as {!Symmetry} has them, and back. *)

type t

val create : Parts.t -> t

val kinds : t -> Symmetry.t -> Shape.t -> int array -> int array
(** [kinds t g s key] is the kinds of the parts of the state [key] of shape [s]. *)

val write : t -> Words.t -> int array -> Shape.frame -> Symmetry.t -> Symmetry.state -> unit
(** [write t w key f g state] puts the words of [state] into [key]. All code that its parts begin, and that of those that
    they stand for, counts as reached.
    @raise Shapes.Outgrown *)

val reach : Coverage.t -> Alike.label -> unit
