(* Formulas, on random programs that pick vehicles of which some are alike: a search that exchanges these has the
   verdict of the plain one, after as many steps if a step decides it, and shows a run of the semantics that violates
   the formula by its definition. PROGRAMS in the environment is the number of programs, each with three formulas, 80
   by default. *)

open Dolphin_environment
open Dolphin_explore
module Pure_run = Test_support.Pure_run
module Linear = Test_support.Linear
module Formula = Dolphin_ltl.Formula

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 80
let limits = { Dolphin_checker.Limits.none with max_states = Some 1_500 }
let answering = { Environment.default with replies = Picking.replies; answers = (fun _ -> [ [ "1"; "null" ] ]) }

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with latecomers", { answering with faults = { Faults.none with join = Any_number }; may_be_late = (fun _ -> true) });
    ("with an input", { answering with inputs = Test_support.Posts.once });
    ("with all faults, twice", { answering with faults = Result.get_ok (Faults.of_string "all=2") });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } }) ]

(* A message may print the name of a vehicle. *)
let nameless =
  [ "start"; "done"; "fail"; "start(s)"; "done(t)"; "bind"; "message"; "post"; "post(x)"; "post(x: 1)"; "consume(x)";
    "input"; "pick"; "execute"; "end"; "halt"; "error"; "ended"; "interrupt"; "running(s)"; "running(t)"; "poll(x: _)";
    "poll(y: 2)"; "poll(x: 1)"; "{g > 1}"; "{p == q}"; "{p != r && running('s')}"; "{poll(x: r)}" ]

let naming =
  let of_vehicle v =
    [ "start(s, " ^ v ^ ")"; "done(t, " ^ v ^ ")"; "bind(" ^ v ^ ")"; "bound(" ^ v ^ ")"; "running(s, " ^ v ^ ")";
      "message('at " ^ v ^ "')"; "{\"${p}\" == '" ^ v ^ "'}"; "{bound('" ^ v ^ "') && g > 0}" ]
  in
  List.concat_map of_vehicle [ "a"; "b"; "c"; "d" ]

let proposition = QCheck2.Gen.(frequency [ (3, oneofl nameless); (1, oneofl naming) ])

(* Few random formulas with many operators show a difference. *)
let formula =
  let open QCheck2.Gen in
  let atom = map (fun p : string Formula.t -> Proposition p) proposition in
  let never f : string Formula.t = Globally (Not f) in
  let precedes f g : string Formula.t = Weak_until (Not f, g) in
  let response f g : string Formula.t = Globally (Implies (f, Finally g)) in
  frequency
    [ (2, Linear.formula proposition); (6, map never atom); (3, map2 precedes atom atom); (3, map2 response atom atom);
      (2, map (fun f : string Formula.t -> Finally f) atom);
      (2, map (fun f : string Formula.t -> Globally (Finally f)) atom) ]

(* Most of the programs end; what follows does not. *)
let endings =
  [ ""; ""; "while (true) { execute task('s')[p] }\n"; "execute repeat (task('s') | task('t')[q])\n";
    "while (true) { release p + q + r\np = pick { count 1 }\nexecute task('t')[p] }\n";
    "while (true) { release p + q + r\np = pick { count 2 } else { r }\nexecute task('s')[p] >> action { post x: 1 }\n\
     consume x: 1 }\n";
    "while (true) { execute task('s')[p]\npost y: 2 }\n" ]

let program =
  let open QCheck2.Gen in
  map2 (fun (p : Picking.t) ending -> { p with text = p.text ^ ending }) Picking.gen (oneofl endings)

let case =
  let open QCheck2.Gen in
  (* Shrinking takes minutes, and programs are short. *)
  no_shrink (quad program (oneofl environments) (list_repeat 3 formula) (oneofl [ Search.Weak; No_fairness ]))

let shown f = Format.asprintf "%a" (Formula.pp Format.pp_print_string) f

let print ((p : Picking.t), (name, _), formulas, fairness) =
  Printf.sprintf "%s, %s runs:\n%s\n%s" name (if fairness = Search.Weak then "fair" else "all") (Picking.print p)
    (String.concat "\n" (List.map shown formulas))

let tally = Hashtbl.create 8
let note what n = Hashtbl.replace tally what (n + Option.value (Hashtbl.find_opt tally what) ~default:0)

let agrees ((p : Picking.t), (_, environment), formulas, fairness) =
  match Pure_run.compile p.text with
  | Error _ -> note "no programs" 1; true
  | Ok program ->
    let program = Test_support.Posts.declared environment program in
    let world = snd p.world in
    let search f reduction =
      match Temporal.of_string program (shown f) with
      | Error why -> failwith why
      | Ok formula ->
        let options = { Search.default with environment; fairness; reduction; limits; formulas = [ formula ] } in
        let o = Search.run options program world in
        (List.assoc (Property.Formula (shown f)) o.verdicts, o.formula_states)
    in
    let is_violation f (run : Search.run) =
      Cases.is_run program world environment run
      && not (Linear.holds (Letters.holds program world) (Letters.word program run) f)
    in
    let judge f =
      let expected, plain = search f Whole in
      let agree =
        match (expected, search f Symmetry : Search.verdict * (Search.verdict * int)) with
        | Inconclusive _, _ -> note "skipped" 1; true
        | Holds, (Holds, states) ->
          note "hold" 1;
          if states < plain then note "hold in fewer states" 1;
          true
        | Violated run, (Violated run', states) ->
          let kind = if run.decided = None then "violated around a cycle" else "violated at a step" in
          note kind 1;
          if states < plain then note (kind ^ ", in fewer states") 1;
          run.decided = run'.decided && is_violation f run'
        | Holds_if _, (Holds_if _, _) -> true
        | _ -> false
      in
      agree || QCheck2.Test.fail_reportf "%s" (shown f)
    in
    List.for_all judge formulas

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"both searches have the same verdicts" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_128 ~programs test;
  Hashtbl.iter (fun what n -> Printf.printf "%d %s\n" n what) tally

let test_variety () =
  let enough what = if not (Hashtbl.mem tally what) then Alcotest.failf "none %s" what in
  List.iter enough
    [ "hold in fewer states"; "violated at a step, in fewer states"; "violated around a cycle, in fewer states" ]

(* It posts without end, so no run comes back to where it was. *)
let test_growth () =
  let program = Pure_run.compile_exn "v = pick { count 2 }\nwhile (true) { execute task('s')[v]\npost y: 2 }\n" in
  let formula = Result.get_ok (Temporal.of_string program "G !start") in
  let world = List.assoc "alike" Picking.worlds in
  let verdict reduction =
    let limits = { limits with max_states = Some 100 } in
    let options = { Search.default with environment = answering; reduction; limits; formulas = [ formula ] } in
    List.assoc (Property.Formula "G !start") (Search.run options program world).verdicts
  in
  let check reduction =
    match verdict reduction with
    | Violated { decided = Some n; cycle = []; steps; _ } -> Alcotest.(check int) "steps" n (List.length steps)
    | _ -> Alcotest.fail "no step decides it"
  in
  List.iter check [ Reduction.Whole; All ]

let () =
  Alcotest.run "symmetry of formulas"
    [ ("without end", [ Alcotest.test_case "a violation early in a run that grows" `Quick test_growth ]);
      ( "random programs",
        [ Alcotest.test_case "both searches have the same verdicts" `Quick test_agreement;
          Alcotest.test_case "some are decided in fewer states" `Quick test_variety ] ) ]
