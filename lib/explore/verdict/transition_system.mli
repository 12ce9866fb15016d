(** The labelled transition system of a program: all its states, without reduction, and the transitions between them
    with the labels of [docs/semantics.md].

    {[
      open Dolphin_semantics
      open Dolphin_environment
      open Dolphin_explore

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let world = Scenario_world.world Dolphin_scenario.Scenario.default

      let labels = Hashtbl.create 10

      let () =
        let each _ label _ = Hashtbl.replace labels label () in
        match Transition_system.explore Dolphin_checker.Limits.none Environment.default program world each with
        | Ok _ -> assert (Hashtbl.mem labels "done(x8-02, survey1)")
        | Error _ -> assert false
    ]} *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker

type t

(** The reason why there is none. *)
type problem =
  | Stopped of Limits.bound
  | Unclear of Fault.t  (** the successors of some state cannot be listed: more than a comparison depends on
                            something open *)

val explore :
  ?workers:int -> ?fork_from:int -> Limits.t -> Environment.options -> Core.program -> World.t ->
  (int -> string -> int -> unit) -> (t, problem) result
(** [explore limits o p w each] is that of [p], after [each i l j] for each transition: from state [i], with label
    [l], to state [j]. The initial state is 0, and states are numbered in the order in which transitions come to
    them. Two steps with one label that lead from one state to one state are two transitions. [workers] and
    [fork_from] are as in {!Search.options}; whatever they are, the result is the same. Its memory shared by
    processes is returned when the process ends. *)

val states : t -> int
(** The number of states. *)

val state : t -> int -> Configuration.t * Environment.t
(** [state t i] is the configuration of state [i], with the environment's memory. *)
