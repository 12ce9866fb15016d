(* The sets of states: each numbers vectors in the order in which they come, knows those that it has, and keeps all
   this when it grows and when it is rewritten. *)

open Dolphin_checker

let states = 150_000

(* Vectors that differ in one word only, in any. *)
let vector words i = Array.init words (fun w -> if w = i mod words then (i * 7919) lxor min_int else 5)

(* Vectors in small numbers, which grow. *)
let growing words i = Array.init words (fun w -> if w = 0 then i else i / (1 lsl w))

let no_more _ _ = Alcotest.fail "a vector that is known was new"

(* [On_disk n] go there when there are [n], to a folder that is empty afterwards too; [Shared n] are shared from then
   on. *)
type kind = As_they_are | Compressed | On_disk of int | Shared of int

let folder = Filename.get_temp_dir_name ()

let fill kind words vector =
  let set = ref (States.create ~compress:(kind = Compressed) ~words) in
  let next = ref 0 in
  let fresh i first =
    if i <> !next then Alcotest.failf "vector %d is numbered %d" !next i;
    if first <> (vector i).(0) then Alcotest.failf "vector %d has another first word" i;
    incr next
  in
  for i = 0 to states - 1 do
    if kind = On_disk i then begin
      States.flush !set ~fresh;
      set := States.spill !set ~directory:folder ~tick:ignore
    end;
    if kind = Shared i then begin
      States.flush !set ~fresh;
      set := States.share !set ~workers:1
    end;
    States.push !set (vector i) ~parent:(i / 2) ~fresh;
    (* Known ones among the new. *)
    if i mod 5 = 0 then States.push !set (vector (i / 3)) ~parent:(i / 2) ~fresh
  done;
  States.flush !set ~fresh;
  !set

(* Then what it has taken is given back: sets that are shared take addresses for all that the machine may hold. *)
let check set words key =
  Fun.protect ~finally:(fun () -> States.close set) @@ fun () ->
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

let test_numbers kind words () =
  check (fill kind words (vector words)) words (vector words);
  check (fill kind words (growing words)) words (growing words)

let test_rewrite ~from ~into kind () =
  let renew old fresh = Array.iteri (fun w word -> fresh.(into - 1 - w) <- word + 1) old in
  let set = States.rewrite (fill kind from (vector from)) ~words:into renew in
  let key i =
    let fresh = Array.make into 0 in
    renew (vector from i) fresh;
    fresh
  in
  check set into key

(* Vectors in more words go on being added to those that were rewritten. *)
let test_growth_after_rewriting () =
  let renew old fresh = fresh.(1) <- old.(0) in
  let set = States.rewrite (fill (On_disk 70_000) 1 (vector 1)) ~words:2 renew in
  let key i = [| (if i < states then 0 else i); (vector 1 (min i (states - 1))).(0) |] in
  Alcotest.(check int) "an unknown vector" (-1) (States.find set (key states));
  let next = ref states in
  let fresh i _ =
    Alcotest.(check int) "number" !next i;
    incr next
  in
  for i = 0 to (2 * states) - 1 do
    States.push set (key i) ~parent:(states + (i / 4)) ~fresh
  done;
  States.flush set ~fresh;
  Alcotest.(check int) "count" (2 * states) (States.count set);
  for i = 0 to (2 * states) - 1 do
    if States.find set (key i) <> i then Alcotest.failf "vector %d is not found" i;
    if i >= states && i mod 61 = 0 && States.parent set i <> states + (i / 4) then
      Alcotest.failf "vector %d has lost its parent" i
  done

(* An exception of [tick] leaves everything pushed in place. *)
let test_interruption () =
  let exception Interrupted in
  let interrupts = ref false in
  let tick () = if !interrupts then raise Interrupted in
  let set = States.create ~compress:false ~words:1 and count = ref 0 in
  let fresh _ _ = incr count in
  for i = 0 to 300_000 - 1 do
    States.push set [| i |] ~parent:0 ~fresh
  done;
  States.flush set ~fresh;
  let set = States.spill set ~directory:folder ~tick in
  for i = 299_000 to 301_000 - 1 do
    States.push set [| i |] ~parent:1 ~fresh
  done;
  interrupts := true;
  Alcotest.check_raises "interrupted" Interrupted (fun () -> States.flush set ~fresh);
  interrupts := false;
  States.flush set ~fresh;
  Alcotest.(check int) "count" 301_000 (States.count set);
  Alcotest.(check int) "all were told" 301_000 !count;
  Alcotest.(check int) "the last" 300_999 (States.find set [| 300_999 |])

let test_no_folder () =
  let set = fill As_they_are 1 (vector 1) in
  match States.spill set ~directory:"/nowhere" ~tick:ignore with
  | _ -> Alcotest.fail "states went to a folder that is not there"
  | exception States.Disk_failed why ->
    Alcotest.(check string) "why" "/nowhere: no file can be made there" why

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
  let rewritings kind =
    [
      case "in place" (test_rewrite ~from:1 ~into:1 kind);
      case "into more words" (test_rewrite ~from:1 ~into:2 kind);
      case "two into three" (test_rewrite ~from:2 ~into:3 kind);
    ]
  in
  let numbers kind =
    List.map (fun n -> case (Printf.sprintf "%d words" n) (test_numbers kind n)) [ 1; 2; 3 ]
  in
  Alcotest.run "sets of states"
    [
      ("numbers", numbers As_they_are);
      ("numbers, compressed", numbers Compressed);
      ("numbers, on disk early", numbers (On_disk 10_000));
      ("numbers, on disk late", numbers (On_disk 100_000));
      ("numbers, shared early", numbers (Shared 10_000));
      ("numbers, shared late", numbers (Shared 100_000));
      ("rewriting", rewritings As_they_are);
      ("rewriting, shared", rewritings (Shared 70_000));
      ("rewriting, compressed", rewritings Compressed);
      ("rewriting, on disk", rewritings (On_disk 70_000));
      ( "disk",
        [ case "more words" test_growth_after_rewriting; case "interrupted" test_interruption;
          case "no folder" test_no_folder ] );
      ("parents", [ case "found again" test_parents ]);
    ]
