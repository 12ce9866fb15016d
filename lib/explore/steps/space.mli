(** The state space of a program, state by state. A state is the configuration and what the outside remembers; it is
    kept as a few words (see {!Layout}), configurations that execute nothing as a number. Steps of executing
    configurations are found in the parts (see {!Components}): nothing is computed twice, and the transition function
    computes
    all of it. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create :
  ?reduction:Reduction.t -> ?symmetry:Symmetry.t -> ?asked:Condition.t list -> ?compress:bool ->
  ?reserve:(int -> unit) -> ?watch:Product.t -> Environment.options -> Core.program -> World.t -> t
(** With the initial state, number 0. States are those up to [symmetry], by default
    {!Symmetry.none}; what visits states raises [Symmetry.Broken] if one of them breaks it. Conditions that are
    [asked] have the same answer in all that a state stands for; none by default. [compress] is as for
    {!Dolphin_checker.States.create}, [false] by default. [reserve n] is called before [n] bytes are taken at once to lay states out
    anew; it may raise.

    With a [watch] each state is kept once for each thing that the watch may know there, and [reduction] and [symmetry] must
    be none: see {!section:watched}. Then there may be no state at all. *)

val expand : t -> int -> unit
(** [expand t i] adds the states that transitions of state [i] lead to, at the latest when {!flush} is called. *)

val flush : t -> unit

val forget_waiting : t -> unit
(** What has not been added yet is not: for when there is no memory. *)

val successors : t -> int -> int list
(** [successors t i] is the states that transitions of [i] lead to, which have all been added before. *)

val steps : t -> int -> (int * Task_group.permutation option) list
(** [steps t i] is {!successors}, each with the permutation that led there from what the transition leads to: of state
    [i] of the task, or, when the task is over, of what was shared before. [None] where nothing was permuted. *)

val state : t -> int -> Configuration.t * Environment.t
(** [state t i] is state [i], if it is {!view-type.Exact}. *)

(** What a state stands for. *)
type view =
  | Exact of Configuration.t * Environment.t  (** itself *)
  | Up_to of Task_group.t * Task_group.state  (** the orbit of this one *)

val view : t -> int -> view

val quotient_state : t -> Task_group.t -> Configuration.t -> Environment.t -> Task_group.state option
(** [quotient_state t g c e] is [c] with [e], if it executes a task of [g]. *)

val breaks : t -> int -> Property.t option
(** [breaks t i] is what reaching state [i] breaks, if it is an end. *)

val shared : t -> int -> int
(** [shared t i] is a number for the store, N, B and what the outside remembers of state [i], if it executes a task, and
    otherwise -1. *)

val parent : t -> int -> int
(** [parent t i] is the state from which [i] was reached first; 0 is its own. *)

(** {1:watched Under a watch} *)

val watched : t -> int -> int
(** [watched t i] is what the watch knows in state [i]. *)

val arrivals : t -> int -> (int * int) list
(** [arrivals t i] is {!successors}, each with the letter of the transition and the state. *)

val executes : t -> int -> bool
(** [executes t i] is whether a task executes in state [i]. *)

val shown : t -> int option
(** The first state found from which every run violates the formula, or which has no transitions and where a run that
    stays violates it. *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) list
(** [choices t e c] is the transitions of [c] with [e], of those that lead to the same up to names one at least. *)

val canonical : t -> Configuration.t -> Environment.t -> Configuration.t * Environment.t
(** [canonical t c e] is the same for all that is [c] with [e] up to names. *)

val has_vehicle_symmetry : t -> bool
(** Whether vehicles are exchanged in states of the script. *)

(** {1:findings What was found on the way} *)

val count : t -> int
val transitions : t -> int

val broken : t -> Property.t -> int option
(** [broken t p] is the first state that shows that [p] is broken, for [No_deadlock] and for what ends break. *)

val may_cycle : t -> bool
(** Whether a run can come back to where it was, as far as can be seen from the places of the script alone: [false] is
    certain. *)

val used_task_symmetry : t -> bool
(** Whether some states of tasks stand for others. *)

val used_vehicle_symmetry : t -> bool
(** Whether vehicle symmetry merged states of the script. *)

val coverage : t -> Coverage.t

val bytes : t -> int
(** Memory outside of OCaml's heap. *)

val bytes_to_grow : t -> by:int -> int
(** [bytes_to_grow t ~by:n] is how much more may be taken at once for the next [n] states. *)

val words : t -> int

val statistics : Format.formatter -> t -> unit
(** How many parts, shapes, ... there are: for measuring. *)
