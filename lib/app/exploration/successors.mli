(** The states of a program's state space one by one, for searches that other programs make: a state in, what follows
    it out. States are texts that are the same in every process. docs/successors.md has the protocol. *)

(** What is asked of the states. *)
type settings = {
  answers : string list;  (** as in {!Exploration.settings}, like all of these *)
  faults : Dolphin_environment.Faults.t;
  reduction : Dolphin_explore.Reduction.t;
  invariants : string list;
}

type t

val create : version:string -> settings -> Program_file.t -> Fleet_file.t -> (t, Error.t) result
(** [create ~version s program fleet] knows no state yet. The error, {!Error.Bad_input}, is a wrong invariant. *)

val make :
  greeting:string -> Dolphin_explore.Search.options -> Program_file.t -> Dolphin_semantics.World.t -> t
(** [make ~greeting o program w] is of the states that {!Dolphin_explore.Search.run} searches by [o], but for symmetry;
    formulas and limits of [o] do not count. *)

val greeting : t -> string
(** What states belong to, on one line of JSON: the version, digests of program and fleet, what was asked. *)

(** A state that a transition leads to. *)
type successor = {
  text : string;
  is_end : bool;  (** nothing follows it *)
  broken : Dolphin_explore.Property.t option;  (** the property that is broken by reaching it *)
}

(** What follows a state. *)
type expansion = {
  transitions : int;
  targets : int list;  (** places of [successors], in the order of the transitions *)
  deadlock : bool;
  invariants : bool list;  (** whether it breaks each of those that were asked *)
}

(** Of a batch of states. *)
type batch = {
  successors : successor list;  (** each once, in the order in which they are reached *)
  expansions : expansion list;  (** in the order of the states *)
  places : (string * string) list;  (** which place of the script comes after which: {!Dolphin_explore.Space.place} *)
  goes_round : bool;  (** whether so far rounds of some task were seen to repeat *)
  unreached : string list;  (** the pieces of the program that none of the states so far reaches *)
  trouble : string option;  (** why an invariant cannot be told *)
}

val before : string
(** The text [""]: one transition leads from it, to the initial state. *)

val expand : t -> string list -> (batch, Error.t) result
(** [expand t states] is what follows [states]. The error is {!Error.Bad_input} where one is no state,
    {!Error.Inconclusive} where nobody can list what follows it, or a part is too large to be written. *)

val run : t -> string list -> (Dolphin_semantics.Transition.t list, Error.t) result
(** [run t states] is the run from the initial state through [states], the initial one left out. *)

val serve : t -> in_channel -> out_channel -> (unit, Error.t) result
(** [serve t input output] answers batches up to the end of [input]. *)

val print_run : t -> in_channel -> (unit, Error.t) result
(** [print_run t input] prints {!run} of the one batch that [input] has. *)
