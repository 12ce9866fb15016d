(** [dolphin explore]: every interleaving of a program, and every choice of its outside, breadth first.

    {[
      open Dolphin_semantics
      open Dolphin_environment
      open Dolphin_explore

      let program =
        let text = "v = pick { count 1 }\nexecute v: allOf { when { consume go: 1 } then task('survey1') }" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let world = Scenario_world.world Dolphin_scenario.Scenario.default

      let () =
        let found = Search.run Search.default program world in
        assert (found.stopped = None && found.expanded = found.states);
        match List.assoc Property.No_deadlock found.verdicts with
        | Violated run -> assert run.shortest
        | _ -> assert false
    ]} *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker

(** {1:options Options} *)

(** This number of random walks, from this seed. *)
type walks = { number : int; seed : int }

(** Of which runs formulas are asked. *)
type fairness =
  | Weak  (** runs that are fair as for {!Property.Termination}, and endless runs without any event *)
  | Strong  (** those of them that take infinitely often each end of a plan, and each step that only an event can
                prevent, if it is possible infinitely often *)
  | No_fairness  (** all *)

(** The questions of an exploration, the way of its search, and its limits. *)
type options = {
  environment : Environment.options;
  reduction : Reduction.t;
  (** with invariants, and for formulas, only the symmetry of vehicles is used; where it matters which vehicle is lost
      ({!Later_picks}), no symmetry of tasks, since it identifies states that may differ in that *)
  compress : bool;  (** keep states in less memory, in more time *)
  spill : string option;
  (** the directory where states go once they take three quarters of [limits.max_memory]; neither with [compress] nor
      with [walks] or [bitstate] *)
  walks : walks option;  (** random walks in place of all states; formulas are not judged by walks *)
  bitstate : int option;
  (** bytes of an array of bits that represents states in place of a set, without [walks]: states are explored depth
      first, and some may be missed; formulas are judged as always *)
  search_again : int;
  (** number of states visited without reduction for a shortest run, if a reduced search found a violation, and for a
      run of a world, if the readings on the run that was found contradict each other ({!Moment_search}). With 0 the
      runs that were found are reported, also those of no world *)
  workers : int;
  (** processes, 1 by default, that search from [fork_from] states on, 100,000 by default, as for
      {!Breadth_first.Make.create} *)
  fork_from : int;
  spare_bits : int option;  (** as for {!Layouts.create} *)
  limits : Limits.t;
  properties : Property.t list;  (** those of {!Property.all} that are judged, by default all *)
  invariants : Condition.t list;
  formulas : Temporal.t list;  (** for each, states are explored again, after all others are forgotten *)
  fairness : fairness;  (** [Weak] by default; [Strong] is for termination, too, and needs all states *)
}

val default : options
(** No limits, no reduction, the default environment. *)

val most_again : options -> int
(** [most_again o] is how many states are searched again at most, for a shorter run or one of a world: [o.search_again],
    unless [o.limits] allow fewer. *)

val without_symmetry : options -> Core.program -> options
(** [without_symmetry o p] is [o] as {!run} searches [p] by it, but with nothing reduced by symmetry. *)

val space : options -> Core.program -> World.t -> Space.t
(** [space o p w] is the states that are searched by [o], which is {!without_symmetry}. *)

(** {1:outcomes Outcomes} *)

type faults = {
  number : int;  (** as {!Environment.options.most_faults} counts them, those on a cycle once *)
  fewest : bool;  (** no run that violates the property has fewer *)
}

(** A run from the initial configuration, or from the [start] of {!run}. *)
type run = {
  steps : Transition.t list;
  cycle : Transition.t list;  (** repeats without end after that, unless empty *)
  shortest : bool;
  (** no run with as few [faults] shows it in fewer steps; with a cycle, none comes to it in fewer *)
  decided : int option;
  (** after how many steps a formula is known not to hold, whatever follows, or if the run rests there; then
      [shortest] speaks of these steps. [None]: the cycle violates it, or no formula is asked *)
  faults : faults option;  (** by {!Fewest_faults}; [None] from {!run} *)
  helpful : Fair_cycles.help option;
  (** of termination: assumptions on readings ({!Environment.options}), and perhaps strong fairness, with which it
      would hold, if some are known *)
}

(** The verdict on one property. [Unreached] is of {!Property.All_reached}: the pieces that no run reaches. *)
type verdict =
  | Holds
  | Violated of run  (** without reduction, or if [search_again] states suffice, by a shortest run; for cycles,
                          without reduction, one with a shortest way to the cycle *)
  | Holds_if of World.assumption list list
  (** of runs that meet these assumptions on readings, which [environment.recurring] has; not of all *)
  | By_design of {
      repeats : Core.site list;
      retries : Core.site list;
      left_by : string list;
      needs : World.assumption list list;  (** of runs that meet these assumptions; otherwise it is violated *)
    }
  (** of termination: fair runs are endless only by rounds of these, each a [repeat] without end, or by [retry()] of
      these handlers, which may be [left_by] these events *)
  | Unreached of Coverage.piece list
  | Inconclusive of Limits.bound

(** The results of an exploration. [seconds] are of the [clock] of its limits. *)
type outcome = {
  states : int;
  transitions : int;
  expanded : int;  (** states whose transitions were followed: all, if no bound was met *)
  depth : int;  (** most transitions of a shortest run to a state *)
  formula_states : int;  (** states that were explored for formulas, in all: see {!Dolphin_checker.Breadth_first} *)
  beside_states : int;  (** states that were explored for plans side by side *)
  bytes : int;  (** of memory, as [max_memory] counts it: the most, if there are formulas *)
  seconds : float;
  stopped : Limits.bound option;
  reduction : Reduction.t;
  (** the one that was used in tasks: weaker than requested where the requested one would be unsound *)
  vehicle_symmetry : bool;  (** whether vehicle symmetry merged states of the script *)
  alike_values : bool;  (** whether values of N that no step depends on were taken for one ({!Alike_values}) *)
  sample : Sample.summary option;  (** the result of random walks *)
  bitstate : Bitstate.summary option;
  beside : Side_by_side.pair list;  (** plans that may run side by side, near each other or at an unknown distance *)
  ending_faults : (Property.t * Fault.t list) list;
  (** the faults that end runs and violate {!Property.No_error}, [Assertions], [Vehicles] or [Allocation]: for each
      place in the text one, if no more than 100,000 states were kept; [[]] otherwise. With symmetry of tasks, not of
      all places *)
  only_in_worlds : Property.t list;
  (** the properties that hold although some states that were found violate them: readings on each run there contradict
      each other ({!Moment_search}) *)
  fairness : fairness;  (** that of the options *)
  verdicts : (Property.t * verdict) list;
  (** for each of {!Property.all}, but for [All_reached] if there is a [start], then for each invariant and formula, and
      for the least distance between vehicles if the program has one *)
}

val side_by_side : options -> Core.program -> World.t -> Side_by_side.pair list * Limits.bound option
(** [side_by_side o p w] is [beside] of {!run}, and the bound that was met, if not all states were visited. *)

val run :
  ?start:Configuration.t * Environment.t -> ?phase:string -> ?started:float -> options -> Core.program -> World.t ->
  outcome
(** [run ~start o p w] explores [p] in [w], from [start] on, by default from its beginning. With a [start], to which
    some run of [p] must lead and which is not an end, nothing is reduced by symmetry, and formulas are of the runs
    from there on. A property holds only if all states were visited; violations found before a bound was met are
    real. [phase] is the present phase in reports of progress, and [started] as for {!Limits.guard}. *)

val reductions : outcome -> string list
(** Those that were used: {!Reduction.names}, and ["symmetry of vehicles"] for [vehicle_symmetry],
    ["symmetry of values"] for [alike_values]. *)

val needs : outcome -> World.assumption list list
(** The assumptions on readings that its verdicts need. *)

val pp_needs : Format.formatter -> World.assumption list list -> unit
(** ["if battery(a) > 0.8 recurs"] *)

val faults_text : faults -> string
(** ["without a fault"], ["with 2 faults"] *)

val pp_verdict : ?fairness:fairness -> Core.program -> Format.formatter -> Property.t * verdict -> unit
(** One line, without the runs: ["no deadlock: violated after 12 steps"], with the number of faults if it
    is known, and with the [fairness] (by default [Weak]) if that is strong and the property holds by it. *)
