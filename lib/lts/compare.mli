(** Whether two graphs are strongly bisimilar, and if not, a formula that distinguishes them.

    {[
      open Dolphin_lts

      (* The choice between tea and coffee is made by the second coin, or after it. *)
      let early = Graph.of_list [ (0, "coin", 1); (0, "coin", 2); (1, "tea", 3); (2, "coffee", 3) ]
      let late = Graph.of_list [ (0, "coin", 1); (1, "tea", 2); (1, "coffee", 2) ]

      let () =
        assert (Compare.strong early early = Ok ());
        match Compare.strong early late with
        | Error { traces; formula } -> assert (traces = Same && Modal_formula.holds early 0 formula)
        | Ok () -> assert false
    ]} *)

(** One of the two graphs, in the order of the arguments. *)
type side = Left | Right

(** How two graphs differ in their traces, that is in the sequences of labels along runs from the initial state. *)
type traces =
  | Only of side * string list  (** A shortest trace that only one of them has. *)
  | Same  (** They have the same traces: they differ in when choices are made. *)
  | Not_known  (** It would have taken more than {!effort}. *)

(** The reason why two graphs are not bisimilar. *)
type difference = {
  formula : Modal_formula.t;
  (** It holds in the left initial state and not in the right one. No formula that does is less deep; among those, it
      is one with few conjuncts. *)
  traces : traces;
}

val effort : int
(** How many states the search for a difference of traces visits at most: a few seconds' work. A state counts once for
    each set of states with the same trace that it is in. Deciding on bisimilarity has no limit. *)

val strong : Graph.t -> Graph.t -> (unit, difference) result
(** [strong left right] is [Ok ()] exactly if the initial states are strongly bisimilar. *)

val isomorphic : Graph.t -> Graph.t -> (unit, Isomorphism.difference) result
(** {!Isomorphism.check}: whether they are the same but for the numbers of states. *)

val pp_difference : Format.formatter -> difference -> unit
(** Two sentences, a line each. *)
