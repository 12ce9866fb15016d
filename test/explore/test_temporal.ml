(* On random programs and random formulas, the verdict is that of the formula on the plain state graph; a run that is
   shown is a run, and violates the formula by its definition. And some formulas state the built-in properties.
   PROGRAMS in the environment is how many programs are tried, each with three formulas, 150 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Generate = Test_support.Generate
module Linear = Test_support.Linear
module Product_search = Test_support.Product_search
module Property = Dolphin_explore.Property
module Formula = Dolphin_ltl.Formula

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default

let is_violated (o : Search.outcome) property =
  match List.assoc property o.verdicts with
  | Search.Violated _ -> true
  | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> false

(* The states that a run may be in, after its steps and after its cycle: each transition leads on from the end of the
   one before. *)
let after program world options steps from =
  let step states (t : Transition.t) =
    let leads ((t' : Transition.t), e) =
      if Label.equal t'.label t.label && Configuration.equal t'.next t.next then Some (t'.next, e) else None
    in
    let continued (c, e) = List.of_seq (Seq.filter_map leads (Environment.choices options program world e c)) in
    List.concat_map continued states
  in
  List.fold_left step from steps

let same (c, e) (c', e') = Configuration.equal c c' && Environment.compare e e' = 0

(* A run without a cycle must have come to a state in which nothing need happen. *)
let is_run program world options (run : Search.run) =
  let there = after program world options run.steps [ (Configuration.initial program, Environment.initial) ] in
  if run.cycle = [] then 
    let is_stuck (c, e) = Environment.is_stuck options program e (Environment.choices options program world e c) in
    List.exists is_stuck there
  else
    let comes_back state = List.exists (same state) (after program world options run.cycle [ state ]) in
    List.exists comes_back there

(* {1 Random formulas} *)

let propositions =
  [ "start"; "done"; "fail"; "start(p)"; "done(p)"; "start(q, a)"; "done(q)"; "bind"; "bind(b)"; "message"; "post";
    "post(x)"; "post(x: 1)"; "input"; "input(x: 1)"; "consume"; "consume(y)"; "timeout"; "execute"; "pick"; "end"; "halt"; "error"; "interrupt"; "ended";
    "running(p)"; "running(p, a)"; "running(q)"; "running(q, b)"; "bound(a)"; "bound(c)"; "poll(x: _)"; "poll(x: 1)";
    "poll(y: 2)"; "{running('p') && running('q')}"; "{running('p', 'a') || poll(z: _)}" ]

(* Repeated states are asked for again and again, and runs seldom are long. *)
let formula =
  let open QCheck2.Gen in
  let f = Linear.formula (oneofl propositions) in
  let often f : string Formula.t = Globally (Finally f) in
  let response f g : string Formula.t = Globally (Implies (f, Finally g)) in
  frequency
    [ (5, f); (1, map often f); (2, map2 response f f);
      (2, map2 (fun f g : string Formula.t -> Implies (often f, often g)) f f);
      (1, map2 (fun f g : string Formula.t -> And (response f g, often g)) f f) ]

let answering = { Environment.default with answers = (fun _ -> [ [ "1"; "2" ]; [ "0" ] ]) }

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", answering); ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with latecomers", { answering with faults = { Faults.none with join = Any_number }; may_be_late = (fun v -> v <> "a") });
    ( "with all of it, once",
      { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 } } );
    ("with all of it, twice", { answering with faults = twice });
    ("with inputs", { answering with inputs = Test_support.Posts.once });
    ("with certain inputs", { answering with inputs = Test_support.Posts.inputs });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } });
    ("with failures and interruptions", { answering with faults = { Faults.none with fail = Any_number; interrupt = true } }) ]

let case =
  let open QCheck2.Gen in
  let nested =
    let* depth = int_range 0 2 in
    map (fun task -> Generate.executing task) (Generate.nested ~vehicles:Generate.vehicles ~depth)
  in
  let program =
    frequency
      [ (4, map (fun p -> (p, Generate.world)) Generate.program); (2, map (fun p -> (p, Generate.world)) nested);
        (1, map (fun p -> (p, Generate.open_world)) Generate.sensing_program) ]
  in
  quad program bool (oneofl environments) (list_repeat 3 formula)

let shown f = Format.asprintf "%a" (Formula.pp Format.pp_print_string) f

