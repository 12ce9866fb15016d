(** State graphs that a model prints while TLC explores it, as the models of [dolphin tla] do under [Graph.cfg].

    TLC's own dumps name actions and nothing else, so the model prints each state when TLC first comes to it, with
    all its transitions. A line is one string literal of TLA+ (see {!Quoted}), of these fields with tabulators between:

    {v
S <tab> state <tab> ending <tab> program          a state
E <tab> label <tab> state <tab> rules             a transition of the last state, and where it leads
    v}

    Equal states have equal texts. Labels and endings may contain tabulators, other fields do not. [ending] says how a state has
    ended, if it has; it becomes a transition from the state to itself. [program] is a number, of the program that the state is of, where a model has several;
    the first state of each is its initial one. [ending] and [program] may both be missing, which is as if they were empty, and 1. *)

open Dolphin_lts

type t

val create : unit -> t

type problem =
  | Not_a_line of string  (** which begins as such a line does *)
  | No_state_yet  (** a transition before any state *)
  | Twice of string  (** a state *)
  | No_such_state of string  (** to which a transition leads *)
  | Other_program of { from : int; target : int }  (** a transition leads to a state of another one *)
  | No_states

val line : t -> string -> (bool, problem) result
(** [line g s] takes in a line of TLC's output. [Ok false] if it is not one of the above, but TLC's own. *)

val ending_label : string -> string
(** [ending_label e] is the label of the transition that stands for the ending [e]. *)

val label : rules:string -> string -> string
(** [label ~rules l] is the label of a transition with the label [l] and that derivation: both, so that what is compared
    is both. *)

val rules : string -> string list
(** [rules (label ~rules l)] is [rules], one by one. *)

val states : t -> int
val transitions : t -> int
(** Lines of each so far. *)

val graphs : t -> ((int * Graph.t) list, problem) result
(** [graphs g], when all lines were read, is the graphs by program, in ascending order. *)

val pp_problem : Format.formatter -> problem -> unit
