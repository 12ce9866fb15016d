(** How early and how late a program's runs do what they do.

    {[
      open Dolphin_semantics
      open Dolphin_environment
      open Dolphin_time

      let scenario =
        let fleet = "vehicle 'x8-02', { type 'UAV'; at Location.APDL }\nplan 'survey1', { duration 3.min, 9.min }" in
        Result.get_ok (Dolphin_scenario.Scenario.read ~file:"a.fleet" fleet)

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1') >> task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let options =
        { Clocked.program; world = Scenario_world.world scenario; dates = Dated_code.named program;
          environment = Scenario_world.environment ~answers:[] ~faults:Faults.none program scenario;
          durations = Durations.of_scenario scenario }

      let () =
        let outcome = Timed_analysis.run Dolphin_checker.Limits.none options in
        assert (outcome.endings = [ (Completed, { earliest = 360_000; latest = At 1_080_000 }) ]);
        assert (Timed_analysis.in_time ~deadline:1_080_000 outcome = Holds);
        assert (Timed_analysis.in_time ~deadline:1_000_000 outcome = Violated)
    ]} *)

open Dolphin_semantics

(** A latest date. *)
type date = Timed_system.date = At of int | Unbounded  (** milliseconds since the start *)

(** From the earliest to the latest date; both are reached by some run. *)
type window = { earliest : int; latest : date }

(** A run in which everything happens as late, or as early, as can be. *)
type run = {
  steps : Transition.t list;
  dates : int list;  (** of each step, in milliseconds; [[]] if they have no latest dates *)
  turns : Batteries.turn list;  (** then, too, when vehicles set out and cease to be under way *)
  cycle : Transition.t list;  (** the cycle after it *)
  chain : Schedule.link list;  (** the durations that add up to its last date *)
}

(** As {!Successors.reduction}. *)
type reduction = Timed_system.reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

(** A platform task by its plan, its vehicle and its place in the program. *)
type task = Timed_system.task = { name : string; vehicle : Core.vehicle; site : Core.site }

(** How much is left in a battery, at any time until the end of a run. *)
type battery = {
  vehicle : Core.vehicle;
  least : float;  (** no run has less *)
  lowest : (float * run) option;
  (** a run, and the least that is left in it, which is [least] where it is exact; [None] if the program looks at
      sensors, or if some run may not end by any date *)
}

(** Plans side by side, if there is a least distance between vehicles. *)
type apart = {
  fence : string;  (** as it is declared *)
  pairs : Dolphin_explore.Side_by_side.pair list;  (** those that may run at the same time *)
  cut_short : Dolphin_checker.Limits.bound option;  (** there may be more of them *)
}

(** The results for all runs; [seconds] are of the [clock] of the limits, [bytes] of memory. *)
type outcome = {
  endings : (Timed_system.ending * window) list;  (** the ways in which runs end *)
  tasks : (task * (Timed_system.moment * window) list) list;  (** all that run in some run *)
  last : run option;  (** one that ends last, if all end *)
  first : run option;  (** one that ends first *)
  endless : (run * [ `Cycle | `In_no_time | `Stuck ]) option;  (** one that never ends *)
  unknown : Clocked.pending list;  (** the events of unknown duration *)
  deadlines : (Core.site * (window * run) option) list;
  (** the [within] of the program, each with when it is missed, and a run in which it is; [None]: it is kept *)
  late : run option;  (** one that is not over at the deadline *)
  failing : run option;  (** one that fails *)
  batteries : battery list;
  (** of vehicles that run a task; if some run may not end by any date, only those with a bound above 0 *)
  apart : apart option;
  stopped : Dolphin_checker.Limits.bound option;
  (** if there is a bound, dates are of the runs that were looked at *)
  reduction : reduction;  (** that was used in the end *)
  states : int;
  depth : int;
  seconds : float;
  bytes : int;
}

type start = { state : Clocked.state; date : int  (** milliseconds since the start of the run *) }
(** Where a run is that goes on: {!Clocked.onwards}. *)

val run :
  ?start:start -> ?reduction:reduction -> ?deadline:int -> ?vehicles:Dolphin_scenario.Scenario.vehicle list ->
  Dolphin_checker.Limits.t -> Clocked.options -> outcome
(** [run ~deadline ~vehicles limits o] is the complete result, within [limits]; [deadline] is in milliseconds; of
    [vehicles], by default none, the batteries are analysed. The [reduction], all by default, makes no difference to
    the answers, but for how close the bounds of batteries are. With a [start], the result is of the rest of the run:
    nothing is reduced, and batteries, whose charge then is not known, are not analysed. Without a [start], [endless]
    and [failing] are runs without faults of the environment if there are such runs. *)

val latest : outcome -> date option
(** [latest o] is when the last run is over; [None] if none that was looked at ends. *)

(** The slack of tasks: how much longer each could take without a later end of the last run. *)
type slacks = {
  known : (task * Slack.t) list;
  cut_short : Dolphin_checker.Limits.bound option;  (** an interruption, or a process ended early *)
}

val slacks : ?workers:int -> Dolphin_checker.Limits.t -> Clocked.options -> outcome -> slacks
(** [slacks limits o outcome] is the slack of each task of [outcome], which is of [o], by searches of their own;
    without those that are not found within [limits], each search for itself but for the time. None is known if it is
    not known that all runs end by some date. [workers] processes look for them, by default 1, as in
    {!Share_out.all}. *)

(** The verdict on a program and its deadline. *)
type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive

(** Why a program does not do what it should in time. *)
type shortfall =
  | Never_ends  (** some run *)
  | Fails
  | Late  (** some run is not over at the deadline *)
  | Misses  (** a [within] *)
  | Empty  (** a battery, in some run *)
  | Too_near  (** plans, in some run *)
  | Unknown
  (** a bound was met, a duration is unknown, a battery may be empty, or the distance between plans is unknown *)

val shortfall : ?deadline:int -> outcome -> shortfall option
(** [shortfall ~deadline o] is the first of these that is so; [None]: all runs end in time, none fails, and each
    [within] is kept, no battery runs empty, and no plans come too near. Without a [deadline] durations may be
    unknown. *)

val in_time : ?deadline:int -> outcome -> verdict
(** [in_time ~deadline o]: [Violated] if some run never ends, or ends after [deadline]; else [Inconclusive] if a
    bound was met, or the latest end is unknown; else [Holds]. *)

val runs_empty : battery -> bool
(** In some run. *)

val may_run_empty : battery -> bool
(** False only if it does in no run. *)

val judge_apart : apart -> verdict
(** [judge_apart a] is [Violated] if the ways of some pair come too near, and [Inconclusive] if that is not known of
    one, or there may be more. *)

val verdict : ?deadline:int -> outcome -> verdict
(** [verdict ~deadline o] is {!in_time}, with the batteries and {!judge_apart}: [Violated] if a battery runs empty in
    some run, and [Inconclusive] if it is not known of one. *)
