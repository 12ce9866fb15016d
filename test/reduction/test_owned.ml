(* Tasks whose handlers give other tasks, each on a vehicle of its own or on any that is free: on random programs
   every verdict of a search with partial order is that of the plain one, and tasks come to the same in both. With a
   handler for each vehicle, states grow as vehicles do. PROGRAMS in the environment is the number of programs, 1,000
   by default; SEED is the first seed. *)

open Dolphin_environment
open Dolphin_explore
open QCheck2.Gen
module Pure_run = Test_support.Pure_run

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let programs = number "PROGRAMS" 1_000
let usual = 20_261_128
let limit = number "LIMIT" 600
let f = Printf.sprintf

(* {1 Worlds} *)

let world = Pure_run.world (List.map (fun v -> Pure_run.vehicle v) [ "a"; "b"; "c"; "d" ])
let answering = Environment.default
let faulty faults = { answering with faults = Result.get_ok (Faults.of_string faults) }

let environments =
  [ ("with failures", faulty "fail"); ("with two failures", faulty "fail=2"); ("with losses", faulty "loss");
    ("with a loss", faulty "loss=1"); ("with all faults", faulty "all");
    ("with an input", { (faulty "fail") with inputs = Test_support.Posts.once });
    ("with plan s failing on b", { answering with endings = (fun v p -> if v = "b" && p = "s" then Fails else May_fail) }) ]

(* {1 Programs} *)

let guard = frequencyl [ (3, "consume x: 1"); (2, "poll x: 1"); (1, "!poll(x: 1)"); (1, "idle(w) == w") ]
let action = oneofl [ "post x: 1"; "post x: 1"; "g = g + 1"; "message 'm'"; "if (idle(u) == u) { post x: 1 }" ]

(* The vehicles of a task: its own, one of several, any. *)
let place u = frequencyl [ (6, f "[%s]" u); (1, "[u + w]"); (1, "[w]"); (1, "") ]

let handler u =
  let given = map (f "task('home')%s") (place u) in
  frequency
    [ (6, given); (2, map (f "{ task('r')%s }") (place u)); (2, return "ignore()"); (1, return "retry()");
      (1, return "post x: 1 ; ignore()"); (1, map (f "if (poll(x: 1)) { %s } else { ignore() }") given);
      (1, return (f "dismiss %s ; ignore()" u)); (1, map (f "watch task('home')[%s] onError { %s }" u) given) ]

let rec work depth u =
  let leaf =
    frequency
      [ (5, map2 (f "task('%s')[%s]") (oneofl [ "s"; "t" ]) (return u)); (1, map (f "action { %s }") action);
        (1, map (f "condition { %s }") guard); (1, map (f "({ task('m') })%s") (place u)) ]
  in
  if depth = 0 then leaf
  else
    let part = work (depth - 1) u in
    frequency
      [ (2, leaf); (3, map2 (f "(%s >> %s)") part part); (6, map2 (f "(watch %s onError { %s })") part (handler u));
        (1, map2 (f "(waitFor { %s } then %s)") guard part); (1, map2 (f "(until { %s } run %s)") guard part);
        (1, map (f "(during 1 run %s)") part); (1, map (f "(repeat 2, %s)") part) ]

let task =
  let* a = work 2 "u" and* b = work 2 "w" and* c = work 1 "z" and* h = handler "u" and* g = guard in
  frequencyl
    [ (5, f "%s | %s" a b); (3, f "%s | %s | %s" a b c); (2, f "(watch (%s | %s) onError { %s }) | %s" a b h c);
      (1, f "(until { %s } run (%s | %s)) | %s" g a b c); (1, f "(during 1 run (%s | %s)) | %s" a b c);
      (1, f "((%s | %s) >> task('s')[w]) | %s" a b c) ]

let text =
  let* t = task and* g = guard in
  let* before = frequencyl [ (3, ""); (1, "post x: 1\n") ] in
  let* then_ = frequencyl [ (3, ""); (1, f "execute condition { %s }" g); (1, "execute task('s')[u] | task('t')[w]") ] in
  let picks = "u = pick { id 'a' }\nw = pick { id 'b' }\nz = pick { id 'c' }\n" in
  return (f "g = 0\n%s%sexecute %s\n%s\n" picks before t then_)

let print (text, (name, _)) = f "%s:\n%s" name text

(* {1 Agreement} *)

let refused = ref 0
let tally = Tally.create ()

let agrees (text, (_, environment)) =
  match Pure_run.compile text with
  | Error _ ->
    Test_support.Property.count refused;
    true
  | Ok program ->
    let program = Test_support.Posts.declared environment program in
    Tally.agrees tally (Agreement.check ~limit ~reductions:[ Partial_order; All ] environment program world)

let test_agreement () =
  let case = pair text (oneofl environments) in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"reduced and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf "%d refused, %d skipped, of more than %d states; %d states, %d after reduction\n" !refused tally.skipped
    limit tally.whole tally.reduced

let test_variety () =
  if 2 * (!refused + tally.skipped) > programs then Alcotest.fail "few programs are tried";
  if not (4 * tally.reduced < 3 * tally.whole) then Alcotest.fail "little is reduced"

(* {1 Fail, then come home} *)

let states n =
  let vehicles = List.init n (f "v%02d") in
  let world = Pure_run.world (List.map (fun v -> Pure_run.vehicle v) vehicles) in
  let program =
    Pure_run.compile_exn
      (f "include 'prelude'\nvs = pick { count %d }\nexecute forall(vs) { v ->\n\
          watch (task('p') >> task('q') >> task('r') >> task('s')) onError { task('home')[v] } }" n)
  in
  let o = Search.run { Search.default with environment = faulty "fail"; reduction = All } program world in
  o.states

let test_growth () =
  let three = states 3 and six = states 6 and twenty = states 20 in
  Alcotest.(check bool) "six: fewer than 500" true (six < 500);
  Alcotest.(check int) "as vehicles" (17 * (six - three) / 3) (twenty - three)

let () =
  Alcotest.run "owned vehicles"
    [
      ( "random programs",
        [
          Alcotest.test_case "reduced and plain search agree" `Quick test_agreement;
          Alcotest.test_case "states are saved" `Quick test_variety;
        ] );
      ("growth", [ Alcotest.test_case "fail, then come home" `Quick test_growth ]);
    ]
