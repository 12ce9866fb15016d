(** Traces that one state has and another has not. *)

type t =
  | First_only of string list  (** A shortest trace that only one of them has: the first. *)
  | Second_only of string list  (** A shortest trace that only one of them has: the second. *)
  | None
  | Not_known

val find : effort:int -> Graph.t -> int -> int -> t
(** [find ~effort g s t] compares the sequences of labels along runs from [s] and from [t], by looking at the sets of
    states that the same trace leads to: as many as [effort] states altogether, or else it is [Not_known]. The fewer
    states of [g] are bisimilar, the faster. *)
