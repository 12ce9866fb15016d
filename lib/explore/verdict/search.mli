(** [dolphin explore]: every interleaving of a program, and every choice of its outside, breadth first. *)

open Dolphin_semantics
open Dolphin_environment

(** {1:options Options} *)

(** How far to go, and who is told. *)
type options = {
  environment : Environment.options;
  reduction : Reduction.t;
  (** where there are invariants, only that of what is the same up to names of vehicles; no symmetry of tasks where
      connections may be lost: states that are alike by it may differ in which vehicle is lost *)
  compress : bool;  (** keep states in less memory, in more time *)
  search_again : int;
  (** so many of all states are visited for a shortest run, if a reduced search found a violation *)
  max_states : int option;
  max_depth : int option;  (** in transitions *)
  max_memory : int option;  (** in bytes, of the whole process but for code and libraries *)
  memory_left : unit -> int option;
  (** bytes that the process can still have, if that is known; asked often. The search stops before it has nine tenths
      of all that it can have. *)
  timeout : float option;  (** in seconds of [clock] *)
  clock : unit -> float;  (** seconds, from any start *)
  invariants : Condition.t list;
  formulas : Temporal.t list;  (** for each, states are explored anew, after all others are forgotten *)
  interrupted : unit -> bool;  (** asked often: whether to stop *)
  progress : progress -> unit;  (** called about once a second *)
}

and progress = {
  phase : string;  (** what is being done *)
  states : int;
  rate : float;  (** states a second, since the start *)
  frontier : int;  (** states still to be expanded *)
  depth : int;
  memory : int;  (** bytes *)
  elapsed : float;  (** seconds *)
}

val default : options
(** No bounds, no reduction, the default environment, [Sys.time], no reports. *)

(** {1:outcomes Outcomes} *)

(** A run from the initial configuration. *)
type run = {
  steps : Transition.t list;
  cycle : Transition.t list;  (** goes on from there for ever, if there is any *)
  shortest : bool;  (** no run shows it in fewer steps; with a cycle, none comes to it in fewer *)
}

type bound =
  | States
  | Depth
  | Memory
  | No_memory  (** the machine has no more *)
  | Time
  | Interruption
  | Broken_condition of string  (** what was asked is faulty in some state *)
  | Unsettled of string
  (** in some state, nobody can list what may happen: more than comparisons depends on what a sensor shows *)

type verdict =
  | Holds
  | Violated of run  (** without reduction, or if [search_again] states show it, by a shortest run; for cycles, without
                          reduction, one with a shortest way to where it comes around *)
  | Unreached of Coverage.piece list
  | Inconclusive of bound

type outcome = {
  states : int;
  transitions : int;
  expanded : int;  (** states whose transitions were followed: all, if no bound was met *)
  depth : int;  (** most transitions of a shortest run to a state *)
  formula_states : int;  (** states that were explored for formulas, in all: see {!Product} *)
  bytes : int;  (** of memory, as [max_memory] counts it: the most, if there are formulas *)
  seconds : float;
  stopped : bound option;
  reduction : Reduction.t;
  (** the one that was used in tasks: less than was asked for where something stands against it *)
  vehicle_symmetry : bool;  (** whether vehicle symmetry merged states of the script *)
  verdicts : (Property.t * verdict) list;  (** for each of {!Property.all}, then for each invariant and formula *)
}

val run : options -> Core.program -> World.t -> outcome
(** [run o p w] explores [p] in [w]. A property is said to hold only if all states were visited; a violation found
    before a bound was met is one. *)

val reductions : outcome -> string list
(** Those that were used: {!Reduction.names}, and ["symmetry of vehicles"] for [vehicle_symmetry]. *)

val pp_bound : Format.formatter -> bound -> unit

val pp_verdict : Core.program -> Format.formatter -> Property.t * verdict -> unit
(** One line, without the runs: ["no deadlock: violated after 12 steps"]. *)
