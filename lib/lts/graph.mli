(** Labelled transition systems, explicit: an initial state, and a set of transitions.

    States are numbered from 0, and so are labels. The transitions that leave one state are numbered in a row: those
    of state [s] are [first g s], [first g s + 1] ... [first g (s + 1) - 1], in ascending order of label, then
    target. A transition that is there twice is one, unless the graph is made {e with doubles}. Functions that
    compare or minimise graphs take those without. A transition takes 8 bytes, a state 4.

    {[
      open Dolphin_lts

      let survey = Graph.of_list [ (0, "start", 1); (1, "done", 2); (1, "fail", 0) ]

      let () =
        assert (Graph.states survey = 3 && Graph.degree survey 1 = 2);
        assert (Graph.to_list (Graph.map_labels String.uppercase_ascii survey) |> List.hd = (0, "START", 1))
    ]} *)

type t

(** {1:build To build} *)

(** Graphs under construction. A builder is mutable. *)
module Builder : sig
  type graph := t
  type t

  val create : unit -> t
  (** No states and no transitions. *)

  val label : t -> string -> int
  (** [label b text] is the number of the label [text]: that of the first call with [text]. *)

  val add : t -> int -> string -> int -> unit
  (** [add b s text s'] adds the transition from [s] to [s'] with the label [text].
      @raise Invalid_argument if a state is negative or beyond {!Int_vector.limit}. *)

  val add_numbered : t -> int -> int -> int -> unit
  (** [add_numbered b s (label b text) s'] is [add b s text s'], faster.
      @raise Invalid_argument also if the label does not exist. *)

  val finish : ?doubles:bool -> ?initial:int -> ?states:int -> ?text:(int -> string) -> t -> graph
  (** [finish b] is the graph with the transitions added so far. Its number of states is [states] or, if that is less
      or absent, the least that holds all states mentioned. [initial] is 0 unless given; [text s] describes state
      [s]. [doubles] ([false] by default) is whether a transition that was added twice is there twice. *)
end

val of_list : ?initial:int -> ?states:int -> (int * string * int) list -> t
(** [of_list transitions] is the graph with these transitions: source, label, target. *)

val with_text : (int -> string) -> t -> t
(** [with_text f g] is [g] where [f s] describes state [s]. *)

val map_labels : (string -> string) -> t -> t
(** [map_labels f g] is [g] with every label [l] replaced by [f l]; transitions that become equal become one. *)

val union : t -> t -> t
(** [union g h] has the states of [g] and then those of [h], which are [states g] higher; its initial state is that
    of [g]. *)

val reverse : t -> t
(** [reverse g] is [g] with every transition turned round; the numbers of labels are the same. *)

val without_doubles : t -> t
(** [without_doubles g] is [g] where what is there twice is there once. *)

(** {1:read To read} *)

val initial : t -> int
(** The state where runs begin. *)

val states : t -> int
(** The number of states, at least 1. *)

val transitions : t -> int
(** The number of transitions. *)

val labels : t -> int
(** The number of labels. Some may be on no transition. *)

val label : t -> int -> string
(** [label g l] is the text of label number [l]. *)

val text : t -> (int -> string) option
(** The descriptions of the states, if any. *)

val first : t -> int -> int
(** [first g s] is the number of the first transition of [s]; [first g (states g)] is [transitions g]. *)

val label_of : t -> int -> int
(** [label_of g e] is the number of the label of transition [e]. *)

val target : t -> int -> int
(** [target g e] is the state that transition [e] leads to. *)

val degree : t -> int -> int
(** [degree g s] is the number of transitions that leave [s]. *)

val iter_from : t -> int -> (int -> int -> unit) -> unit
(** [iter_from g s f] is [f l s'] for every transition of [s], in order. *)

val fold_from : t -> int -> ('a -> int -> int -> 'a) -> 'a -> 'a
(** [fold_from g s f a] is [f (... (f a l s') ...) l s'] over the transitions of [s], in order. *)

val iter : t -> (int -> int -> int -> unit) -> unit
(** [iter g f] is [f s l s'] for every transition of [g], in ascending order. *)

val to_list : t -> (int * string * int) list
(** [of_list ~initial:(initial g) ~states:(states g) (to_list g)] equals [g] but for its description of states. *)

val equal : t -> t -> bool
(** Whether the initial state, the number of states and the transitions are the same, labels compared as texts. For
    graphs that are the same but for the numbers of states see {!Isomorphism}. *)

val pp : Format.formatter -> t -> unit
(** All of it, a transition a line: for small ones. *)
