(* On random programs that execute copies of one task side by side, every verdict of a search with symmetry, with and
   without partial order, is that of the plain one, and every run that it shows is one of the semantics. PROGRAMS in
   the environment is the number of programs, 2,000 by default; SEED is the first seed. *)

open Dolphin_environment
module Generate = Test_support.Generate
module Calls = Test_support.Calls

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let programs = number "PROGRAMS" 2_000
let usual = 20_261_122
let limit = number "LIMIT" 400
let answering = Calls.answering
let failing fails : Environment.options =
  { answering with endings = (fun v p -> if fails v p then May_fail else Succeeds) }

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with two failures", Environment.failing ~failures:2 answering);
    ("with all faults, twice", { answering with faults = twice });
    ("vehicle a may fail", failing (fun v _ -> v = "a"));
    ("plan p3 may fail", failing (fun _ p -> p = "p3"));
    ("with an input", { answering with inputs = Test_support.Posts.once });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } });
    ("with failures and interruptions", { answering with faults = { Faults.none with fail = Any_number; interrupt = true } }) ]

let case =
  let open QCheck2.Gen in
  pair (frequency [ (4, Generate.replicated); (1, Calls.within Generate.replicated) ]) (oneofl environments)

let print (program, (name, _)) = Printf.sprintf "%s:\n%s" name (Generate.print program)
let tally = Tally.create ()

let agrees (ast, (_, environment)) =
  let program = Test_support.Posts.declared environment (Generate.compile ast) in
  Tally.agrees tally (Agreement.check ~limit ~reductions:[ All; Symmetry ] environment program Generate.world)

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"symmetric and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf "%d skipped, of more than %d states; %d of %d states by symmetry alone, fewer for %d programs\n"
    tally.skipped limit tally.reduced tally.whole tally.smaller;
  Tally.print_broken tally

(* Where nothing is broken, or nothing reduced, agreement proves little. *)
let test_variety () =
  Tally.check_broken ~but:[ Termination; Vehicles; Allocation ] tally;
  let tried = programs - tally.skipped in
  if 5 * tally.smaller < 2 * tried then Alcotest.fail "few programs have less states"

let () =
  Alcotest.run "symmetry"
    [
      ( "random programs",
        [
          Alcotest.test_case "symmetric and plain search agree" `Quick test_agreement;
          Alcotest.test_case "properties are broken by some, and states are saved" `Quick test_variety;
        ] );
    ]
