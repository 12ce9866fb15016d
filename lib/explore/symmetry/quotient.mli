(** States of an executing task up to its automorphisms ({!Task_group}), as words. *)

type t

val create : Components.t -> Encoding.t -> t
(** [create components encoding] is for tasks of these components in this encoding. *)

val state : t -> Task_group.t -> Layout.t -> int array -> int -> Task_group.state
(** [state t g s key n] is the state [key] of layout [s], with shared [n], for [g]. *)

val canonical : t -> Task_group.t -> Layout.t -> int array -> int -> into:int array -> Task_group.permutation
(** [canonical t g s key n ~into] puts the canonical form of that state ({!Task_group.canonical}) into [into].
    The result leads there.
    @raise Layouts.Outgrown *)

val cover : Coverage.t -> Task_isomorphism.label -> unit
(** [cover c l] notes that [l] is reached. *)
