(** Formulas of Hennessy and Milner's logic: the transitions of a state, to any depth. Two states of a finite graph
    are strongly bisimilar exactly if no formula holds in one only. *)

type t =
  | Can of string * t list
  (** [Can (l, fs)]: there is a transition with label [l] to a state in which all of [fs] hold *)
  | Not of t

val holds : Graph.t -> int -> t -> bool
(** [holds g s f]: whether [f] holds in state [s] of [g]. The time may be exponential in the depth of [f]. *)

val holds_within : steps:int -> Graph.t -> int -> t -> bool option
(** [holds_within ~steps g s f] is [Some (holds g s f)], or [None] if that takes more than [steps] steps. *)

val depth : t -> int
(** How many transitions deep a formula looks. *)

val pp : Format.formatter -> t -> unit
(** [<a>] is "it can do [a]", [<a> f] is "it can do [a], and then [f] holds"; with [and], [not] and parentheses:
    [<coin>(<coffee> and not <tea>)]. A formula with more than 1,000 parts ends in [...]; one that is deep takes no
    stack. *)
