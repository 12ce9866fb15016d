(** State graphs that a model prints while TLC explores it, as the models of [dolphin tla] do under [Graph.cfg].

    TLC's own dumps name actions and nothing else, so the model prints each state when TLC first comes to it, with
    all its transitions. A line is one string literal of TLA+ (see {!Quoted}), of these fields with tabulators between:

    {v
S <tab> state <tab> program             a state
M <tab> mark                            something that can be seen of it
E <tab> label <tab> state <tab> rules   a transition of it, and where it leads
    v}

    Equal states have equal texts. A label may contain tabulators, other fields do not. If a model has several
    programs, [program] is the number of the state's program, and is 1 if it is missing; the first state of each
    program is its initial one. A mark becomes a transition from the state to itself, so that comparing graphs
    compares marks too: how a state has ended, and its A, B and N, which labels do not show. *)

open Dolphin_lts

type t

val create : unit -> t
(** No line was read. Mutable. *)

(** The fault of a line, or of all of them. *)
type problem =
  | Not_a_line of string  (** which begins as such a line does *)
  | No_state_yet  (** a transition or a mark before any state *)
  | Twice of string  (** a state *)
  | No_such_state of string  (** to which a transition leads *)
  | Other_program of { from : int; target : int }  (** a transition leads to a state of another one *)
  | No_states

val line : t -> string -> (bool, problem) result
(** [line g s] takes in a line of TLC's output. [Ok false] if it is not one of the above, but TLC's own. *)

val mark : string -> string
(** [mark m] is the label of the transition that stands for the mark [m]. *)

val label : rules:string -> string -> string
(** [label ~rules l] is the label of a transition with the label [l] and that derivation: both, so that what is compared
    is both. *)

val states : t -> int
(** The number of lines with a state so far. *)

val transitions : t -> int
(** Lines of each so far; marks are not transitions. *)

val used : t -> string -> int
(** [used g rule] is how many transitions so far have the rule of this name in their derivation. *)

val graphs : t -> ((int * Graph.t) list, problem) result
(** [graphs g], when all lines were read, is the graphs by program, in ascending order. *)

val pp_problem : Format.formatter -> problem -> unit
(** One sentence without a full stop. *)
