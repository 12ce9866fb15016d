(* Termination of tasks with rounds, judged by the definition of fairness ({!Fair_by_definition}). PROGRAMS in the
   environment is how many are tried, 1,000 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
open Fair_by_definition
module Generate = Test_support.Generate
module Pure_run = Test_support.Pure_run
module Linear = Test_support.Linear
module Formula = Dolphin_ltl.Formula
module Automaton = Dolphin_ltl.Automaton

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 1_000
let world = Generate.world

(* {1 Programs} *)

let leaf part place =
  let open QCheck2.Gen in
  let named = Printf.sprintf in
  let plan = named "task('p%d%d')[v%d]" part place part in
  let action code = named "action { %s; message 'm%d%d' }" code part place in
  frequency
    [ (4, return plan);
      (3, return (named "idle(%d)" (1 + (10 * part) + place)));
      (1, return (named "action { message 'm%d%d' }" part place));
      (2, return (action "h = 1 - h"));
      (2, return (action "if (!poll(k: 1)) { post k: 1 }"));
      (1, return (action "if (poll(k: 1)) { consume k: 1 }"));
      (1, return "condition { poll k: 1 }");
      (2, return "condition { consume k: 1 }");
      (1, return "condition { h == 1 }");
      (2, return (named "({ task('q%d%d') })[v%d]" part place part));
      (2, return (named "({ task('r%d%d') })[v1 + v2]" part place)) ]

let guard = QCheck2.Gen.oneofl [ "poll k: 1"; "consume k: 1"; "h == 1"; "false" ]

(* The labels of two parallel leaves of one kind differ only if they have names. *)
let body part =
  let open QCheck2.Gen in
  let named = Printf.sprintf "action { h = 1 - h; message 'n%d' }" part in
  frequency
    [ (2, leaf part 1);
      (3, map2 (Printf.sprintf "(%s >> %s)") (leaf part 1) (leaf part 2));
      (2, map (fun one -> Printf.sprintf "(%s | %s)" one named) (leaf part 1));
      (1, map2 (fun one g -> Printf.sprintf "(until { %s } run %s)" g one) (leaf part 1) guard);
      (1, map (fun one -> Printf.sprintf "(%s during 5)" one) (leaf part 1));
      (2, map (Printf.sprintf "(watch %s onError { retry() })") (leaf part 1));
      (1, map2 (Printf.sprintf "(watch %s onError { if (%s) retry() else ignore() })") (leaf part 1) guard) ]

let part number =
  let open QCheck2.Gen in
  let* body = body number in
  let* repeated =
    frequency
      [ (3, return ("(repeat " ^ body ^ ")"));
        (2, map (fun g -> Printf.sprintf "(repeat %s until { %s })" body g) guard);
        (1, return body) ]
  in
  frequency
    [ (3, return repeated);
      (1, map (fun g -> Printf.sprintf "(until { %s } run %s)" g repeated) guard);
      (1, return (Printf.sprintf "(%s during 9)" repeated)) ]

let source =
  let open QCheck2.Gen in
  let picks = "v1 = pick { id 'a' }\nv2 = pick { id 'b' }\nv3 = pick { id 'c' }\nh = 0\n" in
  let* n = int_range 1 3 in
  let* parts = flatten_l (List.init n (fun i -> part (i + 1))) in
  let* posts = oneofl [ ""; "post k: 1\n" ] in
  return (picks ^ posts ^ "execute " ^ String.concat " |\n        " parts)

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", Environment.default);
    ("with failures", Environment.failing Environment.default);
    ("with a failure", Environment.failing ~failures:1 Environment.default);
    ("with all faults, twice", { Environment.default with faults = twice }) ]

(* {1 Formulas} *)

(* A formula is violated if the component of some run with an accepted cycle is fair, or has no event: components are of
   the product of the graph with the automaton of the negated formula. Each step that is possible is followed as
   above. *)

let propositions = [ "ended"; "end"; "done"; "message"; "timeout"; "start"; "poll(k: 1)"; "running(p11)"; "{h == 1}" ]

let formula =
  let open QCheck2.Gen in
  let p = map (fun p -> Formula.Proposition p) (oneofl propositions) in
  let again f = Formula.Globally (Finally f) and at_last f = Formula.Finally (Globally f) in
  let literal = oneof [ p; map (fun f -> Formula.Not f) p ] in
  oneof
    [ map (fun f -> Formula.Finally f) literal; map again literal; map at_last literal;
      map2 (fun f g -> Formula.Globally (Implies (f, Finally g))) literal literal;
      map2 (fun f g -> Formula.Implies (again f, again g)) literal literal;
      map2 (fun f g -> Formula.Or (again f, at_last g)) literal literal;
      map2 (fun f g -> Formula.Until (f, g)) literal literal; Linear.formula (oneofl propositions) ]

