(** The states of a program's state space one by one, for searches that other programs make: a state in, its
    successors out. States are texts that are the same in every process. docs/successors.md has the protocol. *)

(** The questions about the states. *)
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
(** The owner of states, on one line of JSON: the version, digests of program and fleet, the questions. *)

(** {1:batches Batches} *)

(** A state that is asked about. *)
type source = {
  text : string;
  is_end : bool;  (** as its kind has it: an end without successors *)
}

val before : source
(** Its text is [""]: one transition leads from it, to the initial state. *)

(** The violations of a state. *)
type breach =
  | Breaks of Dolphin_explore.Property.t
  | Makes_false of int  (** the invariant at this place of those that were asked, from 0 *)

(** The successors of the states of a batch. *)
type batch = {
  transitions : int;
  blocks : State_columns.t array;
  (** the states that transitions lead to, each once, by {!partition}; in the order in which they are reached, each with
      the first that leads there *)
  targets : int list array;
  (** if they are asked for: by place of the state in the batch, the places in [blocks], one after the other, of the
      states that its transitions lead to, in their order *)
  broken : (breach * string) list;
  (** each with the least digest of the states that do so: of those in the batch, for deadlocks and invariants; of those
      that they lead to, for all others *)
  parts : string list;  (** that states in [blocks] name, and that were neither sent nor given before *)
  places : (string * string) list;  (** which place of the script comes after which: {!Dolphin_explore.Space.place} *)
  goes_round : bool;  (** whether so far rounds of some task were seen to repeat *)
  unreached : string list;  (** the pieces of the program that none of the states so far reaches *)
  trouble : string option;  (** why an invariant cannot be evaluated *)
}

val kind : is_end:bool -> Dolphin_explore.Property.t option -> int
(** [kind ~is_end broken] is the kind in columns of a state that is reached: whether it is an end, and its
    violations. *)

val is_end : int -> bool
(** [is_end k] is whether kind [k] is that of an end. *)

val partition : partitions:int -> string -> int
(** [partition ~partitions digest] is which of them the state with this digest belongs to, from 0. *)

val give : t -> string list -> (unit, Error.t) result
(** [give t parts] makes [t] know [parts], that states name. The error is {!Error.Inconclusive}: two have the same
    name. *)

val expand : ?partitions:int -> ?targets:bool -> t -> source list -> (batch, Error.t) result
(** [expand t states] is the successors of [states], by default in one partition and without targets. The error is
    {!Error.Bad_input} if one is not a state, or names a part that [t] does not know; {!Error.Inconclusive} if its
    successors cannot be listed, a part is too large to be written, or two parts have the same name. *)

(** {1:runs Runs} *)

val run : t -> string list -> (Dolphin_semantics.Transition.t list, Error.t) result
(** [run t states] is the run from the initial state through [states], the initial one left out. *)

(** {1:channels On channels} *)

val serve : t -> in_channel -> out_channel -> (unit, Error.t) result
(** [serve t input output] answers batches up to the end of [input]. *)

val print_run : t -> in_channel -> (unit, Error.t) result
(** [print_run t input] prints {!run} of the one batch that [input] has. *)
