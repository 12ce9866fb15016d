(* On random programs, the labelled transition system is the graph by the book: the same states, and from each the same
   labels to the same states, as often; and several processes give states the numbers that one gives. PROGRAMS in the
   environment is how many programs are tried, 300 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
open Cases

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 300
let limits = { Dolphin_checker.Limits.none with max_states = Some 2_000 }
let compared = ref 0
let together = ref 0

module States = Hashtbl.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = Configuration.hash c + Environment.hash e
  end)

(* By the numbers of the graph by the book. *)
let is_graph (graph : Reference.t) (system, listed) =
  let numbers = States.create 100 in
  Array.iteri (fun i (s : Reference.state) -> States.add numbers (s.configuration, s.outside) i) graph.states;
  let number i = States.find numbers (Transition_system.state system i) in
  let expected =
    let edge i ((t : Transition.t), j) = (i, Format.asprintf "%a" Label.pp t.label, j) in
    List.concat (Array.to_list (Array.mapi (fun i edges -> List.map (edge i) edges) graph.edges))
  in
  let found = List.map (fun (i, label, j) -> (number i, label, number j)) listed in
  Transition_system.states system = Array.length graph.states
  && number 0 = 0
  && List.sort compare found = List.sort compare expected

let explore ~workers environment program world =
  let found = ref [] in
  let each i label j = found := (i, label, j) :: !found in
  Result.map
    (fun system -> (system, List.rev !found))
    (Transition_system.explore ~workers ~fork_from:0 limits environment program world each)

let agrees (((_, world), _, (_, environment)) as case) =
  let program = compile case in
  match Reference.explore ~limit:2_000 environment program world, explore ~workers:1 environment program world with
  | exception Environment.Unclear _ -> (
      match explore ~workers:1 environment program world with Error (Unclear _) -> true | Ok _ | Error _ -> false)
  | None, Error (Stopped States) -> true
  | None, _ | Some _, Error _ -> false
  | Some graph, Ok alone ->
    incr compared;
    let same (system, listed) =
      let state i = Transition_system.state system i and state' i = Transition_system.state (fst alone) i in
      let is_same i =
        let c, e = state i and c', e' = state' i in
        Environment.compare e e' = 0 && Configuration.equal c c'
      in
      listed = snd alone && List.for_all is_same (List.init (Transition_system.states system) Fun.id)
    in
    (is_graph graph alone || QCheck2.Test.fail_report "it is not the graph by the book")
    &&
    if !compared mod 5 > 0 then true
    else
      match explore ~workers:2 environment program world with
      | Ok system ->
        incr together;
        same system || QCheck2.Test.fail_report "two processes number it otherwise"
      | Error _ -> false

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"it is the graph by the book" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_126 ~programs test;
  Printf.printf "%d compared, %d also by two processes\n" !compared !together

let () =
  Alcotest.run "transition system"
    [ ("random programs", [ Alcotest.test_case "it is the graph by the book" `Quick test_agreement ]) ]
