(* Events and memory of the environment. Bounds of 2 distinguish a counter from a flag. *)

open Dolphin_semantics
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
        | Holds | Holds_if _ | By_design _ | Unreached _ -> None
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

let late_twice =
  {|vs = pick { count 2 ; type 'UUV' }
    release vs
    ws = pick { count 2 ; type 'UUV' }
    if (vs[0].getId() == 'b' && ws[0].getId() == 'b') { halt 'a twice' }|}

let missing : Property.t list = [ Vehicles ]

let latecomers =
  [
    breaks "one of one" (late 1) (missing @ [ No_halt ]) (late_in_turn 1);
    breaks "two of one" (late 1) missing (late_in_turn 2);
    breaks "two of two" (late 2) (missing @ [ No_halt ]) (late_in_turn 2);
    breaks "three of two" (late 2) missing (late_in_turn 3);
    breaks "three of three" (late 3) (missing @ [ No_halt ]) (late_in_turn 3);
    breaks "one of them twice" (late 1) (missing @ [ No_halt ]) late_twice;
    breaks "one of them twice, two of one" (late 1) missing late_again;
    breaks "one of them twice, two of two" (late 2) (missing @ [ No_halt ]) late_again;
  ]

(* {2 Against the definition}

   The definition in docs/explorer.md of a pick with uncertain vehicles: some of them come after all others, in any
   order, some
   are missing, and no more than the bound allows. The ways in which too few come are one. *)

let definition (options : Environment.options) most program world (c : Configuration.t) =
  let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world) in
  let rec arrangements vs =
    let first v = List.map (List.cons v) (arrangements (List.filter (( <> ) v) vs)) in
    [] :: List.concat_map first vs
  in
  let rec subsets = function
    | [] -> [ [] ]
    | v :: rest -> List.concat_map (fun vs -> [ vs; v :: vs ]) (subsets rest)
  in
  let unsure = List.filter options.may_be_late ids in
  let with_missing missing =
    let others = List.filter (fun v -> not (List.mem v missing)) unsure in
    List.map (fun coming -> (coming, missing)) (arrangements others)
  in
  let is_allowed (coming, missing) = List.length coming + List.length missing <= most in
  let transitions (coming, missing) =
    let late = List.map (fun v -> World.Late v) coming and missing = List.map (fun v -> World.Missing v) missing in
    let world = World.suppose (late @ missing) world in
    let on_timer = Transition.accept_all program world c (Timer_expired Residual.script_timer) in
    List.of_seq (Result.get_ok (Transition.internal_all program world c))
    @ List.filter_map Result.to_option (Result.get_ok on_timer)
  in
  List.concat_map transitions (List.filter is_allowed (List.concat_map with_missing (subsets unsure)))

let outcomes transitions =
  let outcome (t : Transition.t) =
    match t.label with No_vehicles _ -> "too few come" | label -> Format.asprintf "%a" Label.pp label
  in
  List.sort compare (List.map outcome transitions)

(* The first wait of the program. *)
let waiting program world =
  let rec from (c : Configuration.t) =
    match c.control with
    | Waiting _ -> c
    | Script _ | Executing _ | Ended _ -> (
        match Transition.internal program world c () with
        | Cons (t, _) -> from t.next
        | Nil -> failwith "the program does not pick")
  in
  from (Configuration.initial program)

(* The late vehicles that a program with [else] remembers once it goes on without them: each minimal set. *)
let late_without ?(who = fun v -> v <> "c") ?alike join text =
  let options = { plain with may_be_late = who; faults = { Faults.none with join } } in
  let program = Pure_run.compile_exn text in
  let world = Pure_run.world (of_kind "UUV" [ "a"; "b"; "c"; "d" ]) in
  let without ((t : Transition.t), e) =
    match t.label with No_vehicles _ -> Some (String.concat " " (Environment.late e)) | _ -> None
  in
  let c = waiting program world in
  let choices = Environment.choices ?alike options program world Environment.initial c in
  List.sort compare (List.filter_map without (List.of_seq choices))

