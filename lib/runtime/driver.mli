(** Runs a program on a platform: asks {!Dolphin_semantics.Transition} what happens next, and carries it out. The
    driver has no semantics of its own.

    It takes the transitions that the program can make by itself, the leftmost first, until none is left, then waits
    for an event: of the platform, from the console, from the host process, or an interruption. Runs are reproducible
    from these events and their order. Nothing is polled.

    {[
      open Dolphin_semantics
      open Dolphin_runtime
      open Dolphin_platform_sim

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let fleet = Simulator.Virtual.create ~seed:1 Dolphin_scenario.Scenario.default
      let console = Console.scripted ~answers:[] ()
      let interruption = fst (Lwt.wait ())

      let () =
        let run = Driver.run (module Simulator.Virtual) fleet ~console ~interruption program in
        assert (Lwt_main.run run = Ended Completed);
        assert (Simulator.Virtual.running fleet "noptilus-1" = None)
    ]} *)

open Dolphin_semantics

(** The end of a run. *)
type outcome =
  | Ended of Configuration.ending
  | Stuck of Residual.t
  (** A deadlock: no task runs, no timer runs, no sensor matters, and every guard that the residual waits for is
      false, and stays so. The run was interrupted, and has ended since. *)
  | Spins of Core.site
  (** 10,000 rounds of the [repeat] there, of others, or of tasks that are tried again followed each other without time
      or an event from outside between them; or a vehicle began the task there, or others, that often. The run was
      interrupted, and has ended since. *)

val guards : Residual.t -> Core.closure list
(** [guards r] is the code of the guards and conditions that [r] waits for, leftmost first. *)

val pp_outcome : Format.formatter -> outcome -> unit
(** One sentence without a full stop. *)

(** Calls to the host process: see {!Host.call}. *)
type call =
  site:Core.site ->
  subject:string option ->
  member:string ->
  arguments:Core.value list option ->
  (Core.value, string) result Lwt.t

(** The beginning of a run that goes on with one whose console died. *)
type beginning = {
  configuration : Configuration.t;
  world : World.t;
  news : World.vehicle_state list;  (** of vehicles, since *)
  pending : Transition.event option;  (** that happened, and was not dealt with *)
  transitions : int;  (** before the next one *)
  time : float;  (** of the latest line of its journal *)
}

(** A program with which a run goes on, instead of the program that it began with. [configuration] is that of the run,
    as one of [program]: the same platform tasks, timers, questions and calls go on in it. *)
type replacement = { program : Core.program; configuration : Configuration.t }

val run :
  (module Platform.S with type t = 'platform) ->
  'platform ->
  ?always_telemetry:bool ->
  ?observer:Observer.t ->
  ?host:call ->
  ?inputs:Inputs.t ->
  ?replacements:(unit -> replacement option) Lwt_mvar.t ->
  ?beginning:beginning ->
  ?fenced:Fence_guard.past ->
  console:Console.t ->
  interruption:unit Lwt.t ->
  ?again:unit Lwt.t ->
  ?breakable:Breakable.t ->
  ?giving_up:((unit -> unit) -> unit) ->
  Core.program ->
  outcome Lwt.t
(** [run (module P) platform ~console ~interruption program] runs [program] until it ends, closes [platform], and is
    the outcome. When [interruption] resolves, the program is interrupted, whatever it is doing: it executes what it
    declares by [onInterrupt], or ends. When [again] resolves (by default never), it is interrupted once more, and ends.

    Transitions that the program makes by itself are computed within [breakable], by default one that nothing breaks
    off: a handler of a signal that breaks it off makes [interruption] or [again] resolve.

    A program that is stuck is interrupted by [giving_up interrupt], by default [interrupt ()]: observers that are
    called meanwhile see an interruption that no person asked for.

    The platform's telemetry is on while it may matter to the program, or with [~always_telemetry:true] (by default
    false), for displays and journals, all the time; in virtual time, a run is the same with and without it. Without
    [host], calls to the host process fail. The run takes pairs posted to [inputs] as they come, and a flood of them
    does not keep the platform's events away.

    The run begins with the program, or at [beginning], and [platform] is one that stands as it did then: tasks that the
    program has started and not ended run, its timers too. A question that was not answered, or a call of the host
    without reply, is made again.

    A function in [replacements] is called while the run waits for an event and no transition is left, unless it waits
    for a reply of the host, which comes first. With its replacement the run goes on at once, and nothing is commanded
    by the change itself. It has the fences of [program].

    If [program] has fences, {!Fenced} keeps the vehicles to them, from the state [fenced] of the run so far on.

    While the program waits for the console or the host, a platform of virtual time stands still.

    If the observer, the console, the host or the platform raises an exception, or the promise is cancelled, then all
    vehicles are stopped and released and [platform] is closed; then the promise fails with the exception. The
    observer does not get this end. *)
