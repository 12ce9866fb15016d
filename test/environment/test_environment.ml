(* What the outside does, and what it remembers: bounds of 2, which tell counting from remembering
   that something was. *)

open Dolphin_environment
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let of_kind kind = List.map (fun id -> Pure_run.vehicle ~kind id)
let world = Pure_run.world (of_kind "UUV" [ "a"; "b" ] @ of_kind "UAV" [ "c"; "d" ] @ of_kind "USV" [ "e"; "f" ])
let plain = Environment.default
let property = Alcotest.testable Property.pp ( = )

(* The properties that the program breaks, of all and without reduction. *)
let breaks name environment expected text =
  let test () =
    let search reduction =
      let options = { Search.default with environment; reduction } in
      let outcome = Search.run options (Pure_run.compile_exn text) world in
      let is_broken (p, verdict) =
        match (verdict : Search.verdict) with
        | Violated _ -> Some p
        | Holds | Unreached _ -> None
        | Inconclusive bound -> Alcotest.failf "%a: %a" Property.pp p Dolphin_checker.Limits.pp_bound bound
      in
      List.filter_map is_broken outcome.verdicts
    in
    Alcotest.(check (list property)) name expected (search Whole);
    Alcotest.(check (list property)) (name ^ ", reduced") expected (search All)
  in
  Alcotest.test_case name `Quick test

(* {1 Latecomers}

   Several vehicles are picked in the order in which they come. So [b] comes before [a] only if [a] is late. *)

let late most = { plain with faults = { Faults.none with join = At_most most } }
let pairs = [ ("UUV", "b"); ("UAV", "d"); ("USV", "f") ]

let late_in_turn n =
  let picks (kind, second) =
    Printf.sprintf "vs = pick { count 2 ; type '%s' }\nif (vs[0].getId() == '%s') { late = late + 1 }\n" kind second
  in
  let first_pairs = List.filteri (fun i _ -> i < n) pairs in
  Printf.sprintf "late = 0\n%sif (late == %d) { halt 'all were late' }" (String.concat "" (List.map picks first_pairs)) n

let late_again =
  {|vs = pick { count 2 ; type 'UUV' }
    release vs
    ws = pick { count 2 ; type 'UUV' }
    us = pick { count 2 ; type 'UAV' }
    if (vs[0].getId() == 'b' && ws[0].getId() == 'b' && us[0].getId() == 'd') { halt 'a twice, and c' }|}

let missing : Property.t list = [ Vehicles ]

let latecomers =
  [
    breaks "one of one" (late 1) (missing @ [ No_halt ]) (late_in_turn 1);
    breaks "two of one" (late 1) missing (late_in_turn 2);
    breaks "two of two" (late 2) (missing @ [ No_halt ]) (late_in_turn 2);
    breaks "three of two" (late 2) missing (late_in_turn 3);
    breaks "three of three" (late 3) (missing @ [ No_halt ]) (late_in_turn 3);
    breaks "one of them twice, two of one" (late 1) missing late_again;
    breaks "one of them twice, two of two" (late 2) (missing @ [ No_halt ]) late_again;
  ]

(* {1 Failures and losses} *)

(* Each of [n] tasks ends badly, which is ignored, or well. *)
let tasks_that_end_badly n =
  Printf.sprintf
    {|bad = 0
      v = pick { type 'UUV' }
      for (i in 1..%d) { execute watch task('p')[v] onError { bad = bad + 1 ; ignore() } }
      if (bad == %d) { halt 'all ended badly' }|}
    n n

let failing n = Environment.failing ~failures:n plain
let losing n = { plain with faults = { Faults.none with loss = At_most n } }

(* A lost vehicle that is lost again was not heard of in between, which is one loss; then it is heard of. *)
let lost_again =
  {|bad = 0
    v = pick { type 'UUV' }
    for (i in 1..4) { execute watch task('p')[v] onError { bad = bad * 10 + 1 ; ignore() }
                      if (bad % 10 == 0 || i > bad.toString().size()) { bad = bad * 10 } }
    if (bad == 1101) { halt 'lost, lost, back, lost' }|}

let ends =
  [
    breaks "two failures of one" (failing 1) [] (tasks_that_end_badly 2);
    breaks "two failures of two" (failing 2) [ No_halt ] (tasks_that_end_badly 2);
    breaks "three failures of two" (failing 2) [] (tasks_that_end_badly 3);
    breaks "three times lost for one loss" (losing 1) [ No_halt ] (tasks_that_end_badly 3);
    breaks "lost, back and lost for one loss" (losing 1) [] lost_again;
    breaks "lost, back and lost for two losses" (losing 2) [ No_halt ] lost_again;
    breaks "a lost vehicle may be missing" (losing 1) missing
      {|v = pick { type 'UUV' ; id 'a' }
        execute watch task('p')[v] onError { ignore() }
        release v
        v = pick { id 'a' ; timeout 1.seconds }|};
    breaks "one that is back may not" (losing 1) []
      {|v = pick { type 'UUV' ; id 'a' }
        lost = false
        execute watch task('p')[v] onError { lost = true ; ignore() }
        back = true
        execute watch task('p')[v] onError { back = false ; ignore() }
        release v
        if (back) { v = pick { id 'a' ; timeout 1.seconds } }|};
  ]

(* {1 Answers} *)

let answering answers = { plain with answers = (fun _ -> answers) }

let answers =
  [
    breaks "others come later" (answering [ [ "1" ]; [ "2"; "3" ] ]) [ No_halt ]
      {|x = ask('which')
        y = ask('which')
        z = ask('which')
        if (x == 1 && y == 2 && z == 3) { halt 'h' }|};
    breaks "none but the first comes first" (answering [ [ "1" ]; [ "2"; "3" ] ]) []
      {|x = ask('which')
        if (x != 1) { halt 'h' }|};
    breaks "one that is refused is asked again" (answering [ [ "(" ]; [ ")" ]; [ "3" ] ]) [ No_halt ]
      {|x = ask('which')
        if (x == 3) { halt 'h' }|};
    breaks "as long as there is another" (answering [ [ "(" ]; [ ")" ] ]) [ No_error ] {|x = ask('which')|};
  ]

let () = Alcotest.run "environment" [ ("latecomers", latecomers); ("ends", ends); ("answers", answers) ]