let goes_on ?alike name join text expected =
  Alcotest.test_case name `Quick (fun () ->
      Alcotest.(check (list string)) "who was late" expected (late_without ?alike join text))

let going_on_without =
  [
    goes_on "with a bound, each choice of the missing" (Faults.At_most 2) "v = pick { count 3 } else { null }"
      [ "a b"; "a d"; "b d" ];
    goes_on "with a bound, of those that are alike the first" (Faults.At_most 2) "v = pick { count 3 } else { null }"
      ~alike:(fun v -> if v = "a" || v = "b" then Some "a" else None) [ "a b"; "a d" ];
    goes_on "without a bound, one" Any_number "v = pick { count 3 } else { null }" [ "" ];
    goes_on "of an end, one" (At_most 2) "v = pick { count 3 }" [ "a b" ];
    goes_on "more would be missing than may be" (At_most 1) "v = pick { count 3 } else { null }" [];
    goes_on "all are there" Never "v = pick { count 4 } else { null }" [];
    goes_on "too few, whoever comes" Never "v = pick { count 5 } else { null }" [ "" ];
  ]

let random_pick =
  let open QCheck2.Gen in
  let place = oneofl [ [ 0. ]; [ 900. ]; [ 0.; 900. ] ] in
  let vehicle = pair place bool in
  let* vehicles = list_size (int_range 1 5) vehicle in
  let* most = int_bound 5 and* has_bound = bool and* in_region = bool and* count = int_bound 3 in
  let count = if count = 0 then "_" else string_of_int count in
  let region = if in_region then "region Location.APDL, 100; " else "" in
  let text = Printf.sprintf "vs = pick { count %s; %stimeout 1.seconds }" count region in
  return (vehicles, (if has_bound then Some most else None), text)

let agrees_with_definition (vehicles, bound, text) =
  let at north = Dolphin_geo.Wgs84.displace Dolphin_geo.Place.apdl ~north ~east:0. in
  let id i = Printf.sprintf "v%d" i in
  let add (i, world) (places, _) =
    let s = { (Pure_run.vehicle (id i)) with position = at (List.hd places) } in
    let world = World.add s world in
    (i + 1, match places with [ _ ] -> world | _ -> World.open_position s.id (List.map at places) world)
  in
  let world = snd (List.fold_left add (0, World.empty) vehicles) in
  let may_be_late v = snd (List.nth vehicles (int_of_string (String.sub v 1 (String.length v - 1)))) in
  let join = match bound with Some most -> Faults.At_most most | None -> Any_number in
  let options = { plain with may_be_late; faults = { Faults.none with join } } in
  let program = Pure_run.compile_exn text in
  let c = waiting program world in
  let choices = Environment.choices options program world Environment.initial c in
  let found = outcomes (List.map fst (List.of_seq choices)) in
  let most = Option.value bound ~default:max_int in
  let defined = List.sort_uniq compare (outcomes (definition options most program world c)) in
  if found <> defined then
    QCheck2.Test.fail_reportf "found: %s@.defined: %s" (String.concat "; " found) (String.concat "; " defined);
  (* The first among those like a transition that has its label is what it is among all. *)
  let with_label (t : Transition.t) ((t' : Transition.t), _) = Label.equal t'.label t.label in
  let is_kept ((t : Transition.t), _) =
    let first choices =
      let found = Environment.find (with_label t) choices in
      Option.map (fun ((t : Transition.t), outside) -> (t.next, Environment.memory outside)) found
    in
    let like = Environment.choices_like t options program world Environment.initial c in
    match first choices, first like with
    | Some (c, e), Some (c', e') -> Configuration.equal c c' && e = e'
    | Some _, None | None, _ -> false
  in
  (match List.find_opt (fun choice -> not (is_kept choice)) (List.of_seq choices) with
   | Some (t, _) -> QCheck2.Test.fail_reportf "not among those like it: %a" Label.pp t.label
   | None -> ());
  true

let print_pick (vehicles, bound, text) =
  let vehicle (places, late) = Printf.sprintf "%d places%s" (List.length places) (if late then ", may be late" else "") in
  Printf.sprintf "%s with %s, at most %s" text (String.concat "; " (List.map vehicle vehicles))
    (Option.fold ~none:"any number" ~some:string_of_int bound)

let by_definition =
  [ Test_support.Property.case ~count:500 ~print:print_pick "picks with latecomers" random_pick agrees_with_definition ]

(* There are 30! orders. *)
let test_lazy () =
  let world = Pure_run.world (of_kind "UUV" (List.init 30 string_of_int)) in
  let program = Pure_run.compile_exn "vs = pick { count 30 }" in
  let options = { plain with faults = { Faults.none with join = Any_number } } in
  let choices c = Environment.choices options program world Environment.initial c in
  match Environment.find (fun _ -> true) (choices (Configuration.initial program)) with
  | None -> Alcotest.fail "the program does not pick"
  | Some ((t : Transition.t), _) ->
    let rec count n choices =
      match (choices : _ Seq.t) () with Cons (_, rest) when n < 1_000 -> count (n + 1) rest | Cons _ | Nil -> n
    in
    Alcotest.(check int) "transitions" 1_000 (count 0 (choices t.next))

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

let any_loss = { plain with faults = { Faults.none with loss = Any_number } }

let lost =
  {|failed = false
    v = pick { type 'UUV' ; id 'a' }
    execute watch task('p')[v] onError { failed = true ; ignore() }
|}

(* [before], a task that may be lost, [after]. *)
let again before after = before ^ "\nexecute watch task('p')[vs] onError { ignore() }\n" ^ after

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
    breaks "nobody is missing who is not looked for" any_loss [ No_halt ] (lost ^ "if (failed) { halt 'lost' }");
    breaks "lost, and looked for" any_loss missing (lost ^ "release v\nv = pick { id 'a' ; timeout 1.seconds }");
    breaks "lost, and looked for in a loop" any_loss missing
      (again "for (i in 1..2) { vs = pick { id 'a' ; timeout 1.seconds }" "release vs }");
    breaks "lost, and looked for while it goes on" any_loss missing
      (again "i = 0\nwhile (i < 2) { i = i + 1 ; vs = pick { id 'a' ; timeout 1.seconds }" "release vs }");
    breaks "lost, and looked for by a function" any_loss missing
      ("def look() { return pick { id 'a' ; timeout 1.seconds } }\n" ^ lost ^ "release v\nv = look()");
    breaks "lost by a function" any_loss missing
      ("def fly(v) { execute watch task('p')[v] onError { ignore() } }\nv = pick { id 'a' }\nfly(v)\nrelease v\n\
        v = pick { id 'a' ; timeout 1.seconds }");
    breaks "lost by a function that looks for it" any_loss missing
      (again "def turn() {\nvs = pick { id 'a' ; timeout 1.seconds }" "release vs }\nturn()\nturn()");
    breaks "lost, and looked for after an early end of a loop" any_loss missing
      (again "vs = pick { id 'a' }\nwhile (true) {" "release vs\nbreak }\nv = pick { id 'a' ; timeout 1.seconds }");
    breaks "lost in one of two branches, and looked for" any_loss missing
      (again "vs = pick { id 'a' }\nif (vs.size() == 1) {" "} else { ws = pick { id 'b' } }\nrelease vs\n\
                                                            v = pick { id 'a' ; timeout 1.seconds }");
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

let () = Alcotest.run "environment" [ ("latecomers", latecomers @ by_definition @ [ Alcotest.test_case "one by one" `Quick test_lazy ]); ("going on without", going_on_without); ("ends", ends); ("answers", answers) ]
