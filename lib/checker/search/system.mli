(** Systems to explore: a transition system whose states are vectors of words. Types only. {!Breadth_first} knows a
    system by nothing else.

    {b What is equal.} States are equal if their vectors are. The vector that an expansion hands over is the one of a
    state that {e stands for} the state that the transition leads to: the system chooses which. Usually it is that
    state itself. With symmetry it is a canonical form. With inclusion, as for sets of clock valuations (zones), it is
    that of a state already handed over which includes the new one: the system keeps the zones that it has handed over,
    by the rest of the vector, and a zone is a word of the vector by its number, as {!Interner} gives it. A state
    that a later one includes stays in the store; the system may expand it to nothing but a transition to that one. *)

(** The visitor that an expansion calls for each transition. ['via] is how the successor of a transition became its
    representative: a permutation, for example. *)
type 'via visitor = {
  visit : int array -> int -> 'via -> unit;
  (** [visit key action via]: some transition, whose action has number [action], leads to the state in the first words
      of [key]. The system may reuse [key] once [visit] returns. Actions matter to formulas only. *)
  tick : unit -> unit;
  (** looks at the limits, which takes about a microsecond: to be called between transitions that take longer to find.
      @raise Limits.Stop *)
  rest : unit -> unit;
  (** a run may stay in the state without end, for no transition need happen; the vector that is expanded must be as
      it was handed over *)
}

(** A transition system with its encoding, its properties and its findings. *)
module type S = sig
  type t
  (** A system, with what it remembers between expansions. *)

  type via
  (** The way in which a successor became its representative; [unit] if each state stands for itself. *)

  type property
  (** A property that states violate by being reached; compared and hashed by the polymorphic operations. *)

  (** {1:encoding Encoding}

      No word is negative. The lowest bits of the first word are reserved for the search: they are 0 in all vectors
      that the system hands over or gets. *)

  exception Outgrown
  (** Some number does not fit into its field of the vector. *)

  val words : t -> int
  (** [words t] is how many words a vector has now. *)

  val widen : t -> reserved:int -> int array -> int array -> unit
  (** [widen t ~reserved] is called before all else, and after {!Outgrown}: it makes all fields as wide as they need
      be, and reserves [reserved] bits. It never makes a vector shorter. The function that it returns puts the state
      [old], in the encoding before, into [fresh], in the encoding after; [fresh] is all 0, and the reserved bits of
      [old] are not. *)

  val numbers : t -> int array -> (int -> unit) -> unit
  (** [numbers t key f] gives [f] the numbers, one after the other, that distinguish the state [key] from all others:
      the same after {!widen}. The search has no monitor. *)

  (** {1:transitions Transitions} *)

  val initial : t -> via visitor -> unit
  (** [initial t v] visits the initial state.
      @raise Outgrown
      @raise Limits.Stop with [Unsettled] if the initial state cannot be determined: then the search has no state. *)

  val expand : t -> int array -> via visitor -> int
  (** [expand t key v] visits the states that transitions of the state [key] lead to. It may change [key]. The result is
      the number of transitions: one of them may be visited more often, if several states together stand for its
      successor.
      @raise Outgrown when some have been visited: it is called again after {!widen}.
      @raise Limits.Stop with [Unsettled] if the system cannot list the successors of [key]. *)

  (** {1:workers Several processes}

      A system may be searched by processes that were forked from one: each has a [t] of its own then. So that
      vectors mean the same in all of them, whatever numbers something calls {!Numbering.give} first; [expand] may
      raise {!Numbering.Closed}, and is called again once numberings are open. The numbers that it gives then depend
      on the state and on earlier numberings, and on nothing else. *)

  val numbering : t -> Numbering.t
  (** The numberings of [t], which a search in several processes closes. *)

  val check_fit : t -> unit
  (** @raise Outgrown if a number that has been given does not fit *)

  type findings
  (** The findings of expansions, beside states: data without functions, which does not change. *)

  val findings : t -> findings
  (** [findings t] takes no time. *)

  val add_findings : t -> findings -> unit
  (** [add_findings t f] adds the findings of another process to those of [t]. *)

  (** {1:properties Properties}

      To be quick, the search asks them of a state's first word, reserved bits included. *)

  val broken : t -> int -> property option
  (** [broken t w] is the properties that reaching a state with first word [w] violates. *)

  val is_end : t -> int -> bool
  (** [is_end t w] is whether a run may rest in a state with first word [w] without being in a deadlock. *)

  (** {1:cycles Cycles} *)

  val may_cycle : t -> bool
  (** Once all states are expanded: [false] only if the graph has no cycle. *)

  val is_anchor : t -> int -> bool
  (** Every cycle goes through a state with [is_anchor t w] for its first word [w]. *)

  (** {1:formulas Formulas} *)

  val valuation : t -> int -> int array -> int
  (** [valuation t action key] is the number of the valuation of a formula's propositions where [action] leads to
      [key]; 0 is the action of resting. Asked only under a {!Dolphin_ltl.Monitor}. *)
end
