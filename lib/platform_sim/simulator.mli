(** The simulated fleet as a platform, and the tutorial for authors of platforms.

    {1:tutorial How a platform is made}

    A platform is a module of type {!Dolphin_runtime.Platform.S}: fourteen values, most of them one line long. It
    decides nothing about programs. It reports the events of vehicles, and carries out commands. Here is how to make
    one, with this one as the example.

    {2 Separate what happens from how it comes in}

    Write the part that can be tested without a network or a clock first: a value that holds all that the platform
    knows, and pure functions from it to it. Here that is {!Fleet}: [step] is the next thing that happens, [start],
    [stop], [set_timer] and the others are the commands. For a platform of real vehicles it is the table of vehicles,
    and a function from a datagram that came, or a time that has come, to events and datagrams to send. The shell around
    it, this module, is then short: it keeps the current state in one mutable field, and waits.

    {2 Reports on vehicles}

    Only your [Vehicle] events announce vehicles to the program. Send one when a vehicle is first heard of; when its
    link comes or goes ([connected]), for [pick] takes only connected ones; and when its position or battery has
    changed, at these times:
    - about once a second for each vehicle that the program holds ([bind], [release]), while [telemetry] is on: some
      condition of the program may depend on it, or a display shows it;
    - always just before the end of a task is reported: the nearest vehicle gets the next task.

    Unchanged values need not be reported again. After [announce_period] every vehicle in reach has been heard of: a
    [pick] without a timeout looks for this time. It may be short where vehicles are known at once; here it is 10 s as
    for vehicles on a network, so that a program finds the same vehicles here as there.

    {2 Run tasks}

    [start v task] never fails and never waits: failures are reported later, as [Task_failed (v, why)], with [why] a few
    words in the vehicle's own terms. A task with a [plan] is described in the program; one without is known to the
    vehicle by its [name]. Exactly one of [Task_done v] and [Task_failed (v, _)] follows each [start v], and none once
    [stop v] was called: not even if the event had been prepared and waits to be handed out. In {!Fleet} this is why the
    end of a task and the report of it are two occurrences: [stop] removes whichever is still to come. On a real network
    a stop needs an answer; [start] then waits for it first, and [close] waits for all of them.

    {2 Notice silence}

    A vehicle whose link is silent while it works for the program fails its task when the silence lasts longer than its
    connection timeout: 60 s, unless [set_connection_timeout] was called for it or for all. If the link returns before,
    nothing happened, and the vehicle's events in between are reported then. An order that cannot be delivered waits in
    the same way. Only vehicles that have something to do for the program fail; others are just not [connected].

    {2 Keep time}

    [now] is the platform's own clock, from 0. [set_timer] makes one event [Timer]; setting a timer that runs starts it
    again, [cancel_timer] makes it as if it had never been set. Events at the same time come in the order in which they
    were caused: a run must be reproducible from its inputs.

    {2 Hand out events one at a time}

    [next p] resolves with the next event, when there is one. The driver asks again when it has dealt with it, and calls
    commands in between, and also while [next p] is pending: a command may cause an event that comes sooner than the one
    waited for. So wait for both, the time of the next event and a change of the plans ([Make] in the implementation
    does it in ten lines). When the driver cancels the promise, no event may be lost.

    If time only passes in [next], set [virtual_time = true]; the driver then lets it stand still while it waits for
    people.

    {2 Test it}

    [test/platform_sim] has a case for each sentence above: the end of a task that comes while the link is silent, a
    stop between the end and its report, two timers at one time, a command while [next] is pending. It also commands a
    fleet at random and checks that each task is heard of exactly once. Do the same to yours.

    {1:simulation What is simulated}

    Vehicles have a position, a battery, and a link that comes and goes by the scenario. How tasks go is
    {!Simulated_execution}'s, how batteries go is {!Vehicle}'s. A seed and a scenario determine everything: the same
    commands at the same times see the same events. The execution of a task depends on the seed, the vehicle, the task's
    ordinal on that vehicle and the task's entry in the scenario, and on nothing else.

    {[
      open Dolphin_platform_sim

      let fleet = Simulator.Virtual.create ~seed:1 Dolphin_scenario.Scenario.default
      let survey = { Dolphin_semantics.Core.name = "survey1"; plan = None; task_site = 0 }

      (* The end of the first task, whatever is reported before it. *)
      let rec ended () =
        Lwt.bind (Simulator.Virtual.next fleet) (function
            | Task_done v | Task_failed (v, _) -> Lwt.return v
            | Vehicle _ | Timer _ | Input _ | Quiet -> ended ())

      let () =
        Simulator.Virtual.bind fleet [ "noptilus-1" ];
        Simulator.Virtual.start fleet ~number:0 "noptilus-1" survey;
        assert (Lwt_main.run (ended ()) = "noptilus-1");
        assert (Simulator.Virtual.now fleet >= 60.)
    ]} *)

open Dolphin_semantics
open Dolphin_runtime
open Dolphin_scenario

(** The additional functions of simulated platforms. *)
module type S = sig
  include Platform.S

  val idle : t -> bool
  (** [idle p] is whether no event will ever come of [p] unless it is commanded. In virtual time [next p] is [Quiet]
      then; in real time it is pending until a command causes an event. *)

  val vehicles : t -> World.vehicle_state list
  (** All vehicles that were heard of, in the scenario's order: as they are now, or, without a link, as they were last
      seen. *)

  val running : t -> Core.vehicle -> string option
  (** [running p v] is the name of the task that [v] runs, or was ordered to run, for the program. *)
end

(** Time passes only in [next], at once: a mission of an hour takes milliseconds. [next p] is resolved whenever it is
    called. *)
module Virtual : sig
  include S

  val create : seed:int -> Scenario.t -> t
  (** [create ~seed s] is the fleet of [s] at time 0. *)

  val create_again :
    seed:int -> Scenario.t -> History.t -> (t * World.vehicle_state list, string) result
    (** [create_again ~seed s history] is the platform of a run whose console died after [history], with the reports
        on vehicles since the journal's last lines on them. The state of the fleet follows from its commands and
        their times: it is simulated again. No time has passed since the last entry. The error is the reason why
        [history] is not one of this fleet. *)
end

(** Time passes by itself, perhaps faster than outside. *)
module Paced : sig
  include S

  val create : ?clock:Clock.t -> ?speed:float -> seed:int -> Scenario.t -> t
  (** [create ~clock ~speed ~seed s] starts now; [speed] seconds (by default 1) pass in a second of [clock] (by default
      {!Clock.system}).
      @raise Invalid_argument if [speed] is not finite, or not more than 0. *)

  val create_again :
    ?clock:Clock.t ->
    ?speed:float ->
    seed:int ->
    Scenario.t ->
    History.t ->
    (t * World.vehicle_state list, string) result
    (** As that of {!Virtual}: the fleet stood still while no console ran. *)
end