let print ((program, _), looped, (name, _), formulas) =
  Printf.sprintf "%s, %s:\n%s\n%s" name (if looped then "for ever" else "once") (Generate.print program)
    (String.concat "\n" (List.map shown formulas))

let graph_of program (g : Reference.t) : _ Product_search.graph =
  let configuration i = g.states.(i).configuration in
  let successors i =
    let is_stuck = Environment.is_stuck g.options g.program g.states.(i).outside (List.to_seq g.edges.(i)) in
    let stays = if is_stuck then [ (i, (None, configuration i)) ] else [] in
    stays @ List.map (fun ((t : Transition.t), j) -> (j, (Some t, t.next))) g.edges.(i)
  in
  { start = (0, (None, Configuration.initial program)); successors }

let limit = 800
let judged = Hashtbl.create 7
let note what = Hashtbl.replace judged what (1 + Option.value (Hashtbl.find_opt judged what) ~default:0)

(* The fewest steps after which the automaton of [not f] accepts whatever follows, or a run may rest and violates [f],
   over all runs of the graph. *)
let soonest at (plain : _ Product_search.graph) f =
  let letters = Hashtbl.create 100 in
  let letter l = Hashtbl.add letters (Hashtbl.length letters) l; Hashtbl.length letters - 1 in
  let monitor =
    Dolphin_ltl.Monitor.create ~holds:(fun n p -> at (Hashtbl.find letters n) p)
      (Dolphin_ltl.Automaton.of_formula (Not f : _ Formula.t)) in
  let next set l = Dolphin_ltl.Monitor.next monitor ~give:ignore set l in
  let seen = Hashtbl.create 100 and queue = Queue.create () in
  let arrive depth (i, set) =
    if set >= 0 && not (Hashtbl.mem seen (i, set)) then begin
      Hashtbl.add seen (i, set) ();
      Queue.add (depth, i, set) queue
    end
  in
  let is_stay (_, (t, _)) = t = None in
  let rec go () =
    match Queue.take_opt queue with
    | None -> None
    | Some (depth, i, set) ->
      let stays, steps = List.partition is_stay (plain.successors i) in
      let rests (_, l) = Dolphin_ltl.Monitor.stays monitor set (letter l) in
      if Dolphin_ltl.Monitor.is_certain monitor set || List.exists rests stays then Some depth
      else begin
        List.iter (fun (j, l) -> arrive (depth + 1) (j, next set (letter l))) steps;
        go ()
      end
  in
  let i, l = plain.start in
  arrive 0 (i, next Dolphin_ltl.Monitor.start (letter l));
  go ()

(* A shortest run is shown where a moment decides, and then only. *)
let is_soonest at plain f (run : Search.run) =
  run.decided = soonest at plain f && run.shortest = (run.decided <> None)

(* For fair runs: a result for all runs holds for those, and a shown run is a violation. [Test_fairness] compares
   them with the definition. *)
let agrees_on_fair_runs program world environment at plain (f, verdict) =
  match (verdict : Search.verdict) with
  | Holds -> true
  | Violated run ->
    Product_search.satisfying ~holds:at plain (Not f) <> None
    && is_run program world environment run
    && not (Linear.holds at (Letters.word program run) f)
  | Unreached _ | Holds_if _ | By_design _ | Inconclusive _ -> false

let agrees_on program world environment at plain (f, verdict) =
  let expected = Product_search.satisfying ~holds:at plain (Not f) = None in
  match (verdict : Search.verdict) with
  | Holds -> note "hold"; expected
  | Violated run ->
    note (if run.cycle = [] then "are violated by a run that ends" else "are violated by a run without end");
    if run.decided <> None then note "are violated whatever follows";
    (not expected) && is_run program world environment run && is_soonest at plain f run
    && not (Linear.holds at (Letters.word program run) f)
  | Unreached _ | Holds_if _ | By_design _ | Inconclusive _ -> false

