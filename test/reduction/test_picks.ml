(* On random programs that pick vehicles of which some are alike, every verdict of a search that exchanges those is
   that of the plain one, every run that it shows is one of the semantics, and it comes to the same configurations of
   the script, up to the names of vehicles. PROGRAMS in the environment is the number of programs, 2,000 by default;
   SEED is their start. *)

open Dolphin_environment
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let programs = number "PROGRAMS" 2_000
let usual = 20_261_122
let limit = number "LIMIT" 300
let supplied = { Environment.default with replies = Picking.replies }
let answering = { supplied with answers = (fun _ -> [ [ "1"; "null" ] ]) }
let reading = { supplied with answers = (fun _ -> [ [ "p"; "q[0].id == 'b'" ] ]) }

let failing fails : Environment.options =
  { answering with endings = (fun v p -> if fails v p then May_fail else Succeeds); plans = [ "t"; "sb" ] }

let late join may_be_late : Environment.options =
  { answering with may_be_late; faults = { Faults.none with join } }

let every : Faults.t = { Faults.none with fail = Any_number; join = Any_number }

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", answering);
    ("with answers that read variables", reading);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with a loss", { answering with faults = { Faults.none with loss = At_most 1 } });
    ("with a latecomer", { answering with faults = { Faults.none with join = At_most 1 } });
    ("with an input", { answering with inputs = Test_support.Posts.once });
    ("with latecomers", late Faults.Any_number (fun _ -> true));
    ("with latecomers, of which some are always there", late Faults.Any_number (fun v -> v = "a" || v = "c"));
    ("with two of those late", late (Faults.At_most 2) (fun v -> v = "a" || v = "c"));
    ("with all faults", { answering with faults = { every with loss = Any_number } });
    ("with all faults, and losses counted", { answering with faults = { every with loss = At_most 2 } });
    ("with all faults, twice", { answering with faults = twice });
    ("with two faults of any kind", { answering with faults = { every with loss = Any_number }; most_faults = Some 2 });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } });
    ("vehicle b may fail", failing (fun v _ -> v = "b"));
    ("plan t may fail", failing (fun _ p -> p = "t"));
    ("plan sb may fail", failing (fun _ p -> p = "sb"));
    ("plan sb may fail on vehicle b", failing (fun v p -> v = "b" && p = "sb"));
    ("plan t may fail on vehicle b", failing (fun v p -> v = "b" && p = "t")) ]

let case = QCheck2.Gen.(pair Picking.gen (oneofl environments))
let print (program, (name, _)) = Printf.sprintf "%s, %s" name (Picking.print program)
let invalid = ref 0
let exchanged = ref 0
let tally = Tally.create ()

let agrees ((p : Picking.t), (_, environment)) =
  match Pure_run.compile p.text with
  | Error _ ->
    Test_support.Property.count invalid;
    true
  | Ok program -> (
      let program = Test_support.Posts.declared environment program in
      let world = snd p.world in
      let invariants = Option.to_list (Result.to_option (Condition.of_string program p.invariant)) in
      let found = Agreement.check_peers ~limit ~invariants environment program world in
      (match found with Ok (Some (_, true)) -> Test_support.Property.count exchanged | Ok _ | Error _ -> ());
      Tally.agrees tally (Result.map (Option.map fst) found))

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"search with peers and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf
    "%d no programs, %d skipped, of more than %d states; %d of %d states by exchanging peers alone, fewer for %d \
     programs; peers exchanged in %d\n"
    !invalid tally.skipped limit tally.reduced tally.whole tally.smaller !exchanged;
  Tally.print_broken tally

(* {1 As few faults as can be} *)

let counted = ref 0

(* Of the numbers that are known to be the least, and the lengths that are known to be. *)
let same_fewest ((p : Picking.t), (_, environment)) =
  let fewest program reduction =
    let limits = { Dolphin_checker.Limits.none with max_states = Some limit } in
    let options = { Search.default with environment; reduction; limits; search_again = limit } in
    (Fewest_faults.run options program (snd p.world)).verdicts
  in
  let agree (property, (plain : Search.verdict)) (_, (reduced : Search.verdict)) =
    match plain, reduced with
    | Violated { faults = Some { number; fewest = true }; steps; shortest; _ },
      Violated { faults = Some { number = number'; fewest = true }; steps = steps'; shortest = shortest'; _ } ->
      if number > 0 then Test_support.Property.count counted;
      if number <> number' then
        QCheck2.Test.fail_reportf "%a: %d faults, reduced %d" Property.pp property number number'
      else if shortest && shortest' && List.compare_lengths steps steps' <> 0 then
        QCheck2.Test.fail_reportf "%a: %d steps, reduced %d" Property.pp property (List.length steps)
          (List.length steps')
    | (Holds | Holds_if _ | By_design _ | Violated _ | Unreached _ | Inconclusive _), _ -> ()
  in
  match Pure_run.compile p.text with
  | Error _ -> true
  | Ok program ->
    let program = Test_support.Posts.declared environment program in
    List.iter2 agree (fewest program Whole) (fewest program All);
    true

let test_fewest () =
  let programs = max 1 (programs / 4) in
  let name = "as few faults with peers as without" in
  let test = QCheck2.Test.make ~count:programs ~print ~name case same_fewest in
  Test_support.Property.on_each_seed ~usual ~programs test;
  if 20 * !counted < programs then Alcotest.failf "only %d with faults" !counted

(* If nothing is violated, or nothing reduced, agreement means little. *)
let test_variety () =
  Tally.check_broken tally;
  let tried = programs - tally.skipped - !invalid in
  if 4 * tally.smaller < tried then Alcotest.fail "few programs have less states"

(* Of an end it does not matter which vehicles N names: x has two that are alike, in an order that names decide. *)
let test_end () =
  let text =
    "p = pick { count 1 }\nq = pick { count 1 }\nr = p\nq = pick { count 2; type 'UUV' }\nr = pick { type 'UUV' }\n\
     q = (r + q)\npost x: q\nexecute task('s')[q]\n"
  in
  let world = List.find (fun (name, _) -> name = "in turns") Picking.worlds in
  let losses = List.find (fun (name, _) -> name = "with losses") environments in
  Alcotest.(check bool) "agrees" true (agrees ({ text; world; invariant = "true" }, losses))

(* Found by random programs: a set that is written in two ways, `q - q` and `r`, of vehicles that are alike. *)
let test_areas () =
  let text =
    "def fly(t) { execute task('s')[t] }\ng = 0\np = pick { count 1 }\nq = pick { count 1 }\nr = p\nrelease p\n\
     p = pick { count 2; region location(41.18521, -8.7048), 1.km }\nrelease (q - q)\nr = p\nr = q[0]\n"
  in
  let world = List.find (fun (name, _) -> name = "open alike") Picking.worlds in
  Alcotest.(check bool) "agrees" true (agrees ({ text; world; invariant = "g < 2" }, List.hd environments))

let () =
  Alcotest.run "picks"
    [
      ("ends", [ Alcotest.test_case "vehicles that are named in N and lost" `Quick test_end ]);
      ("places", [ Alcotest.test_case "vehicles in a region" `Quick test_areas ]);
      ( "random programs",
        [
          Alcotest.test_case "search with peers and plain search agree" `Quick test_agreement;
          Alcotest.test_case "as few faults with peers as without" `Quick test_fewest;
          Alcotest.test_case "properties are broken by some, and states are saved" `Quick test_variety;
        ] );
    ]
