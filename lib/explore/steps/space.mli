(** The state space of a program, as a system to be searched ({!Dolphin_checker.System}). A state is a configuration
    with what the environment remembers, encoded in a few words (see {!Layout}). Steps of executing configurations are
    found in the components ({!Components}): nothing is computed twice, and the transition function computes all of
    it. *)

open Dolphin_semantics
open Dolphin_environment

include
  Dolphin_checker.System.S with type via = Task_group.permutation option and type property = Property.t
(** [via] is the permutation from what a transition leads to, to what represents it: of states of the task or, when the
    task is over, of what was shared before. [None] where nothing was permuted. The anchors of cycles are the states in
    which no task executes. *)

val create :
  ?reduction:Reduction.t -> ?symmetry:Symmetry.t -> ?asked:Condition.t list -> ?labelling:Labelling.t ->
  Environment.options -> Core.program -> World.t -> t
(** States are those up to [symmetry], by default {!Symmetry.none}; {!expand} raises {!Symmetry.Broken} where a state
    shows that it is broken. Conditions that are [asked] have the same answer in all states that one represents; none
    by default. [labelling] is for the formula that is checked; then [reduction] and [symmetry] must be none. *)

(** {1:states States} *)

val state : t -> int array -> Configuration.t * Environment.t
(** [state t key] is the state [key], if it is {!view-type.Exact}. *)

(** What a state stands for. *)
type view =
  | Exact of Configuration.t * Environment.t  (** itself *)
  | Up_to of Task_group.t * Task_group.state  (** all states that become this one by symmetry *)

val view : t -> int array -> view

val quotient_state : t -> Task_group.t -> Configuration.t -> Environment.t -> Task_group.state option
(** [quotient_state t g c e] is [c] with [e] as [g] sees it, if it executes a task of [g]. *)

val shared : t -> int array -> int option
(** [shared t key] is the number of the shared state of [key], if it executes a task. *)

val unsettled : Core.program -> Fault.t -> Dolphin_checker.Limits.bound
(** [unsettled p fault] is that nobody can list what follows some state of [p], because of [fault]: more than a
    comparison depends on what a sensor shows. *)

(** {1:representatives Representatives} *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) Seq.t
(** [choices t e c] is the transitions of [c] with [e]; of those that lead to the same state up to names, one at
    least. *)

val canonical : t -> Configuration.t -> Environment.t -> Configuration.t * Environment.t
(** [canonical t c e] is the same for all states that are [c] with [e] up to names. *)

val has_vehicle_symmetry : t -> bool
(** Whether states of the script represent others. *)

(** {1:findings What was found on the way} *)

val used_task_symmetry : t -> bool
(** Whether some states of tasks represent others. *)

val used_vehicle_symmetry : t -> bool
(** Whether some states represent others in which vehicles have changed places. *)

val coverage : t -> Coverage.t
(** The code that was reached. *)
