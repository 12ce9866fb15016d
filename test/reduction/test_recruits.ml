(* On random programs whose tasks recruit, and hold vehicles, side by side, every verdict of a search with partial
   order is that of the plain one, and tasks come to the same in both. PROGRAMS in the environment is the number of
   programs, 1,000 by default; SEED is the first seed. *)

open Dolphin_environment
open QCheck2.Gen
module Pure_run = Test_support.Pure_run

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let programs = number "PROGRAMS" 1_000
let usual = 20_261_125
let limit = number "LIMIT" 600
let f = Printf.sprintf

(* {1 Worlds} *)

let uuv = Pure_run.vehicle
let uav = Pure_run.vehicle ~kind:"UAV"

let worlds =
  [ ("two", Pure_run.world [ uuv "a"; uuv "b" ]); ("three", Pure_run.world [ uuv "a"; uuv "b"; uuv "c" ]);
    ("two kinds", Pure_run.world [ uuv "a"; uuv "b"; uav "c" ]) ]

let answering = Environment.default
let faulty faults = { answering with faults = Result.get_ok (Faults.of_string faults) }

let environments =
  [ ("as planned", answering); ("with failures", faulty "fail"); ("with a failure", faulty "fail=1");
    ("with losses", faulty "loss"); ("with a loss", faulty "loss=1"); ("with latecomers", faulty "join");
    ("with a latecomer", faulty "join=1"); ("with all faults", faulty "all"); ("with all faults, once", faulty "all=1");
    ("with late b", { (faulty "fail,join") with may_be_late = (fun v -> v = "b") });
    ("with interruptions", faulty "interrupt"); ("with an input", { answering with inputs = Test_support.Posts.once });
    ("with plan s failing on b", { answering with endings = (fun v p -> if v = "b" && p = "s" then Fails else Succeeds) }) ]

(* {1 Programs} *)

let plan = oneofl [ "s"; "t" ]
let asked = frequencyl [ (4, ""); (3, "type 'UUV'"); (1, "type 'UAV'"); (1, "id 'a'"); (2, "id 'b'") ]

let guard =
  frequencyl
    [ (4, "consume x: 1"); (2, "consume y: 1"); (2, "poll x: 1"); (2, "!poll(x: 1)"); (1, "g > 0"); (1, "true");
      (1, "poll(x: 1) && consume(y: 1)"); (1, "idle(p) == p") ]

let code =
  frequencyl
    [ (5, "post x: 1"); (3, "post y: 1"); (1, "consume x: 1"); (2, "g = g + 1"); (1, "if (poll(x: 1)) { halt 'h' }");
      (1, "message 'm'"); (1, "if (g > 0) { post y: 1 }"); (1, "1 / g") ]

(* Of no vehicle in particular. *)
let free = oneof [ map (f "action { %s }") code; map (f "condition { %s }") guard; return "idle(1.seconds)" ]

let branches part =
  let branch = map2 (f "when { %s } then %s") (frequency [ (2, guard); (2, return "true") ]) part in
  map2 (f "allOf { %s\n%s }") branch branch

let handler = frequencyl [ (4, "ignore()"); (2, "post x: 1 ; ignore()"); (2, "retry()"); (1, "halt 'w'"); (1, "") ]

(* The work of the vehicle [u], if it is not an arbitrary recruit; it runs side by side with that of others. *)
let rec work depth u =
  let own = if u = "" then map (f "task('%s')") plan else map (fun p -> f "task('%s')[%s]" p u) plan in
  if depth = 0 then frequency [ (3, own); (1, free) ]
  else
    let part = work (depth - 1) u in
    frequency
      [ (4, own); (4, map2 (f "(%s >> %s)") part part); (2, map2 (f "(%s | %s)") own free); (1, free);
        (1, map2 (f "(waitFor { %s } then %s)") guard part); (1, map2 (f "(until { %s } run (%s))") guard part);
        (1, map (f "(during 1 run (%s))") part); (2, map2 (f "(watch (%s) onError { %s })") part handler);
        (1, map2 (f "(waitFor { %s } then { %s })") guard part); (2, branches part) ]

