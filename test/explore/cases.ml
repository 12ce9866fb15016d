(* Random programs, each with a world and an environment, and whether it goes on without end. *)

open Dolphin_environment
open Dolphin_explore
module Generate = Test_support.Generate
module Posts = Test_support.Posts
module Calls = Test_support.Calls

let answering = Calls.answering

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with a loss", { answering with faults = { Faults.none with loss = At_most 1 } });
    ("with latecomers", { answering with faults = { Faults.none with join = Any_number }; may_be_late = (fun v -> v <> "a") });
    ( "with all of it, once",
      { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 } } );
    ("with all of it, twice", { answering with faults = twice });
    ("with inputs", { answering with inputs = Posts.inputs });
    ("with a failure and an input", { (Environment.failing ~failures:1 answering) with inputs = Posts.once });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } });
    ("with failures and interruptions", { answering with faults = { Faults.none with fail = Any_number; interrupt = true } })
  ]

let nested ~sensing =
  let open QCheck2.Gen in
  let nested = if sensing then Generate.sensing_nested else Generate.nested in
  let* depth = int_range 0 2 in
  let* posts = oneofl [ []; [ ("x", 1) ]; [ ("y", 2); ("x", 2) ] ] in
  let before = List.map (fun (k, x) -> Generate.statement (Generate.post k x)) posts in
  let before = if sensing then Generate.kept :: before else before in
  map (Generate.executing ~before) (nested ~vehicles:Generate.vehicles ~depth)

(* Programs without sensors and programs with, those in a world in which sensors show this or that. *)
let case =
  let open QCheck2.Gen in
  let program =
    frequency
      [ (3, map (fun p -> (p, Generate.world)) Generate.program);
        (3, map (fun p -> (p, Generate.world)) (Calls.within Generate.program));
        (2, map (fun p -> (p, Generate.world)) (nested ~sensing:false));
        (1, map (fun p -> (p, Generate.open_world)) Generate.sensing_program);
        (1, map (fun p -> (p, Generate.open_world)) (nested ~sensing:true)) ]
  in
  triple program (frequencyl [ (3, false); (1, true) ]) (oneofl environments)

let print ((program, world), looped, (name, _)) =
  let sensors = if Dolphin_semantics.World.is_open world then "open" else "closed" in
  Printf.sprintf "%s, %s world, %s:\n%s" name sensors (if looped then "for ever" else "once") (Generate.print program)

let compile ((ast, _), looped, (_, environment)) =
  Posts.declared environment (Generate.compile (if looped then Generate.for_ever ast else ast))

(* Each transition is offered where the run is, and leads where the next one starts; a cycle comes back. *)
let is_run ?start program world environment (run : Search.run) =
  let step states (t : Dolphin_semantics.Transition.t) =
    let offered (c, e) =
      List.filter_map
        (fun ((t' : Dolphin_semantics.Transition.t), e') ->
           if Dolphin_semantics.Configuration.equal t'.next t.next then Some (t'.next, e') else None)
        (List.of_seq (Environment.choices environment program world e c))
    in
    List.concat_map offered states
  in
  let beginning = (Dolphin_semantics.Configuration.initial program, Environment.initial) in
  let there = List.fold_left step [ Option.value start ~default:beginning ] run.steps in
  let back = List.fold_left step there run.cycle in
  let same (c, e) (c', e') = Dolphin_semantics.Configuration.equal c c' && Environment.compare e e' = 0 in
  there <> [] && List.exists (fun s -> List.exists (same s) back) there
