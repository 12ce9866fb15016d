(* On random programs, every verdict of a reduced search is that of the plain one, with failures and without, and
   every run that it shows is one of the semantics. PROGRAMS in the environment is the number of programs, 1,200 by
   default; SEED is their start. *)

open Dolphin_environment
module Generate = Test_support.Generate
module Posts = Test_support.Posts
module Calls = Test_support.Calls

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let programs = number "PROGRAMS" 1_200
let usual = 20_260_911
let limit = number "LIMIT" 3_000

(* Tasks side by side, which the programs of [Generate] have too few of for our purpose. *)
let side_by_side ~sensing =
  let open QCheck2.Gen in
  let part vehicles depth = (if sensing then Generate.sensing_task else Generate.task) ~vehicles ~depth in
  let* first = int_range 1 3 and* second = int_range 0 2 and* third = int_range 0 2 in
  let* a = part [ "va" ] first in
  let* b = part [ "vb" ] second in
  let* c = part [ "vc" ] third in
  let* shape = int_bound 3 in
  let ( || ) = Generate.binary Parallel in
  let watched task =
    map
      (fun h -> Generate.expression (Watch (task, Generate.code h)))
      (oneofl
         [ [];
           [ Generate.statement (Generate.call "halt" [ Positional (Generate.expression (String "h")) ]) ];
           [ Generate.statement (Generate.post "x" 1) ];
           [ Generate.statement (Generate.call "ignore" []) ] ])
  in
  let* task =
    match shape with
    | 0 -> return (a || b)
    | 1 -> return (a || b || c)
    | 2 -> watched (a || b || c)
    | _ -> map (fun ab -> ab || c) (watched (a || b))
  in
  let* posts = oneofl [ []; [ ("x", 1) ]; [ ("y", 2); ("x", 2) ] ] in
  let before = Generate.kept :: List.map (fun (k, x) -> Generate.statement (Generate.post k x)) posts in
  return (Generate.executing ~before task)

(* Tasks side by side inside of [until], [during], [watch] ..., and so again. *)
let nested ~sensing =
  let open QCheck2.Gen in
  let* depth = int_range 0 2 in
  let* posts = oneofl [ []; [ ("x", 1) ]; [ ("y", 2); ("x", 2) ] ] in
  let before = Generate.kept :: List.map (fun (k, x) -> Generate.statement (Generate.post k x)) posts in
  let nested = if sensing then Generate.sensing_nested else Generate.nested in
  map (Generate.executing ~before) (nested ~vehicles:Generate.vehicles ~depth)

let answering = Calls.answering

let failing_vehicle v : Environment.options =
  { answering with endings = (fun v' _ -> if v = v' then Environment.Fails else Succeeds) }

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with two failures", Environment.failing ~failures:2 answering);
    ("vehicle a fails", failing_vehicle "a");
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with a failure and a loss", { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1 } });
    ("with all faults, twice", { answering with faults = twice });
    ("with latecomers", { answering with faults = { Faults.none with join = Any_number }; may_be_late = (fun v -> v = "b") });
    ("with inputs", { answering with inputs = Posts.inputs });
    ("with an input", { answering with inputs = Posts.once });
    ("with a failure and an input", { (Environment.failing ~failures:1 answering) with inputs = Posts.once });
    ("with losses and an input", { answering with faults = { Faults.none with loss = Any_number }; inputs = Posts.once });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } });
    ("with a failure and interruptions", { answering with faults = { Faults.none with fail = At_most 1; interrupt = true } }) ]

let case =
  let open QCheck2.Gen in
  let closed program = pair program (return Generate.world) in
  let opened program = pair program (return Generate.open_world) in
  pair
    (frequency
       [ (2, closed Generate.program); (2, closed (map Generate.for_ever Generate.program));
         (2, closed (Calls.within Generate.program)); (2, closed (Calls.within (side_by_side ~sensing:false)));
         (3, closed (side_by_side ~sensing:false)); (5, closed (nested ~sensing:false));
         (1, opened Generate.sensing_program); (2, opened (side_by_side ~sensing:true));
         (2, opened (nested ~sensing:true)) ])
    (oneofl environments)

let print ((program, world), (name, _)) =
  let sensors = if Dolphin_semantics.World.is_open world then "open" else "closed" in
  Printf.sprintf "%s, %s world:\n%s" name sensors (Generate.print program)
let tally = Tally.create ()

let agrees ((ast, world), (_, environment)) =
  let program = Posts.declared environment (Generate.compile ast) in
  Tally.agrees tally (Agreement.check ~limit ~reductions:[ Partial_order; All ] environment program world)

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"reduced and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf "%d skipped, of more than %d states; %d states, %d after reduction\n" tally.skipped limit tally.whole
    tally.reduced;
  Tally.print_broken tally

(* If nothing is violated, or nothing reduced, agreement means little. *)
let test_variety () =
  Tally.check_broken tally;
  if not (5 * tally.reduced < 4 * tally.whole) then Alcotest.fail "little is reduced"

let () =
  Alcotest.run "reduction"
    [
      ( "random programs",
        [
          Alcotest.test_case "reduced and plain search agree" `Quick test_agreement;
          Alcotest.test_case "every property is broken by some, and states are saved" `Quick test_variety;
        ] );
    ]
