(** States that stand for all that are alike ({!Symmetry}), as words. *)

type t

val create : Components.t -> Encoding.t -> t

val state : t -> Symmetry.t -> Layout.t -> int array -> int -> Symmetry.state
(** [state t g s key n] is the state [key] of shape [s], with shared [n], as [g] sees it. *)

val canonical : t -> Symmetry.t -> Layout.t -> int array -> int -> into:int array -> Symmetry.permutation
(** [canonical t g s key n ~into] puts a state that is alike, mostly the same one for all that are, into [into]; the
    result leads there.
    @raise Layouts.Outgrown *)

val cover : Coverage.t -> Task_isomorphism.label -> unit
(** [cover c l] notes that [l] is reached. *)
