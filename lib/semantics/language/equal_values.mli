(** Sets of values, in which values that programs take for equal are one: [1] and [1.0]. *)

type t

val empty : t
(** The set without values. *)

val add : Value.t -> t -> t
(** [add x xs] is [xs] with [x], in logarithmic time unless [x] has more than a thousand parts. *)

val mem : Value.t -> t -> bool
(** [mem x xs] is whether some [y] of [xs] has [Value.equals x y], in the same time. *)
