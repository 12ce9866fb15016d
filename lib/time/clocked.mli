(** Runs with time: the transition function with a clock for each awaited event. docs/semantics.md has the rules;
    this module defines when a transition may be taken, and the transition function its effect. *)

open Dolphin_semantics
open Dolphin_environment

(** A program with its world, and the times that all takes there. *)
type options = {
  environment : Environment.options;
  program : Core.program;
  world : World.t;
  durations : Durations.t;
  dates : (Dated_code.dates, Core.site) result;  (** {!Dated_code.named} of the program *)
}

(** The awaited events. *)
type item =
  | Task of Core.vehicle
  | Timer of Residual.timer
  | Question of Residual.timer  (** the answer to a task's question *)
  | Recruit of Residual.timer  (** a vehicle that may stay away *)
  | Answer
  | Reply
  | Posting of string  (** of a pair with this key *)
  | Links  (** the next change of a link that matters, from the start *)
  | Silence of Core.vehicle  (** that a task, or an order, is given up, as nothing is heard of its vehicle *)
  | Course of Core.vehicle
  (** never in a {!state}: since when the battery of a vehicle that is observed goes as it does ({!Course}) *)
  | Date of int  (** the date, in seconds since the start, at which code may take another branch *)

(** Of a task whose vehicle nothing is heard of. *)
type progress =
  | Under_way  (** and of all else *)
  | Ordered  (** the order waits for the link; the bounds of the task begin with it *)
  | Over  (** that it is waits for the link *)

(** An awaited event that has begun, with the time that it takes. *)
type pending = {
  item : item;
  bounds : Bounds.t;  (** from when it began *)
  task : Core.platform_task option;  (** of a [Task] *)
  prompt : string option;  (** of a [Question], or an [Answer]; of [Links], the change *)
  progress : progress;
}

(** A configuration without its clocks. *)
type state = private {
  configuration : Configuration.t;
  outside : Environment.t;
  pending : pending list;  (** in ascending order of [item] *)
  elsewhere : (Core.vehicle * Whereabouts.t option) list;
  (** the places of vehicles that have left their starting places; [None]: unknown *)
  patience : (Core.vehicle option * Bounds.t) list;
  (** how long the link of a vehicle, or of all others, may be silent, by the program; [[]] if none is lost
  *)
  date : int;  (** as code reads it: the latest that it names, of those that have passed *)
  changes : int;  (** the changes of links before this one are over, or do not matter *)
  settled : bool;  (** whether only links of vehicles in B matter: the program looks for no others any more *)
}

val initial : options -> state
(** The state in which runs begin. *)

val onwards :
  options -> state -> outside:Environment.t -> now:int -> began:(item -> int) ->
  seen:(Core.vehicle * Dolphin_geo.Position.t) list -> state
(** [onwards o s ~outside ~now ~began ~seen] is where a run goes on from that is in [s] at [now], in milliseconds since
    its start, such that dates from there on count from [now]: what is pending since [began] has that much less before
    it. It may take any time if it should be over; a timer expires at once. Vehicles at rest are where they were [seen];
    [outside] is the environment's memory. *)

val without_pairs : string list -> state -> state
(** [without_pairs ks s] is [s] without the pairs of N with one of the keys [ks]. *)

val doing : options -> state -> Core.vehicle -> Dolphin_scenario.Battery.doing
(** [doing o s v] is whether [v] carries a task out, and whether that charges its battery. It rests while its order
    waits for the link, and once its task is over; away from its chargers if it has some. *)

val may_do : options -> state -> Core.vehicle -> Dolphin_scenario.Battery.doing list
(** [may_do o s v] is all that [v] may be doing in [s], [doing o s v] first. At rest, a vehicle with chargers may be at
    one or not. A task that charges may be over already while the link is silent; then the vehicle rests. (A task that
    drains may be over too, but a lower bound that counts it to its latest end holds all the same.) *)

val in_turn : options -> state -> Core.vehicle -> Core.platform_task list -> Bounds.t list
(** [in_turn o s v ps] is the time that each of [ps] takes on [v], which carries them out one after the other from its
    place in [s]. *)

val compare : state -> state -> int
(** A total order. *)

val equal : state -> state -> bool
(** [equal s s'] is [compare s s' = 0]. *)

val hash : state -> int
(** Equal states have equal hashes. *)

module Table : Hashtbl.S with type key = state
(** Tables by states. *)

val site : state -> item -> Core.site option
(** [site s i] is the place in the program of timer [i]; [None] for other items, and if the place is not known. *)

(** The possible steps. Three steps are not transitions of the semantics, which knows no time: a link comes or goes,
    a task is over whose end is not heard, and a date passes that code names. They leave the configuration as it is. *)
type step = {
  transition : Transition.t;
  next : state;
  due : (item * Bounds.t) option;  (** when: this long after [item] began; [None]: at any moment *)
  fresh : item list;  (** the events whose wait begins with it, of [next.pending], in ascending order *)
  urgent : bool;  (** whether no time passes while it is possible *)
}

val steps : options -> state -> step list
(** [steps o s] is the possible steps in [s]. If some step is urgent, only steps without an event; of [START]s only the
    first, unless its vehicle's place matters: docs/time.md shows why that is enough.
    @raise Environment.Unclear *)

val all_steps : ?tick:(unit -> unit) -> options -> state -> step list
(** The same, with each [START]. [tick] is called before each step is computed; it may raise. *)

val enough : options -> ('a -> step) -> 'a list -> 'a list
(** [enough o step_of xs] is those of [xs], which belong to {!all_steps}, that belong to {!steps}. *)

val taken : options -> state -> on:Transition.event option -> Transition.t -> step
(** [taken o s ~on t] is the transition [t] of [s] as a step, whether or not it is among {!steps}; the memory of the
    environment stays as it is. *)

val transitions : options -> state -> step list -> Transition.t option list
(** [transitions o s steps] is the transitions of [steps], consecutive from [s], in the whole fleet: each [pick] and
    [recruit] also assumes the late and the missing vehicles. [None] if it is not one of the semantics. *)

val holds_up : step list -> (item * int) list
(** [holds_up steps] is the limit on the passage of time in a state with [steps], none of which is urgent: at most
    these milliseconds after each [item] began. *)

val may_change_during_tasks : options -> bool
(** Whether links may come or go while a task executes, and that matters. *)

val may_wait_for_recruits : options -> bool
(** Whether it is unknown how long a vehicle that a [recruit] asks for stays away. *)

val is_stuck : options -> state -> step list -> bool
(** [is_stuck o s steps] is whether [s], with [steps], is not an end and no step that must happen is left. *)
