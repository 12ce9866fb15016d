(** Whether two graphs are the same but for the numbers of their states and labels. *)

(** One of the two graphs, in the order of the arguments. *)
type side = Left | Right

(** The first difference. Traces lead from the initial state. *)
type reason =
  | Enabled of { trace : string list; left : string list; right : string list }
  (** After [trace], a shortest one, the left graph can do [left], the right one [right]. *)
  | Merged of { side : side; trace : string list; other : string list }
  (** [trace] and [other] lead to one state in the graph on this side, and to two in the other. *)
  | Unmatched of { side : side; trace : string list option; left : int; right : int; steps : int }
  (** [trace] leads in the graph on this side to a state of a kind of which the left graph has [left] and the right
      one [right]; states are of one kind if [steps] steps, forwards or back, with all transitions counted, do not
      distinguish them. Without such a reachable state, there is no trace. *)
  | No_matching  (** Each state can be matched with one of the other graph, but not all at once. *)
  | Undecided  (** {!effort} was spent. Only graphs with rare symmetries need that much. *)

(** The reason why two graphs are not the same, with their sizes. *)
type difference = {
  states : int * int;  (** how many there are, left and right *)
  transitions : int * int;
  reason : reason;
}

val effort : int
(** The states that are copied in search of a matching of graphs that colour refinement cannot decide. *)

val check : Graph.t -> Graph.t -> (unit, difference) result
(** [check left right] is [Ok ()] if there is a bijection of the states, unreachable ones included, that takes the
    initial state to the initial state and the set of transitions, labels compared as texts, to the set of
    transitions.

    Graphs in which a state and a label determine the next state are walked through side by side, in linear time.
    Others are refined by the surroundings of each state, see {!Refinement}, which decides nearly always; remaining
    symmetry is broken by trial. *)

val pp_difference : Format.formatter -> difference -> unit
(** The numbers of states and transitions of each, and their difference; several lines. *)