(* Of the script, which has no cycle here, and of a run that stays where nothing need happen. *)
let other into = { into; step = ""; inside = false; closes = false; endless = false; part = -1; is_event = true;
                   looks = [ [] ]; owed_strongly = None }

let holds_of_fair_runs program (g : Reference.t) all f =
  let a = Automaton.of_formula (Formula.Not f) in
  let read = Letters.holds program world in
  let numbers = Hashtbl.create 100 and nodes = ref [] in
  let edges = Hashtbl.create 100 in
  let rec node i q =
    match Hashtbl.find_opt numbers (i, q) with
    | Some n -> n
    | None ->
      let n = Hashtbl.length numbers in
      Hashtbl.add numbers (i, q) n;
      nodes := (n, (i, q)) :: !nodes;
      let arrive letter j e =
        let continued q' = if Automaton.admits a q' (read letter) then Some { e with into = node j q' } else None in
        List.filter_map continued (Automaton.successors a q)
      in
      let c = g.states.(i).configuration in
      let is_stuck = Environment.is_stuck g.options program g.states.(i).outside (List.to_seq g.edges.(i)) in
      let of_edge k ((t : Transition.t), j) =
        arrive (Some t, t.next) j (if all.(i) = [] then other j else List.nth all.(i) k)
      in
      let stays = if is_stuck then arrive (None, c) i (other i) else [] in
      Hashtbl.replace edges n (stays @ List.concat (List.mapi of_edge g.edges.(i)));
      n
  in
  let first q = if Automaton.admits a q (read (None, g.states.(0).configuration)) then ignore (node 0 q) in
  List.iter first (Automaton.initial a);
  let count = Hashtbl.length numbers in
  if count > 300 then None else
    let pair = Array.make count (0, 0) in
    List.iter (fun (n, p) -> pair.(n) <- p) !nodes;
    let edges = Array.init count (Hashtbl.find edges) in
    let possible = Array.init count (fun n -> all.(fst pair.(n))) in
    let meets members k = List.exists (fun n -> Automaton.is_in a (snd pair.(n)) k) members in
    let is_accepting members = List.for_all (meets members) (List.init (Automaton.acceptance_sets a) Fun.id) in
    let without_event = Array.map (List.filter (fun e -> not e.is_event)) edges in
    Some
      (not
         (List.exists is_accepting (components without_event)
          || List.exists (fun members -> is_accepting members && is_fair possible edges members) (components edges)))

(* {1 Comparison} *)

let found = Hashtbl.create 3
let text = function Ends -> "holds" | Goes_on -> "violated" | By_design -> "by design"

let said (verdict : Search.verdict) =
  match verdict with
  | Holds -> "holds"
  | Holds_if _ -> "holds if"
  | Violated _ -> "violated"
  | By_design _ -> "by design"
  | Unreached _ | Inconclusive _ -> "inconclusive"

let note what = Hashtbl.replace found what (1 + Option.value ~default:0 (Hashtbl.find_opt found what))

let formulas_agree source environment program g all formulas =
  let shown = Format.asprintf "%a" (Formula.pp Format.pp_print_string) in
  let read f = Result.get_ok (Temporal.of_string program (shown f)) in
  let o = Search.run { Search.default with environment; formulas = List.map read formulas } program world in
  let agrees f =
    match holds_of_fair_runs program g all f with
    | None -> true
    | Some holds ->
      let verdict = said (List.assoc (Property.Formula (shown f)) o.verdicts) in
      let expected = if holds then "holds" else "violated" in
      note ("formula " ^ expected);
      verdict = expected || QCheck2.Test.fail_reportf "%s is %s, not %s, of %s" (shown f) verdict expected source
  in
  List.for_all agrees formulas

let compare source environment program formulas =
  match Reference.explore ~limit:250 environment program world with
  | None -> true
  | Some g ->
    let all = try Some (all_edges world g) with Ambiguous -> None in
    match all with
    | None -> true
    | Some all ->
      let agrees fairness expected reduction =
        let o = Search.run { Search.default with environment; reduction; fairness; search_again = 0 } program world in
        let verdict = said (List.assoc Property.Termination o.verdicts) in
        let reductions = String.concat ", " (Reduction.names reduction) in
        verdict = expected || QCheck2.Test.fail_reportf "%s, %s expected (%s) of %s" verdict expected reductions source
      in
      let weakly = text (judged g all) and strongly = text (judged ~divided:(strongly_fair all) g all) in
      note weakly;
      if strongly <> weakly then note "only strongly";
      List.for_all (agrees Search.Weak weakly) [ Reduction.Whole; Partial_order; All ]
      && List.for_all (agrees Search.Strong strongly) [ Reduction.Whole; All ]
      && formulas_agree source environment program g all formulas

(* A repetition without any wait is refused if its text shows that. *)
let is_refused ds =
  let of_round (d : Dolphin_syntax.Diagnostic.t) =
    String.starts_with ~prefix:"a round of this repeat never waits" d.message
  in
  List.for_all of_round ds

let agrees ((source, (_, environment)), formulas) =
  match Pure_run.compile source with
  | Ok program -> compare source environment program formulas
  | Error ds -> is_refused ds || failwith (Pure_run.explain source ds)

let test_fairness () =
  let print ((source, (name, _)), _) = name ^ ":\n" ^ source in
  let generator = QCheck2.Gen.(pair (pair source (oneofl environments)) (list_repeat 2 formula)) in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"termination by the definition" generator agrees in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Hashtbl.iter (Printf.printf "%s: %d\n") found

(* Steps that are cut off in each round are owed in none; steps outside of all rounds are. *)
let special =
  [ "execute until { poll k: 1 } run\n\
     repeat ((action { if (!poll(k: 1)) { post k: 1 }; message 'm' } >> idle(3)) during 5)";
    "execute (until { poll k: 1 } run repeat idle(1)) | (repeat (idle(2) >> action { post k: 1; message 'm' }\n\
     >> idle(3) >> condition { consume k: 1 }))";
    "execute (repeat (({ task('p') })[v1 + v2])) | ((repeat ({ task('q') })[v1]) during 5) | (({ task('r') })[v2])" ]

let test_special () =
  let picks = "v1 = pick { id 'a' }\nv2 = pick { id 'b' }\nh = 0\n" in
  let in_environment source (_, environment) =
    let formulas = List.map (fun p -> Formula.Finally (Proposition p)) propositions in
    assert (compare source environment (Pure_run.compile_exn source) formulas)
  in
  let check source = List.iter (in_environment (picks ^ source)) environments in
  List.iter check special

(* A recruit is owed where some vehicle that may come is never late, or where not all that may be late may be so in one
   run. [a] and [b] fit, [c] does not. *)
let test_recruits () =
  let program =
    Pure_run.compile_exn
      "v1 = pick { id 'c' }\n\
       execute (repeat idle(1) until { poll(k: 1) }) | recruit { type 'UUV' } then { action { post k: 1 } }"
  in
  let verdict late faults reduction =
    let may_be_late v = List.mem v late in
    let environment = { Environment.default with may_be_late; faults = Result.get_ok (Faults.of_string faults) } in
    let o = Search.run { Search.default with environment; reduction; search_again = 0 } program world in
    said (List.assoc Property.Termination o.verdicts)
  in
  let check (late, faults, expected) =
    let name = Printf.sprintf "%s late, %s" (String.concat ", " late) faults in
    List.iter
      (fun reduction -> Alcotest.(check string) name expected (verdict late faults reduction))
      [ Reduction.Whole; Partial_order; All ]
  in
  List.iter check
    [ ([], "join", "holds"); ([ "a" ], "join", "holds"); ([ "b" ], "join", "holds"); ([ "a"; "b" ], "join", "violated");
      ([ "a"; "b" ], "join=1", "holds"); ([ "a"; "b" ], "join=2", "violated"); ([ "c" ], "join", "holds");
      ([], "loss=1", "holds") ]

(* Without programs of each kind, agreement means little. *)
let test_variety () =
  let enough verdict =
    if Option.value ~default:0 (Hashtbl.find_opt found verdict) * 20 < programs then
      Alcotest.failf "too few programs for: %s" verdict
  in
  List.iter enough [ "holds"; "violated"; "by design"; "formula holds"; "formula violated" ];
  if not (Hashtbl.mem found "only strongly") then Alcotest.fail "no program terminates by strong fairness only"

let () =
  Alcotest.run "fairness"
    [ ( "random programs",
        [ Alcotest.test_case "special programs" `Quick test_special;
          Alcotest.test_case "recruits are owed unless all may stay away" `Quick test_recruits;
          Alcotest.test_case "termination is that of the definition" `Quick test_fairness;
          Alcotest.test_case "every verdict is given" `Quick test_variety ] ) ]
