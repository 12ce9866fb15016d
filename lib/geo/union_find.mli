(** Sets of numbers that are united. *)

val root : int array -> int -> int
(** [root parents i] is the number that stands for the set of [i]: the same for all of a set. At first, each number is
    its own parent; [parents.(root parents i) <- root parents j] unites the sets of [i] and [j]. *)
