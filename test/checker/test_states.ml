(* The two sets of states: each numbers vectors in the order in which they come, knows those that it has, and keeps all
   this when it grows and when it is rewritten. *)

open Dolphin_checker

let states = 150_000

(* Vectors that differ in one word only, in any. *)
let vector words i = Array.init words (fun w -> if w = i mod words then (i * 7919) lxor min_int else 5)

(* Vectors in small numbers, which grow. *)
let growing words i = Array.init words (fun w -> if w = 0 then i else i / (1 lsl w))

let no_more _ _ = Alcotest.fail "a vector that is known was new"

let fill ~compress words vector =
  let set = States.create ~compress ~words in
  let next = ref 0 in
  let fresh i first =
    if i <> !next then Alcotest.failf "vector %d is numbered %d" !next i;
    if first <> (vector i).(0) then Alcotest.failf "vector %d has another first word" i;
    incr next
  in
  for i = 0 to states - 1 do
    States.push set (vector i) ~parent:(i / 2) ~fresh
  done;
  States.flush set ~fresh;
  set

let check set words key =
  Alcotest.(check int) "count" states (States.count set);
  let loaded = Array.make words 0 in
  for i = 0 to states - 1 do
    let number = States.find set (key i) in
    if number <> i then Alcotest.failf "vector %d is found as %d" i number;
    States.push set (key i) ~parent:states ~fresh:no_more;
    States.load set i loaded;
    if loaded <> key i then Alcotest.failf "vector %d is not what was put in" i;
    if i mod 61 = 0 && States.parent set i <> i / 2 then Alcotest.failf "vector %d has lost its parent" i
  done;
  States.flush set ~fresh:no_more;
  Alcotest.(check int) "an unknown vector" (-1) (States.find set (Array.make words 3_000_001))

let test_numbers ~compress words () =
  check (fill ~compress words (vector words)) words (vector words);
  check (fill ~compress words (growing words)) words (growing words)

let test_rewrite ~from ~into ~compress () =
  let renew old fresh = Array.iteri (fun w word -> fresh.(into - 1 - w) <- word + 1) old in
  let set = States.rewrite (fill ~compress from (vector from)) ~words:into renew in
  let key i =
    let fresh = Array.make into 0 in
    renew (vector from i) fresh;
    fresh
  in
  check set into key

(* Parents that stay the same for long, and that jump far. *)
let test_parents () =
  let parents = Parents.create () in
  let parent i = (i / 700 * 500) + if i > 2_000 then 100_000 else 0 in
  for i = 0 to 9_999 do
    Parents.add parents (parent i)
  done;
  for i = 0 to 9_999 do
    Alcotest.(check int) (Printf.sprintf "of %d" i) (parent i) (Parents.get parents i)
  done

let () =
  let case name f = Alcotest.test_case name `Quick f in
  let rewritings ~compress =
    [
      case "in place" (test_rewrite ~from:1 ~into:1 ~compress);
      case "into more words" (test_rewrite ~from:1 ~into:2 ~compress);
      case "two into three" (test_rewrite ~from:2 ~into:3 ~compress);
    ]
  in
  let numbers ~compress =
    List.map (fun n -> case (Printf.sprintf "%d words" n) (test_numbers ~compress n)) [ 1; 2; 3 ]
  in
  Alcotest.run "sets of states"
    [
      ("numbers", numbers ~compress:false);
      ("numbers, compressed", numbers ~compress:true);
      ("rewriting", rewritings ~compress:false);
      ("rewriting, compressed", rewritings ~compress:true);
      ("parents", [ case "found again" test_parents ]);
    ]
