(** The state space of a program, as a system to be searched ({!Dolphin_checker.System}). A state is a configuration
    with the environment's memory, encoded in a few words (see {!Layout}). Steps of executing configurations are
    found in the components ({!Components}): nothing is computed twice, and the transition function computes all of
    it. *)

open Dolphin_semantics
open Dolphin_environment

include
  Dolphin_checker.System.S with type via = Task_group.permutation option and type property = Property.t
(** [via] is the permutation from the successor of a transition to its representative: of states of the task or, when
    the task is over, of the shared part before. [None] where nothing was permuted. The anchors of cycles are the
    states in which no task executes. *)

val create :
  ?reduction:Reduction.t -> ?symmetry:Symmetry.t -> ?asked:Condition.t list -> ?observer:Observer.t ->
  ?spare_bits:int -> ?start:Configuration.t * Environment.t -> Environment.options -> Core.program -> World.t -> t
(** The runs from [start] on, by default from the beginning of the program; with another [start] nothing is reduced
    by [symmetry]. States are those up to [symmetry], by default {!Symmetry.none}; {!expand} raises
    {!Symmetry.Broken} where a state shows that it is broken. Conditions that are [asked] have the same answer in all
    states that one represents; none by default. [observer] numbers actions; [reduction] and [symmetry] must then be
    none. [spare_bits] is as for {!Layouts.create}. *)

(** {1:states States} *)

val state : t -> int array -> Configuration.t * Environment.t
(** [state t key] is the state [key], if it is {!view-type.Exact}. *)

(** The content of a state. *)
type view =
  | Exact of Configuration.t * Environment.t  (** itself *)
  | Up_to of Task_group.t * Task_group.state  (** all states that become this one by symmetry *)

val view : t -> int array -> view
(** [view t key] is the content of the state [key]. *)

val is_in_class : t -> Task_group.t -> Task_group.state -> Configuration.t -> Environment.t -> bool
(** [is_in_class t g s c e] is whether [c] with [e] executes a task of [g], and is [s] as [g] sees it. *)

val shared : t -> int array -> int option
(** [shared t key] is the number of the shared state of [key], if it executes a task. *)

val breadth : t -> int array -> int
(** [breadth t key] is how many components the task of [key] has; 0 if none executes. *)

val program : t -> Core.program
(** The program of {!create}. *)

val unsettled : Core.program -> Fault.t -> Dolphin_checker.Limits.bound
(** [unsettled p fault] reports that the successors of some state of [p] cannot be listed, because of [fault]: more
    than a comparison depends on a sensor reading. *)

val unclear : t -> Fault.t option
(** Why it cannot be listed what follows some state that was to be expanded: then [expand] raised that it is
    {!unsettled}. *)

(** {1:representatives Representatives} *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) Seq.t
(** [choices t e c] is the transitions of [c] with [e]; of those that lead to the same state up to names, one at
    least. *)

val canonical : t -> Configuration.t -> Environment.t -> Configuration.t * Environment.t
(** [canonical t c e] is the same for all states that are [c] with [e] up to names. *)

val has_vehicle_symmetry : t -> bool
(** Whether states of the script represent others. *)

(** {1:rounds Rounds}

    While a task executes, there are cycles only where a [repeat] goes round. *)

val goes_round : t -> bool
(** Whether some step begins a round of a [repeat] without a number of rounds. *)

val executes : t -> int -> bool
(** [executes t word] is whether a task executes in the states with this first word. *)

val may_cycle_in_script : t -> bool
(** As {!may_cycle}, of cycles that go through the script. *)

(** A step that is possible in a state of a task. [at] is the place in the task: from the outside in, positions among
    parallel parts, or {!inside} for the inside of a context. Together with its [name] it is unique in the state, and
    it stays the same in all states until the step is taken or cut off, or its part of the task is over. Until then
    it [stays] possible, whatever others do, unless it is a guard. It [depends] if sensors may show something with
    which it is not possible, or does something else. *)
type possible = { at : int list; name : int list; stays : bool; depends : bool; step : Component.step }

val may_all_stay_away : t -> int array -> Dolphin_semantics.Core.vehicle list -> bool
(** [may_all_stay_away t key vs] is {!Environment.may_all_stay_away} in the state [key], in which a task executes. *)

val inside : int
(** Stands in [at] for the inside of a context; it is not a position. *)

type layers = (int list * Dolphin_semantics.Residual.again) list
(** The repeats around a step, the innermost first, each with its place. *)

val examine :
  t -> int array -> possible:(possible -> unit) -> 
  taken:(possible -> Dolphin_semantics.Task_rules.round list -> layers -> World.assumption list list -> unit) ->
  via Dolphin_checker.System.visitor -> unit
(** [examine t key ~possible ~taken v] is [expand t key v] for a state in which a task executes. It calls [possible]
    for each step that is possible in it and, before it visits the successor of a followed step, [taken] with any of
    these lists: the rounds that begin, the repeats around, and its assumptions. Interruptions and inputs are left
    out: neither is on a cycle. *)

val examine_script : t -> int array -> taken:(Transition.t -> unit) -> via Dolphin_checker.System.visitor -> unit
(** [examine_script t key ~taken v] is [expand t key v] for a state in which no task executes; [taken] is called before
    the target of a transition is visited. *)

val world : t -> World.t
(** The world of {!create}. *)

val inputs_at : t -> Environment.t -> string list
(** [inputs_at t e] is the keys of the inputs that may come where the environment remembers [e]. *)

(** {1:portable States for other processes} *)

type portable
(** States as strings that are the same in every process ({!Portable}). *)

val portable : ?digest:(string -> string) -> Portable.codec -> t -> portable
(** [portable codec t] is for a [t] without symmetry. *)

val give : portable -> string -> unit
(** As {!Portable.give}. *)

val news : portable -> string list
(** As {!Portable.give} and {!Portable.news}: the parts that states name. *)

val to_string : portable -> int array -> string
(** [to_string p key] is the state [key]. Exceptions of the codec pass through, in {!of_string} too.
    @raise Portable.Ambiguous *)

(** The state read from a text. *)
type source =
  | State of int array  (** a new vector *)
  | End of Configuration.t * Environment.t
  (** The property violated by an end follows from the transition, so it gets no number here. *)

val of_string : portable -> string -> source
(** [of_string p text] is the state written as [text].
    @raise Portable.Wrong if it is not what {!to_string} gives for some state, or names a part that is not known
    @raise Outgrown *)

val place : portable -> int array -> string
(** [place p key] is a digest, of 16 bytes, of the place of the script at which state [key] is. Between two states in
    which tasks execute it stays the same. A state graph has no cycle if its places have none, and no search of a part
    of it {!goes_round}. *)

(** {1:findings What was found on the way} *)

val used_task_symmetry : t -> bool
(** Whether some states of tasks represent others. *)

val exchanges : t -> bool
(** Whether states may represent others with other vehicles: {!has_vehicle_symmetry} or {!used_task_symmetry}. *)

val used_vehicle_symmetry : t -> bool
(** Whether some states represent others in which vehicles have changed places. *)

val coverage : t -> Coverage.t
(** The code that was reached. *)
