(* On random programs, the packed search finds what the plain search over configurations finds: as many states and
   transitions, the same depth, the same properties broken, each by as short a run; and each run that it shows is one of
   the semantics. Of one program in three the states are compressed, of another they are on disk. PROGRAMS in the
   environment is how many programs are tried, 2,000 by default. *)

open Dolphin_environment
open Dolphin_explore
module Generate = Test_support.Generate
module Posts = Test_support.Posts
module Calls = Test_support.Calls
module Property = Dolphin_explore.Property

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 2_000

let answering = { Environment.default with answers = (fun _ -> [ [ "1"; "2" ]; [ "0" ] ]); replies = Calls.replies }

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

(* Each transition is offered where the run is, and leads where the next one starts; a cycle comes back. *)
let is_run program world environment (run : Search.run) =
  let step states (t : Dolphin_semantics.Transition.t) =
    let offered (c, e) =
      List.filter_map
        (fun ((t' : Dolphin_semantics.Transition.t), e') ->
           if Dolphin_semantics.Configuration.equal t'.next t.next then Some (t'.next, e') else None)
        (List.of_seq (Environment.choices environment program world e c))
    in
    List.concat_map offered states
  in
  let start = [ (Dolphin_semantics.Configuration.initial program, Environment.initial) ] in
  let there = List.fold_left step start run.steps in
  let back = List.fold_left step there run.cycle in
  let same (c, e) (c', e') = Dolphin_semantics.Configuration.equal c c' && Environment.compare e e' = 0 in
  there <> [] && List.exists (fun s -> List.exists (same s) back) there

let limit = 5_000
let skipped = ref 0
let broken = Hashtbl.create 7

let note property = Hashtbl.replace broken property (1 + Option.value (Hashtbl.find_opt broken property) ~default:0)

let verdict_agrees program world environment ~goes_round reference (property, verdict) =
  match (verdict : Search.verdict), List.assoc_opt property reference with
  | (Holds | By_design _), None when goes_round && property = Property.Termination -> true
  | Violated run, None when goes_round && property = Property.Termination -> is_run program world environment run
  | Holds, None -> true
  | Unreached _, None -> property = Property.All_reached
  | Violated run, Some length ->
    note property;
    let shown = List.length run.steps + List.length run.cycle in
    (shown = length || (property = Property.Termination && shown >= length)) && is_run program world environment run
  | (Holds | By_design _ | Violated _ | Unreached _ | Inconclusive _), (Some _ | None) -> false

let unsettled = ref 0

(* States go to disk at once: four fifths of the memory are always taken. *)
let on_disk : Dolphin_checker.Limits.t =
  let max_memory = 1_000_000_000_000 in
  let memory_taken () = Some (max_memory / 5 * 4) in
  { Dolphin_checker.Limits.none with max_memory = Some max_memory; memory_taken }

let agrees ((ast, world), looped, (_, environment)) =
  let program = Posts.declared environment (Generate.compile (if looped then Generate.for_ever ast else ast)) in
  match Reference.explore ~limit environment program world with
  | None ->
    incr skipped;
    true
  | exception Dolphin_environment.Environment.Unclear _ ->
    incr unsettled;
    let o = Search.run { Search.default with environment } program world in
    (match o.stopped with Some (Unsettled _) -> true | Some _ | None -> false)
  | Some reference ->
    let kept =
      match Hashtbl.hash (Generate.print ast) mod 3 with
      | 0 -> Search.default
      | 1 -> { Search.default with compress = true }
      | _ -> { Search.default with spill = Some (Filename.get_temp_dir_name ()); limits = on_disk }
    in
    let o = Search.run { kept with environment } program world in
    let same what expected found =
      if expected <> found then QCheck2.Test.fail_reportf "%d %s, %d expected" found what expected
    in
    same "states" (Array.length reference.states) o.states;
    same "transitions" (Reference.transitions reference) o.transitions;
    same "steps deep" (Reference.depth reference) o.depth;
    let shown = Reference.broken reference in
    let agree v =
      verdict_agrees program world environment ~goes_round:(Reference.goes_round reference) shown v
      || QCheck2.Test.fail_reportf "%a" (Search.pp_verdict program) v
    in
    List.for_all agree o.verdicts

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"packed and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual:20_240_817 ~programs test;
  Printf.printf "%d skipped, of more than %d states; %d unsettled\n" !skipped limit !unsettled;
  Hashtbl.iter (fun p n -> Printf.printf "%s: broken by %d\n" (Property.name p) n) broken

(* Without programs that break it, agreement on a property says little. *)
let test_variety () =
  let enough property =
    if property <> Property.All_reached && not (Hashtbl.mem broken property) then
      Alcotest.failf "no program breaks: %s" (Property.name property)
  in
  List.iter enough Property.all

(* Files of states have no name; the system tells which are open. *)
let test_files () =
  let descriptors = "/proc/self/fd" in
  let target name = try Unix.readlink (Filename.concat descriptors name) with Unix.Unix_error _ -> "" in
  let is_of_states path = List.mem "states" (String.split_on_char '.' (List.hd (String.split_on_char ' ' path))) in
  let targets = List.map target (Array.to_list (Sys.readdir descriptors)) in
  Alcotest.(check (list string)) "open files of states" [] (List.filter is_of_states targets)

let () =
  Alcotest.run "agreement"
    [
      ( "random programs",
        [
          Alcotest.test_case "packed and plain search agree" `Quick test_agreement;
          Alcotest.test_case "every property is broken by some" `Quick test_variety;
          Alcotest.test_case "what was on disk is given back" `Quick test_files;
        ] );
    ]
