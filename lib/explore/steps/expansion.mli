(** A state space as it grows: the states that there are, and going from the one that is expanded to others. {!Space}
    says which steps are taken. *)

open Dolphin_semantics
open Dolphin_environment

(** A state that a transition leads to. *)
type arrival = {
  into : int;
  by : Task_group.permutation option;  (** that led there from what the transition leads to *)
  letter : int;  (** of the watch, or 0 *)
}

type t = {
  options : Environment.options;
  reduction : Reduction.t;
  program : Core.program;
  world : World.t;
  parts : Components.t;
  cases : Memoised_steps.t;
  words : Encoding.t;
  shapes : Layouts.t;
  mutable states : Dolphin_checker.States.t;
  mutable key : int array;  (** the state being expanded, changed in place for its successors and changed back *)
  mutable other : int array;  (** successors of another shape *)
  mutable transitions : int;
  broken : int array;  (** by rank in [Property.all]: the first state, or -1 *)
  script : Script_graph.t;
  mutable fresh : int -> int -> unit;  (** what is done with new states, by number and first word *)
  mutable gathering : bool;
  mutable gathered : arrival list;
  watch : Product.t option;
  mutable watched : int;  (** what the watch knows of the state being expanded *)
  mutable action : int;  (** of the step being taken, for the watch *)
  mutable shown : int;  (** the first state that shows a violation, or -1 *)
  task_groups : Task_groups.t option;
  quotient : Quotient.t;
  interrupted : (int, int * int) Hashtbl.t;  (** by number of what is shared: where an interruption leads *)
  mutable canonical : int array;  (** a state's canonical form *)
  vehicles : Canonical_vehicles.t option;
  reserve : int -> unit;
}

val create :
  ?reduction:Reduction.t ->
  ?symmetry:Symmetry.t ->
  ?asked:Condition.t list ->
  ?compress:bool ->
  ?reserve:(int -> unit) ->
  ?watch:Product.t ->
  Environment.options ->
  Core.program ->
  World.t ->
  t
(** See {!Space.create}. *)

(** {1:states States} *)

val load : t -> int -> int array
(** [load t i] is the words of state [i]. *)

val repack : t -> unit
(** Everything in fields that are wide enough. Nothing may wait to be added. *)

val flush : t -> unit
val note_broken : t -> Property.t -> int -> unit
val broken : t -> Property.t -> int option

val visit : t -> int array -> int -> unit
(** [visit t key i] adds the state [key], to which state [i] leads, or what stands for it; or gathers its number. If a
    watch has nothing to see after it, nothing is done. *)

val note_stays : t -> int -> unit
(** [note_stays t i]: a run may stay in state [i], which is [t.key], for nothing need happen there. *)

(** {1:going Going to other states}

    From state [i], which is [t.key] and of shape [s], with number [n] of what is shared.
    @raise Layouts.Outgrown *)

val go_to : t -> Layout.t -> Layout.place -> Component.target -> int -> int -> int -> unit
(** [go_to t s p target n n' i] is where [target] becomes of what stands at [p], with [n'] shared. *)

val go_by_case : t -> Layout.t -> Layout.place -> Component.step -> int -> int -> int
(** [go_by_case t s p step n i] takes [step] of what stands at [p]; the result is how many transitions that makes. *)

val go_to_ends : t -> Layout.t -> Layout.place -> Component.step -> int -> int -> int
(** Likewise, only as far as it ends the run. *)

val interrupt : t -> Layout.t -> int -> int -> int
(** [interrupt t s n i] is to where an interruption leads, if there are any. Nothing follows it, and it breaks nothing:
    whatever states are looked at, verdicts are the same with it. The result is how many transitions that makes. *)

val ends_run : Component.case -> bool
