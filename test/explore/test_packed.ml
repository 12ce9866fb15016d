(* The set of packed states: it numbers vectors in the order in which they come, knows those that it has, and keeps all
   this when it grows and when it is rewritten. *)

open Dolphin_explore

let states = 300_000

(* Vectors that differ in one word only, in any. *)
let vector words i = Array.init words (fun w -> if w = i mod words then (i * 7919) lxor min_int else 5)

let fill words =
  let set = Packed.create ~words in
  for i = 0 to states - 1 do
    let added = Packed.add set (vector words i) ~parent:(i / 2) in
    if added <> -1 - i then Alcotest.failf "vector %d is new, but add gives %d" i added
  done;
  set

let check set words key =
  Alcotest.(check int) "count" states (Packed.count set);
  let loaded = Array.make words 0 in
  for i = 0 to states - 1 do
    let number = Packed.add set (key i) ~parent:0 in
    if number <> i then Alcotest.failf "vector %d is found as %d" i number;
    Packed.load set i loaded;
    if loaded <> key i then Alcotest.failf "vector %d is not what was put in" i;
    if Packed.parent set i <> i / 2 then Alcotest.failf "vector %d has lost its parent" i
  done;
  Alcotest.(check int) "an unknown vector" (-1) (Packed.find set (Array.make words 3))

let test_numbers words () = check (fill words) words (vector words)

let test_rewrite ~from ~into () =
  let renew old fresh = Array.iteri (fun w word -> fresh.(into - 1 - w) <- word + 1) old in
  let set = Packed.rewrite (fill from) ~words:into renew in
  let key i =
    let fresh = Array.make into 0 in
    renew (vector from i) fresh;
    fresh
  in
  check set into key

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "packed"
    [
      ("numbers", List.map (fun n -> case (Printf.sprintf "%d words" n) (test_numbers n)) [ 1; 2; 3 ]);
      ( "rewriting",
        [
          case "in place" (test_rewrite ~from:1 ~into:1);
          case "into more words" (test_rewrite ~from:1 ~into:2);
          case "two into three" (test_rewrite ~from:2 ~into:3);
        ] );
    ]
