(* The work of a search, counted in bytes allocated, grows with the size of the program and not faster: terms, code and
   values that hold one part twice at each level have far more parts than they have memory. *)

open Dolphin_explore
open Test_support

let world = Pure_run.world [ Pure_run.vehicle "n1"; Pure_run.vehicle "n2" ~north:1. ]

(* For each transition. *)
let bytes source =
  let program = Pure_run.compile_exn source in
  let before = Gc.allocated_bytes () in
  let o = Search.run { Search.default with reduction = All } program world in
  Alcotest.(check bool) "the search ends" true (o.states >= 5);
  (Gc.allocated_bytes () -. before) /. float_of_int o.transitions

let rec nested n inner = if n = 0 then inner else Printf.sprintf "f(%s)" (nested (n - 1) inner)

let grows name source ~fewer ~more ~at_most () =
  let first = bytes (source fewer) and second = bytes (source more) in
  if second > at_most *. first then
    Alcotest.failf "%s: %.0f kB for %d levels, %.0f kB for %d" name (first /. 1e3) fewer (second /. 1e3) more

(* Four times the levels: at most the square of that, twice. *)
let tasks name body =
  let source n = Printf.sprintf "v = pick { count 1 }\ndef f(x) { %s }\nexecute %s" body (nested n "task('p')[v]") in
  Alcotest.test_case name `Quick (grows name source ~fewer:10 ~more:40 ~at_most:32.)

(* Code that holds code: four more levels, at most twice the work. *)
let code =
  let source n =
    "v = pick { count 1 }\ndef f(c) { return { if (poll z: 1) { c(); c() } } }\ndef act(k) { return action { k() } }\n"
    ^ Printf.sprintf "execute (act(%s) >> task('p')[v]) | action { post b: 1 }" (nested n "{ post a: 1 }")
  in
  Alcotest.test_case "code that holds code twice" `Quick (grows "code" source ~fewer:10 ~more:14 ~at_most:2.)

(* Values of two million parts, and of thirty million. *)
let values name body =
  let source n =
    Printf.sprintf "v = pick { count 1 }\nxs = [1, 2]\nfor (i in 1..%d) { xs = [xs, xs] }\ndef f(c) { %s }\n" n body
    ^ "execute (f(xs) >> task('p')[v]) | action { post b: 1 }"
  in
  Alcotest.test_case name `Quick (grows name source ~fewer:20 ~more:24 ~at_most:2.)

let () =
  Alcotest.run "growth"
    [ ( "levels of tasks",
        [ tasks "handlers that give the task" "watch x onError { x }";
          tasks "handlers that give it in another" "watch x onError { action { post a: 1 } >> x }";
          tasks "handlers that retry" "watch x onError { if (poll a: 1) { retry() } else { x } }";
          tasks "handlers that ignore" "watch x onError { ignore() }"; tasks "until" "until { poll a: 1 } run x";
          tasks "until that captures" "until { x == 1 } run x"; tasks "within" "within 5.min run x";
          tasks "code before" "action { y = x } >> x"; tasks "code that makes it" "action { post a: 1 } >> { x }" ] );
      ("levels of code", [ code ]);
      ( "levels of lists",
        [ values "a list whose method is called" "action { if (poll z: 1) { y = c.size(); post q: (c + c) } }";
          values "a list that is looked for" "condition { poll z: c }" ] ) ]