let recruit =
  let* q = asked and* q' = asked and* t = work 2 "" and* t' = work 1 "" in
  frequencyl
    [ (8, f "recruit { %s } then { u -> %s }" q t);
      (1, f "recruit { %s } then { u -> %s >> recruit { %s } then { w -> %s } }" q t' q' t');
      (1, f "recruit { %s } then { u -> %s | recruit { %s } then { w -> %s } }" q t' q' t') ]

let recruiting =
  let* r = recruit and* c = guard and* h = handler in
  frequencyl
    [ (6, f "(%s)" r); (2, f "(repeat 2, %s)" r); (1, f "(repeat (%s >> idle(1.seconds)) until { %s })" r c);
      (1, f "(repeat (%s) >> idle(1.seconds))" r); (1, f "((%s) within 5.seconds)" r);
      (1, f "(watch (%s) onError { %s })" r h); (1, f "(until { %s } run %s)" c r);
      (1, f "(waitFor { %s } then { %s })" c r) ]

(* Parts of vehicles that were picked, which are known, given at their turn, held, or dismissed. *)
let other =
  let* t = work 2 "p" and* u = work 1 "" and* c = guard in
  frequencyl
    [ (4, f "(%s)" t); (2, f "({ %s })[p]" u); (2, f "({ %s })" u); (1, f "(waitFor { %s } then { %s })" c u);
      (1, f "(watch (%s) onError { dismiss p ; ignore() })" t); (1, f "action { if (idle(p) == p) { post x: 1 } }") ]

let part = frequency [ (3, recruiting); (2, other); (1, free) ]

let task =
  let* a = recruiting and* b = part and* c = part and* d = free and* g = guard and* h = handler in
  frequencyl
    [ (5, f "%s | %s" a b); (3, f "%s | %s | %s" a b c); (2, f "(watch (%s | %s) onError { %s }) | %s" a b h c);
      (2, f "(until { %s } run (%s | %s)) | %s" g a b c); (1, f "(during 1 run (%s | %s)) | %s" a b c);
      (1, f "((%s | %s) >> %s) | %s" a b d c); (1, f "recruit { } then { o -> %s | %s } | %s" b d a) ]

let text =
  let* t = task and* c = code and* g = guard in
  let* before = frequencyl [ (3, ""); (1, "post x: 1\n"); (1, "post y: 1\n") ] in
  let* then_ = frequencyl [ (3, ""); (1, c); (1, f "execute condition { %s }" g) ] in
  return (f "g = 0\np = pick { id 'a' }\n%sexecute %s\n%s\n" before t then_)

let print ((text, (world, _)), (name, _)) = f "%s, in the world '%s':\n%s" name world text

(* {1 Agreement} *)

let refused = ref 0
let tally = Tally.create ()

let agrees ((text, (_, world)), (_, environment)) =
  match Pure_run.compile text with
  | Error _ ->
    Test_support.Property.count refused;
    true
  | Ok program ->
    let program = Test_support.Posts.declared environment program in
    Tally.agrees tally (Agreement.check ~limit ~reductions:[ Partial_order; All ] environment program world)

let test_agreement () =
  let case = pair (pair text (oneofl worlds)) (oneofl environments) in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"reduced and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf "%d refused, %d skipped, of more than %d states; %d states, %d after reduction\n" !refused tally.skipped
    limit tally.whole tally.reduced

(* Where nothing is reduced, agreement proves little. *)
let test_variety () =
  if 2 * (!refused + tally.skipped) > programs then Alcotest.fail "few programs are tried";
  if not (4 * tally.reduced < 3 * tally.whole) then Alcotest.fail "little is reduced"

let () =
  Alcotest.run "recruits"
    [
      ( "random programs",
        [
          Alcotest.test_case "reduced and plain search agree" `Quick test_agreement;
          Alcotest.test_case "states are saved" `Quick test_variety;
        ] );
    ]