let agrees ((ast, world), looped, (_, environment), formulas) =
  let ast = if looped then Generate.for_ever ast else ast in
  let program = Test_support.Posts.declared environment (Generate.compile ast) in
  match Reference.explore ~limit environment program world with
  | None | (exception Environment.Unclear _) -> note "are skipped"; true
  | Some reference ->
    let plain = graph_of program reference and at = Letters.holds program world in
    let read f = match Temporal.of_string program (shown f) with Ok f -> f | Error why -> failwith why in
    let options = { Search.default with environment; formulas = List.map read formulas; fairness = No_fairness } in
    let options = { options with fork_from = 0; spare_bits = Some 0 } in
    let options =
      match Hashtbl.hash (Generate.print ast) mod 4 with
      | 0 -> { options with compress = true }
      | 1 -> { options with workers = 2 }
      | 2 -> { options with workers = 3 }
      | _ -> options
    in
    let o = Search.run options program world in
    let fair = Search.run { options with fairness = Weak } program world in
    let verdict (o : Search.outcome) f = List.assoc (Property.Formula (shown f)) o.verdicts in
    let judge f =
      (agrees_on program world environment at plain (f, verdict o f)
       && agrees_on_fair_runs program world environment at plain (f, verdict fair f))
      || QCheck2.Test.fail_reportf "%s" (shown f)
    in
    List.for_all judge formulas

let test_agreement () =
  let programs = number "PROGRAMS" 150 in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"verdicts agree with the plain graph" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_122 ~programs test;
  Hashtbl.iter (fun what n -> Printf.printf "%d %s\n" n what) judged

let test_variety () =
  let enough what = if not (Hashtbl.mem judged what) then Alcotest.failf "none %s" what in
  List.iter enough
    [ "hold"; "are violated by a run that ends"; "are violated by a run without end"; "are violated whatever follows" ]

(* {1 Properties} *)

let properties_case =
  let open QCheck2.Gen in
  triple Generate.program (frequencyl [ (2, false); (1, true) ]) bool

let print_properties_case (program, looped, failing) =
  Printf.sprintf "%s, %s:\n%s" (if failing then "failing" else "as planned") (if looped then "for ever" else "once")
    (Generate.print program)

(* Each formula holds exactly if none of the properties is violated, or is not meant to hold: formulas know no
   design. *)
let agreements : (string * Property.t list) list =
  [ ("F ended", [ No_deadlock; Termination ]);
    ("G (ended -> G ended)", []);
    ("G !error", [ No_error; Vehicles; Allocation; Assertions ]);
    ("G !halt", [ No_halt ]);
    ("(F ended) & G !(error | halt)", [ No_deadlock; Termination; No_error; Vehicles; Allocation; Assertions; No_halt ]);
    ("F G ended", [ No_deadlock; Termination ]);
    ("G (start -> !{running('p') && running('q')} | running(p))", []);
    ("!done W start", []); ("!done(p) W start(p)", []); ("!(start | done) W bind", []) ]

let is_broken o property =
  is_violated o property
  || match List.assoc_opt property o.Search.verdicts with
  | Some (By_design _) -> true
  | Some (Holds | Holds_if _ | Violated _ | Unreached _ | Inconclusive _) | None -> false

let agrees_with_properties (ast, looped, failing) =
  let program = Generate.compile (if looped then Generate.for_ever ast else ast) in
  let environment = if failing then Environment.failing Environment.default else Environment.default in
  let read text = match Temporal.of_string program text with Ok f -> f | Error why -> failwith why in
  let options = { Search.default with environment; limits = { Limits.none with max_states = Some 3_000 } } in
  let formulas = List.map (fun (text, _) -> read text) agreements in
  let o = Search.run { options with formulas } program Generate.world in
  let agree (text, properties) =
    match List.assoc (Property.Formula text) o.verdicts with
    | Inconclusive _ -> o.stopped <> None || o.states > 500
    | Holds -> not (List.exists (is_broken o) properties)
    | Violated run ->
      (List.exists (is_broken o) properties || o.stopped <> None)
      && is_run program Generate.world environment run
    | Unreached _ | Holds_if _ | By_design _ -> false
  in
  List.for_all (fun a -> agree a || QCheck2.Test.fail_reportf "%s" (fst a)) agreements

let () =
  let properties =
    Test_support.Property.case "formulas and properties agree" ~count:150 properties_case ~print:print_properties_case
      agrees_with_properties
  in
  Alcotest.run "temporal"
    [ ( "random programs",
        [ Alcotest.test_case "verdicts agree with the plain graph" `Quick test_agreement;
          Alcotest.test_case "there are verdicts of every kind" `Quick test_variety; properties ] ) ]
