open Dolphin_scenario
open Dolphin_syntax

let case name run = Alcotest.test_case name `Quick run

let law name generator ~print property = Test_support.Property.case ~count:300 name ~print generator property

let text = Alcotest.(check string)

let contents file =
  let channel = open_in_bin file in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let shown ~file source =
  match Scenario.read ~file source with
  | Ok s -> Fmt.str "%a" Scenario.pp s
  | Error faults -> String.concat "" (List.map (Fmt.str "%a\n" (Diagnostic.pp ~source)) faults)

let reads source =
  match Scenario.read ~file:"test.fleet" source with
  | Ok s -> s
  | Error faults -> Alcotest.failf "%a" (Fmt.list (Diagnostic.pp ~source)) faults

(* {1 Golden fleets} *)

let golden folder is_right =
  let fleets = List.filter (fun file -> Filename.check_suffix file ".fleet") (Array.to_list (Sys.readdir folder)) in
  let check name =
    let file = folder ^ "/" ^ name in
    let source = contents file in
    case file (fun () ->
        Alcotest.(check bool) "accepted" is_right (Result.is_ok (Scenario.read ~file source));
        text "as expected" (contents (Filename.remove_extension file ^ ".expected")) (shown ~file source))
  in
  List.map check (List.sort String.compare fleets)

(* {1 Reading} *)

let defaults () =
  let s =
    reads "vehicle 'a', { type 'UUV' }; vehicle 'b', { type 'UAV'; at 0, 0 }; vehicle 'c', { type 'UUV' }; plan 'p'" in
  let vehicle n = List.nth s.vehicles n in
  Alcotest.(check (float 0.)) "speed" 1.5 (vehicle 0).speed;
  Alcotest.(check (float 0.)) "speed of a UAV" 18. (vehicle 1).speed;
  Alcotest.(check (float 1e-3)) "side by side" 20.
    (Dolphin_geo.Wgs84.distance (vehicle 0).position (vehicle 2).position);
  Alcotest.(check bool) "off Leixões" true
    (Dolphin_geo.Wgs84.distance (vehicle 0).position Dolphin_geo.Place.apdl < 1000.);
  Alcotest.(check bool) "plan" true
    (Scenario.plan s "p" = Some { name = "p"; duration = None; ending = Succeeds; place = None; only = []; charges = None })

let default_fleet () =
  let s = Scenario.default in
  Alcotest.(check (list (pair string string)))
    "vehicles"
    [ ("noptilus-1", "UUV"); ("noptilus-2", "UUV"); ("noptilus-3", "UUV"); ("x8-02", "UAV") ]
    (List.map (fun (v : Scenario.vehicle) -> (v.id, v.kind)) s.vehicles);
  let off_leixoes (v : Scenario.vehicle) =
    Dolphin_geo.Wgs84.distance v.position { latitude = 41.185; longitude = -8.7062; height = 0. } < 2000. in
  Alcotest.(check bool) "off Leixões" true (List.for_all off_leixoes s.vehicles);
  Alcotest.(check bool) "reads as written" true (Scenario.equal s (reads (Fmt.str "%a" Scenario.pp s)))

let beside () =
  text "same folder" "a.b/prog.fleet" (Scenario.beside "a.b/prog.dol");
  text "no ending" "a.b/prog.fleet" (Scenario.beside "a.b/prog");
  text "two points" "x.y.fleet" (Scenario.beside "x.y.dolphin")

let answers () =
  let s = reads "answer 'one', 2\nanswer 'many', 'x', 3.km" in
  let check expected prompt n = Alcotest.(check (option string)) prompt expected (Scenario.answer s prompt n) in
  check (Some "2") "one" 0;
  check (Some "2") "one" 7;
  check (Some "'x'") "many" 0;
  check (Some "3.km") "many" 1;
  check (Some "3.km") "many" 2;
  check None "none" 0

let replies () =
  let s = reads "reply 'one', 2\nreply 'many', true, either(fails('shut'), 3), [1, task('p')]" in
  let shown reply = Option.map (fun r -> Fmt.str "%a" Reply.pp [ r ]) reply in
  let check expected call n = Alcotest.(check (option string)) call expected (shown (Scenario.reply s call n)) in
  check (Some "2") "one" 0;
  check (Some "2") "one" 7;
  check (Some "true") "many" 0;
  check (Some "fails('shut')") "many" 1;
  check (Some "[1, task('p')]") "many" 2;
  check (Some "[1, task('p')]") "many" 3;
  check None "none" 0;
  let counts call = Option.map (List.map List.length) (Scenario.rounds s call) in
  Alcotest.(check (option (list int))) "choices" (Some [ 1; 2; 1 ]) (counts "many");
  Alcotest.(check (option (list int))) "no choices" None (counts "none")

let inputs () =
  let s = reads "input 'a', true, after 5.min\ninput 'k', 1, either('x', [2]), times 4\ninput 'a', false" in
  let posted (i : Scenario.input) = Fmt.str "%s %a" i.key Dolphin_semantics.Value.pp (Scenario.posted i 3) in
  Alcotest.(check (list string)) "posted" [ "a true"; "k 'x'"; "a false" ] (List.map posted s.inputs);
  Alcotest.(check (list int)) "times" [ 1; 4; 1 ] (List.map (fun (i : Scenario.input) -> i.times) s.inputs);
  let wrong text expected =
    match Scenario.read ~file:"x" text with
    | Ok _ -> Alcotest.failf "%s is read" text
    | Error ds ->
      Alcotest.(check string) text expected (String.concat "; " (List.map (fun (d : Diagnostic.t) -> d.message) ds))
  in
  wrong "input 'a'" "input takes a key and a value, as in input 'abort', true, or input 'target', 1, 2, after 5.min";
  wrong "input 'a', after 3" "input takes a key and a value, as in input 'abort', true, or input 'target', 1, 2, after 5.min";
  wrong "input 'a', 1, times 0" "an input comes at least once";
  wrong "input 'a', 1, times 1.5" "times takes a whole number, as in times 3";
  wrong "input 'a', 1, after 'x'" "expected a time, as in 30.seconds, found the text 'x'";
  wrong "input 'a', 1, after 1, after 2" "after stands twice";
  wrong "input 'a', fails" "fails is not an input";
  wrong "input 'a', [task('p')]" "tasks and objects cannot be posted"

let replies_at () =
  let lines = List.map (fun (call, at) -> (call, Location.line at)) in
  Alcotest.(check (list (pair string int)))
    "places" [ ("a", 1); ("b", 3) ]
    (lines (Scenario.replies_at ~file:"x" "reply 'a', 1\nanswer 'c', 2\nreply 'b', 1"))

let silences () =
  let spans settings =
    match (reads (Printf.sprintf "vehicle 'a', { type 'UUV'; %s }" settings)).vehicles with
    | [ v ] -> Scenario.silences v
    | _ -> Alcotest.fail "one vehicle"
  in
  let check name expected settings =
    Alcotest.(check (list (pair (float 0.) (float 0.)))) name expected (spans settings) in
  check "always there" [] "speed 1";
  check "joins and leaves" [ (0., 30.); (90., infinity) ] "joins 30; leaves 90";
  check "overlapping" [ (5., 20.) ] "drops 10, 10; drops 5, 6";
  check "touching" [ (0., 40.); (80., infinity) ] "joins 30; drops 30, 10; leaves 90; drops 80, 10"

let states () =
  let s =
    reads "vehicle 'a', { type 'UUV' }; vehicle 'b', { type 'UAV'; joins 1 }; vehicle 'c', { type 'X'; drops 0, 9 }" in
  Alcotest.(check (list (pair string bool)))
    "connected"
    [ ("a", true); ("b", false); ("c", false) ]
    (List.map (fun (v : Dolphin_semantics.World.vehicle_state) -> (v.id, v.connected)) (Scenario.states s))

let knowing () =
  let vehicles = "vehicle 'a', { type 'UUV' }; vehicle 'x8-02', { type 'UAV' }; vehicle 'X8-03', { type 'UAV' }" in
  let s = reads ("plan 'p', { only 'uuv', 'x8-02' }; " ^ vehicles) in
  let p = Option.get (Scenario.plan s "p") in
  Alcotest.(check (list bool)) "knows" [ true; true; false ] (List.map (Scenario.knows p) s.vehicles)

(* Every unit of the language measures something here too. *)
let units () =
  List.iter
    (fun unit -> Alcotest.(check bool) unit true (Literal.dimension unit <> None))
    Dolphin_semantics.Operators.unit_names

(* {1 Laws} *)

let name =
  let open QCheck2.Gen in
  let odd = oneofl [ '\''; '\\'; '$'; '\n'; '\t'; '"'; '{' ] in
  string_size ~gen:(oneof [ char_range 'a' 'z'; odd ]) (int_range 1 8)

let one_reply : Reply.t QCheck2.Gen.t =
  let open QCheck2.Gen in
  let open Dolphin_semantics.Core in
  let unknown = Dolphin_semantics.Fault.unknown_site in
  let position =
    map2
      (fun latitude longitude : Dolphin_geo.Position.t -> { latitude; longitude; height = 0. })
      (float_range (-90.) 90.) (float_range (-180.) 180.)
  in
  let circle centre radius = Area (Result.get_ok (Dolphin_geo.Area.circle centre radius)) in
  let corridor p =
    let q = Dolphin_geo.Wgs84.displace p ~north:30. ~east:40. in
    Area (Result.get_ok (Dolphin_geo.Area.corridor [ p; q ] 10.))
  in
  let simple =
    oneof
      [ return Null; map (fun b -> Boolean b) bool; map (fun i -> Integer i) (int_range (-1_000_000) 1_000_000);
        map (fun n -> Number n) (float_range (-1e9) 1e30); map (fun s -> String s) (oneof [ return ""; name ]);
        map (fun s -> Host s) name; map (fun name -> Task (Platform { name; plan = None; task_site = unknown })) name;
        map (fun vs -> Vehicles (List.sort_uniq compare vs)) (list_size (int_bound 3) name);
        map (fun p -> Position p) position;
        map2 circle position (float_range 0. 1e4); map corridor position ]
  in
  let rec value depth =
    if depth = 0 then simple
    else
      let items = list_size (int_bound 3) (value (depth - 1)) in
      let entries keys = flatten_l (List.map (fun k -> map (fun x -> (k, x)) (value (depth - 1))) keys) in
      let key = oneof [ name; oneofl [ "object"; "task"; "map" ] ] in
      let keys = map (List.sort_uniq compare) (list_size (int_bound 3) key) in
      frequency
        [ (3, simple); (1, map (fun xs -> List (Dolphin_semantics.Vector.of_list xs)) items);
          (1, map (fun entries -> Map entries) (keys >>= entries)) ]
  in
  frequency [ (5, map Result.ok (value 2)); (1, map Result.error name) ]

let some_fences =
  lazy
    (reads
       {|fence inside Location.APDL ^ 2.km, margin: 20.m
         fence outside polygon([Location.APDL, location(41.2, -8.7), location(41.2, -8.6)]) & (Location.APDL ^ 900)
         fence depth 12.m
         fence height 120, margin: 1.5
         fence distance 50.feet|})
    .fences

let scenario =
  let open QCheck2.Gen in
  let amount = oneof [ float_range 0.001 1e6; map float_of_int (int_range 1 10_000) ] in
  let share = oneof [ float_range 0. 1.; map (fun n -> float_of_int n /. 100.) (int_range 0 100) ] in
  let place =
    map3
      (fun latitude longitude height : Dolphin_geo.Position.t -> { latitude; longitude; height })
      (float_range (-90.) 90.) (float_range (-180.) 180.) (oneof [ return 0.; float_range (-100.) 100. ]) in
  let several first gen =
    let+ others = list_size (int_bound 2) gen in
    if others = [] then [] else first :: others in
  let drop = map2 (fun from lasts : Scenario.drop -> { from; lasts }) amount amount in
  let vehicle id =
    let* kind = name and* payload = list_size (int_bound 4) name and* position = place in
    let* speed = amount and* battery = share and* drain = share and* charge = share in
    let charger = pair place (float_range 0.5 1e6) in
    let* chargers = if charge > 0. then list_size (int_bound 2) charger else return [] in
    let* joins = oneof [ return 0.; amount ] and* stay = opt amount and* drops = list_size (int_bound 4) drop in
    let* tells_battery = frequencyl [ (4, true); (1, false) ] in
    let* batteries = several battery share and* places = several position place in
    let* shown = list_size (int_range 1 3) amount and* quantity = name in
    (* Fields are sampled in "Temperature" only. *)
    let* shows = oneofl [ []; [ ("Temperature", []) ]; [ ("Temperature", []); ("of " ^ quantity, shown) ] ] in
    let leaves = Option.map (fun stay -> joins +. stay) stay in
    return
      { Scenario.id; kind; payload; position; speed; battery = (if tells_battery then battery else 1.); tells_battery;
        drain; charge; chargers; joins; leaves; drops; batteries = (if tells_battery then batteries else []); shows;
        places }
  in
  let plan name_of_it =
    let* least = amount and* more = oneof [ return 0.; amount ] and* timed = bool in
    let duration = if timed then Some { Scenario.least; most = least +. more } else None in
    let* ending = oneof [ return Scenario.Succeeds; return Scenario.Fails; map (fun n -> Scenario.May_fail n) share ] in
    let* place = opt place and* only = list_size (int_bound 4) name and* charges = opt share in
    return { Scenario.name = name_of_it; duration; ending; place; only; charges } in
  let answer prompt =
    let texts = list_size (int_range 1 3) (oneofl [ "2"; "'x'"; "3.km"; "[1, _]" ]) in
    map (fun texts -> { Scenario.prompt; texts }) texts in
  let distinct entry =
    let* names = list_size (int_bound 4) name in
    flatten_l (List.map entry (List.sort_uniq String.compare names)) in
  let reply call =
    let+ rounds = list_size (int_range 1 3) (list_size (int_range 1 3) one_reply) in
    { Scenario.call; rounds }
  in
  let* vehicles = distinct vehicle and* plans = distinct plan in
  let* answers = distinct answer and* replies = distinct reply in
  let input =
    let datum = oneofl Dolphin_semantics.Core.[ Boolean true; Integer 2; String "x"; List (Dolphin_semantics.Vector.of_list [ Integer 1; Null ]) ] in
    let* key = name and* rounds = list_size (int_range 1 3) (list_size (int_range 1 3) datum) in
    let* times = int_range 1 4 and* after = opt (map float_of_int (int_bound 1000)) in
    return { Scenario.key; rounds; times; after }
  in
  let* inputs = list_size (int_bound 3) input in
  let sample =
    let* value = amount and* place = place and* time = oneof [ return 0.; amount ] in
    return { Scenario.quantity = "Temperature"; value; place; time }
  in
  let* samples = list_size (int_range 1 3) sample in
  let* fences = list_size (int_bound 2) (oneofl (Lazy.force some_fences)) in
  let* plans_at = option place in
  let* zone = option (map (fun n -> 15 * n) (int_range (-56) 56)) in
  let at zone seconds = Dolphin_semantics.Calendar.of_unix ~zone (float_of_int seconds) in
  let* begins = option (map (at (Option.value zone ~default:0)) (int_range (-2_000_000_000) 2_000_000_000)) in
  return { Scenario.vehicles; plans; answers; replies; inputs; samples; fences; plans_at; recurrences = [];
           begins; zone }

(* Fences as JSON, in journals and on maps. *)
let fences_as_json () =
  let again (fence : Dolphin_plans.Fences.fence) =
    let written fence = Dolphin_json.Codec.(to_string Dolphin_json.On_map.fence) fence in
    let read = Dolphin_json.Codec.read Dolphin_json.On_map.fence (Yojson.Safe.from_string (written fence)) in
    Alcotest.(check (result string string)) fence.text (Ok (written fence)) (Result.map written read)
  in
  List.iter again (Lazy.force some_fences)

(* {1 Fields} *)

let field_source =
  {|vehicle 'a', { type 'UUV'; at 41, -8; shows 'T'; shows 'D', 3, 7; shows 'S', 35 }
    vehicle 'b', { type 'UUV'; at 41.002, -8 }
    field 'T', 18, at(41, -8)
    field 'T', 12, at(41.002, -8)
    field 'T', 15, at(41.002, -8), after 100
    field 'D', 5.5, at(41, -8)
    field 'D', 4.5, at(41, -8), after 60|}

let fields () =
  let s = reads field_source in
  let at latitude : Dolphin_geo.Position.t = { latitude; longitude = -8.; height = 0. } in
  let reading v latitude time = Scenario.readings s.samples (List.nth s.vehicles v) (at latitude) ~time in
  let all = Alcotest.(list (pair string (float 1e-6))) in
  Alcotest.check all "at the places" [ ("D", 7.); ("S", 35.); ("T", 18.) ] (reading 0 41. 0.);
  Alcotest.check all "what a vehicle does not measure" [] (reading 1 41. 0.);
  let temperature latitude time = List.assoc "T" (reading 0 latitude time) in
  let number = Alcotest.float 1e-4 in
  Alcotest.check number "at the other place" 12. (temperature 41.002 0.);
  Alcotest.check number "half way" 15. (temperature 41.001 0.);
  Alcotest.check number "a third of the way, the near place counts four times" ((18. *. 4. +. 12.) /. 5.)
    (temperature (41. +. 0.002 /. 3.) 0.);
  Alcotest.check number "half of the time" 13.5 (temperature 41.002 50.);
  Alcotest.check number "later" 15. (temperature 41.002 1000.);
  Alcotest.check number "the nearest of several values" 3. (List.assoc "D" (reading 0 41. 60.));
  Alcotest.check number "changes until then" 100. (Scenario.fields_still_from s)

let shown_scenario s = Fmt.str "%a" Scenario.pp s

(* A fleet with assumptions, which depend on its vehicles. *)
let assuming =
  let open QCheck2.Gen in
  let* s = scenario in
  let condition = oneofl [ "speed(v) > 1.5"; "connected(v)"; "!connected(v)"; "60 < now()"; "!(speed(v) >= 1.5)" ] in
  let entry = map (Printf.sprintf "assume eventually { v -> %s }\n") condition in
  let* entries = list_size (int_range 1 3) entry in
  return (reads (shown_scenario s ^ String.concat "" entries))

let laws =
  [ law "what is written is read back" scenario ~print:shown_scenario (fun s ->
        Scenario.equal s (reads (shown_scenario s)));
    law "assumptions too" assuming ~print:shown_scenario (fun s ->
        let n = List.length s.vehicles and found = List.length s.recurrences in
        found >= min n 1 && Scenario.equal s (reads (shown_scenario s)));
    law "no text makes reading raise"
      QCheck2.Gen.(pair scenario (pair (int_bound 2000) (int_bound 30)))
      ~print:(fun (s, _) -> shown_scenario s)
      (fun (s, (from, length)) ->
         let whole = shown_scenario s in
         let size = String.length whole in
         let from = min from size in
         let after = min size (from + length) in
         let cut = String.sub whole 0 from ^ String.sub whole after (size - after) in
         match Scenario.read ~file:"cut.fleet" cut with Ok _ -> true | Error faults -> faults <> []) ]

let () =
  match Sys.argv with
  | [| _; file |] when Filename.check_suffix file ".fleet" -> print_string (shown ~file (contents file))
  | _ ->
    Alcotest.run "scenario"
      [ ("good", golden "good" true);
        ("bad", golden "bad" false);
        ("fields", [ Alcotest.test_case "by place and time" `Quick fields ]);
        ("fences", [ case "as JSON" fences_as_json ]);
        ( "entries",
          [ case "defaults" defaults; case "default fleet" default_fleet; case "beside a program" beside;
            case "answers" answers; case "replies" replies; case "inputs" inputs; case "places of replies" replies_at;
            case "silences" silences; case "states at the start" states;
            case "who knows a plan" knowing; case "units" units ] );
        ("laws", laws) ]
