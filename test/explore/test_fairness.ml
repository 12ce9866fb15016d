(* Termination of tasks with rounds, judged by the definition of fairness: on the graph of [Reference], by labels and
   rules alone. Each step that is possible is followed until it is taken, not possible, or of a round that is over.
   If no run of a strongly connected component can come to that, no fair run stays in it. Programs are such that a
   label, the rule, and the parallel part identify the step. PROGRAMS in the environment is how many are tried, 1,000
   by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
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

(* {1 Steps} *)

let side_by_side (c : Configuration.t) =
  match c.control with
  | Executing (_, Parallel bs) -> Branches.to_list bs
  | Executing (_, r) -> [ r ]
  | Script _ | Waiting _ | Ended _ -> []

exception Ambiguous

(* The part that takes the step, if all stays as it is: the one that does so alone. *)
let unchanged (g : Reference.t) i (t : Transition.t) =
  let { Reference.configuration = c; outside } = g.states.(i) in
  let alone r =
    match c.control with
    | Executing (machine, _) -> { c with control = Executing (machine, r) }
    | Script _ | Waiting _ | Ended _ -> c
  in
  let takes r =
    let is_it ((t' : Transition.t), _) =
      Label.equal t.label t'.label && Configuration.equal t'.next (alone r)
    in
    List.exists is_it (List.of_seq (Environment.choices g.options g.program world outside (alone r)))
  in
  match List.filter (fun (_, r) -> takes r) (List.mapi (fun i r -> (i, r)) (side_by_side c)) with
  | [ (part, _) ] -> part
  | [] | _ :: _ -> raise Ambiguous

(* The part that takes the step. *)
let part_of g i (t : Transition.t) =
  let rec changed at = function
    | r :: rs, r' :: rs' -> if Residual.equal r r' then changed (at + 1) (rs, rs') else at
    | _ :: _, [] -> at
    | [], _ -> unchanged g i t
  in
  changed 0 (side_by_side g.Reference.states.(i).configuration, side_by_side t.next)

type edge = { into : int; step : string; inside : bool; closes : bool; endless : bool; part : int; is_event : bool }

let edge (g : Reference.t) i ((t : Transition.t), into) =
  let before = side_by_side g.states.(i).configuration in
  let part = part_of g i t in
  let has rule = List.mem rule t.rules in
  let closes = has Rule.Repeat_2 || has Repeat_again in
  let is_endless found = function Residual.Repeat { again = { until = None; _ }; _ } -> true || found | _ -> found in
  let endless =
    has Watch_retry || (closes && Residual.fold_all is_endless false (List.nth before part))
  in
  let inside = has Repeat_1 || has Repeat_2 in
  let step =
    match t.label, t.rules with
    | (Done (v, name) | Fail (v, name, _)), _ -> Printf.sprintf "%s ends on %s" name v
    | Act deeds, _ -> String.concat ", " (List.filter_map (function Code.Said m -> Some m | _ -> None) deeds)
    | Allocate _, _ -> Printf.sprintf "allocate in %d" part
    | _, (Repeat_until | Repeat_again) :: _ -> Printf.sprintf "asked in %d" part
    | label, rule :: _ -> Format.asprintf "%a by %s in %d, %B" Label.pp label (Rule.name rule) part inside
    | _, [] -> Alcotest.fail "a transition without a rule"
  in
  let is_event = match t.label with Done _ | Fail _ | Time_out -> true | _ -> false in
  { into; step; inside; closes; endless; part; is_event }

(* {1 Fairness} *)

type verdict = Ends | Goes_on | By_design

let executes (g : Reference.t) i = side_by_side g.states.(i).configuration <> []

(* The states reachable by one edge or more. *)
let reached edges from =
  let found = Hashtbl.create 16 in
  let rec go i =
    let arrive e =
      if not (Hashtbl.mem found e.into) then begin
        Hashtbl.add found e.into ();
        go e.into
      end
    in
    List.iter arrive edges.(i)
  in
  go from;
  found

let components edges =
  let reach = Array.init (Array.length edges) (reached edges) in
  let of_state i =
    let is_in j = Hashtbl.mem reach.(i) j && Hashtbl.mem reach.(j) i in
    List.filter is_in (List.init (Array.length edges) Fun.id)
  in
  List.sort_uniq compare (List.filter (fun c -> c <> []) (List.init (Array.length edges) of_state))

(* Whether some run within the component, from [i], comes to a state in which it need not take this step any more. *)
let is_settled all edges members i (owed : edge) =
  let seen = Hashtbl.create 16 in
  let is_over e = e.step = owed.step || (owed.inside && e.closes && e.part = owed.part) in
  let rec go i =
    let is_possible = List.exists (fun e -> e.step = owed.step) all.(i) in
    (not is_possible)
    || (not (Hashtbl.mem seen i))
       && begin
         Hashtbl.add seen i ();
         let goes_on e = List.mem e.into members && (is_over e || go e.into) in
         List.exists goes_on edges.(i)
       end
  in
  go i

let is_fair all edges members =
  List.for_all (fun i -> List.for_all (is_settled all edges members i) all.(i)) members

let all_edges (g : Reference.t) =
  Array.mapi (fun i edges -> if executes g i then List.map (edge g i) edges else []) g.edges

let judged (g : Reference.t) all =
  let kept p = Array.map (List.filter (fun e -> executes g e.into && p e)) all in
  let has_fair p =
    let edges = kept p in
    List.exists (is_fair all edges) (components edges)
  in
  if components (kept (fun e -> not e.is_event)) <> [] then Goes_on
  else if has_fair (fun e -> not e.endless) then Goes_on
  else if has_fair (fun _ -> true) then By_design
  else Ends

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
let other into = { into; step = ""; inside = false; closes = false; endless = false; part = -1; is_event = true }

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
    let all = try Some (all_edges g) with Ambiguous -> None in
    match Option.map (fun all -> (all, judged g all)) all with
    | None -> true
    | Some (all, judged) ->
      let expected = text judged in
      note expected;
      let agrees reduction =
        let o = Search.run { Search.default with environment; reduction; search_again = 0 } program world in
        let verdict = said (List.assoc Property.Termination o.verdicts) in
        let reductions = String.concat ", " (Reduction.names reduction) in
        verdict = expected || QCheck2.Test.fail_reportf "%s, %s expected (%s) of %s" verdict expected reductions source
      in
      List.for_all agrees [ Reduction.Whole; Partial_order; All ]
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
  List.iter enough [ "holds"; "violated"; "by design"; "formula holds"; "formula violated" ]

let () =
  Alcotest.run "fairness"
    [ ( "random programs",
        [ Alcotest.test_case "special programs" `Quick test_special;
          Alcotest.test_case "recruits are owed unless all may stay away" `Quick test_recruits;
          Alcotest.test_case "termination is that of the definition" `Quick test_fairness;
          Alcotest.test_case "every verdict is given" `Quick test_variety ] ) ]
