(* Assumptions on readings: verdicts on termination and their assumptions are those of the definition. On the graph of
   [Reference], by the texts of comparisons alone: a run meets an assumption at a choice if it takes no step there that
   contradicts the assumption, or some that does not. So for each assumption and choice either the steps of the one
   kind are left out, or one of the other kind has to be in the component: all combinations are tried. Comparisons of
   one choice, and of no other, have the same first digit. PROGRAMS in the environment is how many are tried, 250 by
   default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
open Fair_by_definition
module Generate = Test_support.Generate
module Pure_run = Test_support.Pure_run

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 250
let vehicles = [ "a"; "b" ]
let world = List.fold_left (fun w v -> World.open_battery v [] w) Generate.world vehicles

(* {1 Programs} *)

let pick_one = QCheck2.Gen.oneofl

(* A comparison of the choice [id]; [variant] makes two of them differ. *)
let comparison id variant =
  let open QCheck2.Gen in
  let* symbol = pick_one [ "<"; ">="; ">"; "<=" ] in
  let* v = pick_one [ "v1"; "v2" ] in
  return (Printf.sprintf "battery(%s) %s 0.%d%d" v symbol id variant)

let guard id =
  let open QCheck2.Gen in
  frequency
    [ (5, comparison id 1);
      (1, map (fun c -> c ^ " && poll(k: 1)") (comparison id 1));
      (1, map2 (Printf.sprintf "%s || %s") (comparison id 1) (comparison id 2)) ]

(* Every leaf takes time, or follows one that does. *)
let leaf part place id =
  let open QCheck2.Gen in
  let plan = Printf.sprintf "task('p%d%d')[v%d]" part place part in
  let toggle = "if (poll(k: 1)) { consume k: 1 } else { post k: 1 }" in
  let* g = guard id and* g' = guard id in
  frequency
    [ (3, return plan);
      (1, return (Printf.sprintf "idle(%d)" (1 + (10 * part) + place)));
      (3, return (Printf.sprintf "(%s >> action { if (%s) { %s }; message 'm%d%d' })" plan g toggle part place));
      (3, return
         (Printf.sprintf "oneOf { when { %s } then %s\nwhen { %s } then action { %s; message 'm%d%d' } }" g plan g'
            toggle part place)) ]

let repeated number ids =
  let open QCheck2.Gen in
  let id n = List.nth ids ((3 * (number - 1)) + n) in
  let* first = leaf number 1 (id 0) and* g = guard (id 2) in
  let* second = leaf number 2 (id 1) in
  let* body =
    frequency
      [ (2, return (Printf.sprintf "(task('q%d')[v%d] >> %s)" number number first));
        (2, return (Printf.sprintf "(task('q%d')[v%d] >> %s >> %s)" number number first second)) ] in
  frequency
    [ (6, return (Printf.sprintf "(repeat %s until { %s })" body g));
      (2, return (Printf.sprintf "(until { poll k: 1 } run (repeat %s))" body));
      (1, return (Printf.sprintf "(repeat %s)" body));
      (1, return body) ]

let head = "v1 = pick { id 'a' }\nv2 = pick { id 'b' }\n"

let of_task =
  let open QCheck2.Gen in
  let* ids = shuffle_l [ 1; 2; 3; 4; 5; 6; 7; 8; 9 ] in
  let* n = int_range 1 2 in
  let* parts = flatten_l (List.init n (fun i -> repeated (i + 1) ids)) in
  return (head ^ "execute " ^ String.concat " |\n        " parts)

(* In the script, a choice is a comparison. *)
let of_script =
  let open QCheck2.Gen in
  let* ids = shuffle_l [ 1; 2; 3; 4; 5; 6; 7; 8; 9 ] in
  let id n = List.nth ids n in
  let* first = comparison (id 0) 1 and* second = comparison (id 1) 1 and* third = comparison (id 2) 1 in
  let* joined = pick_one [ "&&"; "||" ] in
  let* condition = pick_one [ first; Printf.sprintf "%s %s %s" first joined second ] in
  let* body =
    pick_one
      [ ""; Printf.sprintf "  if (%s) { break }\n" third; Printf.sprintf "  if (%s) { pause 5 }\n" third;
        Printf.sprintf "  execute action { if (%s) { message 'm' } }\n" third ] in
  return (Printf.sprintf "%swhile (%s) {\n  execute task('p')[v1]\n%s}" head condition body)

let assumption =
  let open QCheck2.Gen in
  let* v = pick_one vehicles and* hundredths = int_range 10 99 in
  let* symbol = pick_one [ "<"; ">" ] and* holds = bool in
  return [ World.Claim (Printf.sprintf "battery(%s) %s %.2f" v symbol (float_of_int hundredths /. 100.), holds) ]

let environments =
  [ ("as planned", Environment.default); ("with a failure", Environment.failing ~failures:1 Environment.default) ]

(* {1 The definition} *)

(* A claim about the charge of [v], and its choice. *)
type claim = { v : string; satisfies : float -> bool; digit : int }

let claim = function
  | World.Claim (text, holds) ->
    let of_text v symbol limit =
      let satisfies x = (if symbol = '<' then x < limit else x > limit) = holds in
      { v; satisfies; digit = int_of_float ((limit *. 10.) +. 0.0001) }
    in
    Scanf.sscanf text "battery(%[a-z]) %c %f" of_text
  | World.Sensed _ | Placed _ | Late _ | Missing _ -> Alcotest.fail "a comparison is expected"

(* All limits are hundredths. *)
let charges = List.init 201 (fun n -> float_of_int n /. 200.)
let shows v x c = c.v <> v || c.satisfies x

let may_show readings looks =
  let wanted = List.map claim readings in
  let possible assumed =
    let all = List.map claim assumed in
    let at x = List.exists (fun c -> shows c.v x c && List.for_all (shows c.v x) all) wanted in
    List.exists at charges
  in
  List.exists possible looks

let is_about readings looks =
  let of_vehicle a = List.exists (fun c -> (claim c).v = (claim a).v) readings in
  List.for_all (fun assumed -> assumed <> []) looks && List.exists (List.exists of_vehicle) looks

let choices looks = List.sort_uniq compare (List.map (fun a -> (claim a).digit) (List.concat looks))

let pairs_of meets assumed looks =
  let of_assumption i readings =
    if is_about readings looks && may_show readings looks = meets then List.map (fun c -> (i, c)) (choices looks)
    else []
  in
  List.concat (List.mapi of_assumption assumed)

exception Too_many

(* [possible] is the looks of all steps, by state. *)
let divided assumed possible edges =
  let met = Array.map (List.concat_map (pairs_of true assumed)) possible in
  let against i e = List.filter (fun pair -> List.mem pair met.(i)) (pairs_of false assumed e.looks) in
  let all = List.concat (Array.to_list (Array.mapi (fun i es -> List.concat_map (against i) es) edges)) in
  let pairs = List.sort_uniq compare all in
  if List.length pairs > 5 then raise Too_many;
  let rec subsets = function
    | [] -> [ [] ]
    | p :: rest -> List.concat_map (fun s -> [ s; p :: s ]) (subsets rest)
  in
  let combination avoided =
    let is_kept i e = not (List.exists (fun pair -> List.mem pair avoided) (against i e)) in
    let left = Array.mapi (fun i es -> List.filter (is_kept i) es) edges in
    let is_met members =
      let inside = List.concat_map (fun i -> List.filter (fun e -> List.mem e.into members) left.(i)) members in
      let is_taken pair = List.exists (fun e -> List.mem pair (pairs_of true assumed e.looks)) inside in
      List.for_all (fun pair -> List.mem pair avoided || is_taken pair) pairs
    in
    (left, is_met)
  in
  List.map combination (subsets pairs)

let scripted (g : Reference.t) =
  let edge ((t : Transition.t), into) =
    { into; step = ""; inside = false; closes = false; endless = false; part = 0; is_event = true;
      looks = t.assumed :: t.otherwise; owed_strongly = None } in
  Array.map (List.map edge) g.edges

let is_scripted (g : Reference.t) = not (Reference.goes_round g)

let by_definition (g : Reference.t) all assumed =
  let possible = Array.map (List.map (fun ((t : Transition.t), _) -> t.assumed :: t.otherwise)) g.edges in
  if is_scripted g then
    let has (edges, is_met) = List.exists is_met (components edges) in
    if List.exists has (divided assumed possible (scripted g)) then Goes_on else Ends
  else judged ~divided:(divided assumed possible) g all

(* {1 Comparison} *)

let found = Hashtbl.create 7
let note what = Hashtbl.replace found what (1 + Option.value ~default:0 (Hashtbl.find_opt found what))

let expected g all assumed =
  match by_definition g all [], by_definition g all assumed with
  | Ends, _ -> "holds"
  | Goes_on, Ends | By_design, Ends -> "holds if"
  | By_design, _ -> "by design"
  | Goes_on, By_design -> "by design if"
  | Goes_on, Goes_on -> "violated"

let said (verdict : Search.verdict) =
  match verdict with
  | Holds -> "holds"
  | Holds_if _ -> "holds if"
  | Violated _ -> "violated"
  | By_design { needs = []; _ } -> "by design"
  | By_design _ -> "by design if"
  | Unreached _ | Inconclusive _ -> "inconclusive"

let rec is_part part = function
  | [] -> part = []
  | x :: rest -> (match part with y :: more when x = y -> is_part more rest | _ -> is_part part rest)

(* The assumptions that are reported suffice, and none of them can be left out. *)
let are_right g all assumed (verdict : Search.verdict) =
  let outcome readings = by_definition g all readings in
  let needed needs =
    let same = outcome needs = outcome assumed in
    let without a = outcome (List.filter (fun b -> b <> a) needs) in
    is_part needs assumed && same && List.for_all (fun a -> without a <> outcome needs) needs
  in
  match verdict with
  | Holds_if needs | By_design { needs = _ :: _ as needs; _ } -> needed needs
  | Violated { helpful = Some { recurring = _ :: _ as helpful; strong = false }; _ } ->
    note "helpful";
    (try outcome (assumed @ helpful) = Ends with Too_many -> true)
  | Holds | By_design _ | Violated _ | Unreached _ | Inconclusive _ -> true

(* [F ended] holds if every fair run ends, and none is stuck. *)
let formula_agrees g program environment expected =
  let ended = Result.get_ok (Temporal.of_string program "F ended") in
  let o = Search.run { Search.default with environment; formulas = [ ended ] } program world in
  let expected =
    if List.mem_assoc Property.No_deadlock (Reference.broken g) then "violated"
    else if expected = "holds" || expected = "holds if" then expected
    else "violated"
  in
  let verdict = said (List.assoc (Property.Formula "F ended") o.verdicts) in
  verdict = expected || QCheck2.Test.fail_reportf "F ended: %s, %s expected" verdict expected

let agrees ((source, (_, environment)), assumed) =
  let program = Pure_run.compile_exn source in
  match Reference.explore ~limit:120 environment program world with
  | None | (exception Environment.Unclear _) -> note "skipped"; true
  | Some g -> (
      match
        let all = if is_scripted g then [||] else all_edges world g in
        (all, expected g all assumed)
      with
      | exception (Ambiguous | Too_many) -> note "skipped"; true
      | all, expected ->
        note expected;
        let environment = { environment with recurring = assumed } in
        let agrees reduction =
          let o = Search.run { Search.default with environment; reduction } program world in
          let verdict = List.assoc Property.Termination o.verdicts in
          let names = String.concat ", " (Reduction.names reduction) in
          (said verdict = expected
           || QCheck2.Test.fail_reportf "%s, %s expected (%s)" (said verdict) expected names)
          && (are_right g all assumed verdict || QCheck2.Test.fail_reportf "other assumptions are needed (%s)" names)
        in
        List.for_all agrees [ Reduction.Whole; Partial_order; All ] && formula_agrees g program environment expected)

let print ((source, (name, _)), assumed) =
  let readings = String.concat "; " (List.map (Format.asprintf "%a" Looks.pp_readings) assumed) in
  Printf.sprintf "%s, assuming %s:\n%s" name readings source

let test_random () =
  let open QCheck2.Gen in
  let source = frequency [ (3, of_task); (1, of_script) ] in
  let generator = pair (pair source (oneofl environments)) (list_size (int_range 0 2) assumption) in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"verdicts under assumptions" generator agrees in
  Test_support.Property.on_each_seed ~usual:20_261_128 ~programs test;
  Hashtbl.iter (Printf.printf "%s: %d\n") found

let test_variety () =
  let enough what =
    if Option.value ~default:0 (Hashtbl.find_opt found what) * 100 < programs then
      Alcotest.failf "too few programs for: %s" what
  in
  List.iter enough [ "holds"; "holds if"; "violated"; "by design"; "helpful" ]

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "recurrence"
    [ ("random programs",
       [ case "verdicts are those of the definition" test_random; case "there are programs of each kind" test_variety ])
    ]
