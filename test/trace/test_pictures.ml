open Dolphin_trace

let case name test = Alcotest.test_case name `Quick test

let story journal =
  let builder = Summary.create () in
  let tell line = match Entry.of_string line with Ok entry -> Summary.add builder entry | Error why -> failwith why in
  List.iter tell (Runs.lines journal);
  Summary.finish builder

let contains part whole =
  match Str.search_forward (Str.regexp_string part) whole 0 with _ -> true | exception Not_found -> false

(* {1 Stories} *)

let tasks_of_vehicles () =
  let s = story (Runs.run "watch").journal in
  let show (t : Summary.task) =
    let ending =
      match t.ending with Done -> "done" | Failed why -> why | Stopped -> "stopped" | Unfinished -> "not ended"
    in
    Printf.sprintf "%s %s-%s %s" t.plan (Phrase.time t.from) (Phrase.time t.until) ending
  in
  let of_vehicle (v : Summary.vehicle) = (v.id, List.map show v.tasks) in
  Alcotest.(check (list (pair string (list string))))
    "tasks"
    [ ("noptilus-1", [ "deep_dive 0:00-2:30 plan failed"; "deep_dive 10:00-13:40 plan failed" ]);
      ("noptilus-2", [ "shallow_dive 0:00-10:00 done"; "shallow_dive 10:00-13:40 stopped" ]) ]
    (List.map of_vehicle s.vehicles)

let broken_off () =
  let lines = Runs.lines (Runs.run "rendezvous").journal in
  let s = story (Runs.text (List.filteri (fun i _ -> i < 40) lines)) in
  let unfinished (v : Summary.vehicle) = List.exists (fun (t : Summary.task) -> t.ending = Unfinished) v.tasks in
  Alcotest.(check bool) "tasks that did not end" true (List.exists unfinished s.vehicles);
  Alcotest.(check bool) "it says so" true (contains "the journal breaks off" (Picture.svg s))

(* A run of a day has no more samples than can be seen. *)
let few_samples () =
  let builder = Summary.create () in
  let position : Dolphin_geo.Position.t = { latitude = 41.; longitude = -8.; height = 0. } in
  for i = 0 to 99_999 do
    let state : Dolphin_semantics.World.vehicle_state =
      { id = "v"; kind = "UUV"; payload = []; position; battery = Some (1. -. (float_of_int i /. 1e5)); speed = None; readings = []; connected = true;
        unready = None; cruise = None; drain = None; progress = []; depth = None; altitude = None }
    in
    Summary.add builder (Vehicle { time = float_of_int i; state })
  done;
  let step : Step.t =
    { rules = []; label = "bind(v)"; at = None; choice = 0; allocated = []; bound = [ "v" ]; released = []; posted = [];
      consumed = []; requests = [ Bind [ "v" ] ] }
  in
  Summary.add builder (Transition { time = 1e5; index = 0; step; ways = [] });
  match (Summary.finish builder).vehicles with
  | [ v ] ->
    let n = List.length v.samples in
    if n < 1000 || n > 4097 then Alcotest.failf "%d samples" n;
    Alcotest.(check (float 0.)) "the first" 0. (List.hd v.samples).time;
    Alcotest.(check (float 0.)) "the last" 99_999. (List.nth v.samples (n - 1)).time
  | _ -> Alcotest.fail "one vehicle is expected"

(* {1 Pictures} *)

let is_self_contained name text =
  let without own text = Str.global_replace (Str.regexp_string own) "" text in
  (* The content of the picture itself. *)
  let text = without "url(#chart)" (without "http://www.w3.org/2000/svg" text) in
  let foreign = List.filter (fun part -> contains part text) [ "http"; "url("; "@import"; "<script" ] in
  if foreign <> [] then Alcotest.failf "%s has %s" name (String.concat ", " foreign)

(* The two of the page itself, which name no other file. *)
let without_own_scripts page =
  List.fold_left
    (fun page tag -> Str.global_replace (Str.regexp_string tag) "" page)
    page
    [ "<script>"; {|<script type="application/json" id="run">|}; {|"http://www.w3.org/2000/svg"|} ]

let of_all_examples () =
  let draw name =
    let s = story (Runs.run name).journal in
    is_self_contained name (Picture.svg s);
    is_self_contained name (without_own_scripts (Picture.html s))
  in
  List.iter draw Runs.examples

(* Names and messages are escaped. *)
let escaped () =
  let s = story (Runs.of_text "message '<script>alert(1)</script> & \"so\"'").journal in
  Alcotest.(check bool) "escaped" false (contains "<script" (without_own_scripts (Picture.html s)));
  Alcotest.(check bool) "there" true (contains "&lt;script&gt;" (Picture.svg s))

let header ~platform : Header.t =
  { program = Header.source ~path:"mission.dol" ""; fleet = None; platform; order = By_hearing; seed = 7;
    speed = None;
    started = "2026-03-01T12:00:00Z"; run = None; fences = []; place = None; begins = None }

(* Areas are lines of the map, with their meaning below it; the pointer shows their declarations. *)
let fences () =
  let area metres = Result.get_ok (Dolphin_geo.Area.circle { latitude = 41.; longitude = -8.; height = 0. } metres) in
  let fence rule text : Dolphin_plans.Fences.fence =
    { rule; margin = 0.; text; at = Dolphin_syntax.Location.none } in
  let picture fences =
    let builder = Summary.create () in
    let h = { (header ~platform:"imc") with fences } in
    Summary.add builder (Header (Result.get_ok (Header.of_json (Header.to_json h))));
    let see time latitude =
      let position : Dolphin_geo.Position.t = { latitude; longitude = -8.; height = 0. } in
      let state : Dolphin_semantics.World.vehicle_state =
        { id = "v"; kind = "UUV"; payload = []; position; battery = None; speed = None; readings = []; connected = true;
          unready = None; cruise = None; drain = None; progress = []; depth = None; altitude = None } in
      Summary.add builder (Vehicle { time; state })
    in
    see 0. 41.;
    let step : Step.t =
      { rules = []; label = "bind(v)"; at = None; choice = 0; allocated = []; bound = [ "v" ]; released = [];
        posted = []; consumed = []; requests = [ Bind [ "v" ] ] }
    in
    Summary.add builder (Transition { time = 0.; index = 0; step; ways = [] });
    see 10. 41.001;
    Picture.svg (Summary.finish builder)
  in
  let has what picture = Alcotest.(check bool) what true (contains what picture) in
  let without = picture [ fence (Depth 12.) "fence depth 12.m" ] in
  Alcotest.(check bool) "no line for a depth" false (contains "class=\"fence" without);
  let inside = picture [ fence (Inside (area 100.)) "fence inside basin" ] in
  List.iter (fun what -> has what inside) [ "class=\"fence\""; "<title>fence inside basin</title>"; "stay inside" ];
  Alcotest.(check bool) "nothing to stay out of" false (contains "stay outside" inside);
  let outside = picture [ fence (Outside (area 20.)) "fence outside rock" ] in
  List.iter (fun what -> has what outside) [ "class=\"fence no-go\""; "stay outside" ];
  let scale_of picture = contains "50 m" picture in
  Alcotest.(check bool) "one that is far wider leaves the map as it is" (scale_of without)
    (scale_of (picture [ fence (Inside (area 50_000.)) "fence inside sea" ]))

let circumstances () =
  let head platform =
    let builder = Summary.create () in
    Summary.add builder (Header (header ~platform));
    Picture.svg (Summary.finish builder)
  in
  Alcotest.(check bool) "a simulation" true (contains "simulated: the built-in fleet  ·  seed 7" (head "sim"));
  Alcotest.(check bool) "a network" true (contains "vehicles of a network (IMC)  ·  2026" (head "imc"));
  Alcotest.(check bool) "has no seed" false (contains "seed" (head "imc"))

(* A vehicle of a network that has not reported its battery yet. *)
let unknown_batteries () =
  let battery_axis at_first =
    let builder = Summary.create () in
    Summary.add builder (Header (header ~platform:"imc"));
    let position : Dolphin_geo.Position.t = { latitude = 41.; longitude = -8.; height = 0. } in
    let see time battery =
      let state : Dolphin_semantics.World.vehicle_state =
        { id = "v"; kind = "UUV"; payload = []; position; battery; speed = None; readings = []; connected = true;
          unready = None; cruise = None; drain = None; progress = []; depth = None; altitude = None } in
      Summary.add builder (Vehicle { time; state })
    in
    see 0. at_first;
    see 5. (Some 0.6);
    see 10. (Some 0.59);
    let step : Step.t =
      { rules = []; label = "bind(v)"; at = None; choice = 0; allocated = []; bound = [ "v" ]; released = [];
        posted = []; consumed = []; requests = [ Bind [ "v" ] ] }
    in
    Summary.add builder (Transition { time = 10.; index = 0; step; ways = [] });
    contains ">100%<" (Picture.svg (Summary.finish builder))
  in
  Alcotest.(check bool) "full at first" true (battery_axis (Some 1.));
  Alcotest.(check bool) "not told at first" false (battery_axis None)

let bind vs : Step.t =
  { rules = []; label = "bind"; at = None; choice = 0; allocated = []; bound = vs; released = []; posted = [];
    consumed = []; requests = [ Bind vs ] }

(* Thirty vehicles lie on one another, and each has its name on the map, one below the other. *)
let many_names () =
  let picture count =
    let builder = Summary.create () and vs = List.init count (Printf.sprintf "v%d") in
    let see id =
      let position : Dolphin_geo.Position.t = { latitude = 41.; longitude = -8.; height = 0. } in
      let state : Dolphin_semantics.World.vehicle_state =
        { id; kind = "UUV"; payload = []; position; battery = None; speed = None; readings = []; connected = true;
          unready = None; cruise = None; drain = None; progress = []; depth = None; altitude = None } in
      Summary.add builder (Vehicle { time = 0.; state })
    in
    List.iter see vs;
    Summary.add builder (Transition { time = 9.; index = 0; step = bind vs; ways = [] });
    Picture.svg (Summary.finish builder)
  in
  let named count =
    let svg = picture count in
    let rec names from found =
      match Str.search_forward (Str.regexp "name on-map [^>]* y=\"\\([0-9.]+\\)\"") svg from with
      | at -> names (at + 1) (float_of_string (Str.matched_group 1 svg) :: found)
      | exception Not_found -> List.sort Float.compare found
    in
    names 0 []
  in
  let rec apart = function a :: (b :: _ as rest) -> b -. a >= 12.9 && apart rest | [ _ ] | [] -> true in
  let check = Alcotest.(check int) in
  Alcotest.(check bool) "lines to those that had to move" true (contains "leader" (picture 30));
  check "two" 2 (List.length (named 2));
  check "thirty" 30 (List.length (named 30));
  check "sixty" 60 (List.length (named 60));
  check "too many" 0 (List.length (named 61));
  Alcotest.(check bool) "none on another" true (apart (named 60))

(* A run that was found, not flown, has steps where times would be. *)
let by_steps () =
  let builder = Summary.create ~clock:Steps () in
  Summary.add builder (Header { (header ~platform:"sim") with started = "" });
  let start : Step.t = { (bind [ "v" ]) with requests = [ Bind [ "v" ]; Start { vehicle = "v"; plan = "survey" } ] } in
  Summary.add builder (Transition { time = 3.; index = 0; step = start; ways = [] });
  Summary.add builder (End { time = 12.; transitions = 12; ending = { how = "counterexample"; message = Some "why" } });
  let svg = Picture.svg (Summary.finish builder) in
  let is_there text = Alcotest.(check bool) text true (contains text svg) in
  List.iter is_there
    [ "12 steps, without times"; "v runs survey from step 3 to step 12"; "counterexample: why"; ">12<" ];
  Alcotest.(check bool) "no seed, no clock" false (contains "seed" svg || contains "0:0" svg)

(* Of two tasks of the simulator, one described by the program and one that has only a name. *)
let ways_of ~platform =
  let builder = Summary.create () in
  Summary.add builder (Header (header ~platform));
  let see time =
    let position : Dolphin_geo.Position.t = { latitude = 41. +. (time /. 1e4); longitude = -8.; height = 0. } in
    let state : Dolphin_semantics.World.vehicle_state =
      { id = "v"; kind = "UUV"; payload = []; position; battery = None; connected = true; unready = None;
        cruise = None; drain = None; progress = []; depth = None; altitude = None; speed = None;
        readings = [] } in
    Summary.add builder (Vehicle { time; state })
  in
  let start time plan ways =
    let step = { (bind [ "v" ]) with requests = [ Request.Bind [ "v" ]; Start { vehicle = "v"; plan } ] } in
    Summary.add builder (Transition { time; index = 0; step; ways })
  in
  let at longitude : Dolphin_geo.Position.t = { latitude = 41.; longitude; height = 0. } in
  List.iter see [ 0.; 1. ];
  start 2. "described" [ ("v", Entry.Path [ at (-8.); at (-8.001) ]) ];
  List.iter see [ 3.; 6. ];
  start 6. "named" [ ("v", Entry.By_name) ];
  List.iter see [ 8.; 10. ];
  Picture.svg (Summary.finish builder)

let planned_and_invented () =
  let check text expected svg = Alcotest.(check bool) text expected (contains text svg) in
  let planned = {|<polyline class="planned v0"|} and invented = {|<polyline class="track invented v0"|} in
  let flown = {|<polyline class="track v0"|} and told = "invented by the simulator" in
  let simulated = ways_of ~platform:"sim" and real = ways_of ~platform:"imc" in
  List.iter (fun text -> check text true simulated) [ planned; invented; flown; told; ">planned<"; ">flown<" ];
  List.iter (fun text -> check text true real) [ planned; flown; ">planned<" ];
  List.iter (fun text -> check text false real) [ invented; told ];
  (* Journals without this data have no legend. *)
  let silent = story (Runs.run "watch").journal in
  let untold (t : Summary.task) = { t with way = None } in
  let without (v : Summary.vehicle) = { v with tasks = List.map untold v.tasks } in
  let silent = { silent with vehicles = List.map without silent.vehicles } in
  List.iter (fun text -> check text false (Picture.svg silent)) [ planned; invented; told; ">planned<" ]

(* Bars that are too narrow for their names have them below: together where they are near to each other, apart where
   not, and at the right edge before it. *)
let narrow_bars () =
  let builder = Summary.create () in
  Summary.add builder (Header (header ~platform:"sim"));
  let request time requests =
    Summary.add builder (Transition { time; index = 0; step = { (bind [ "v" ]) with requests }; ways = [] }) in
  let run from until plan =
    request from [ Request.Start { vehicle = "v"; plan } ];
    request until [ Request.Stop "v" ]
  in
  request 0. [ Bind [ "v" ] ];
  run 1. 2. "first";
  run 3. 4. "se<ond";
  run 5. 400. "a long survey";
  run 500. 501. "in-between";
  run 998. 999. "last";
  request 1000. [];
  let drawn = Picture.svg (Summary.finish builder) in
  let labels name =
    let rec from i =
      match Str.search_forward (Str.regexp (Printf.sprintf "class=\"%s[^>]*><title>[^<]*</title>\\([^<]*\\)<" name)) drawn i with
      | found -> let text = Str.matched_group 1 drawn in text :: from (found + 1)
      | exception Not_found -> []
    in
    from 0
  in
  Alcotest.(check (list string)) "below" [ "first, se&lt;ond"; "in-between"; "last" ] (labels "name below");
  Alcotest.(check (list string)) "within" [ "a long survey" ] (labels "within")

let nothing_at_all () = ignore (Picture.svg (Summary.finish (Summary.create ())))

(* {1 Scales} *)

(* {1 Pages} *)

(* Of vehicles with these names, at these heights, each with a task from 1 s to 5 s. *)
let of_vehicles ?(platform = "imc") vehicles =
  let builder = Summary.create () in
  Summary.add builder (Header (header ~platform));
  let see time (id, height) =
    let position : Dolphin_geo.Position.t = { latitude = 41. +. (time /. 1e4); longitude = -8.; height } in
    let state : Dolphin_semantics.World.vehicle_state =
      { id; kind = "UUV"; payload = []; position; battery = Some 0.5; speed = None; readings = [];
        connected = true; unready = None; cruise = None;
        drain = None; progress = []; depth = None; altitude = None } in
    Summary.add builder (Vehicle { time; state })
  in
  let transition time requests =
    let step = { (bind (List.map fst vehicles)) with requests } in
    Summary.add builder (Transition { time; index = 0; step; ways = [] })
  in
  List.iter (see 0.) vehicles;
  transition 1. (Bind (List.map fst vehicles) :: List.map (fun (v, _) -> Request.Start { vehicle = v; plan = "p" }) vehicles);
  List.iter (see 5.) vehicles;
  transition 10. [];
  Summary.finish builder

let known page =
  let tag = {|<script type="application/json" id="run">|} in
  let from = Str.search_forward (Str.regexp_string tag) page 0 + String.length tag in
  Yojson.Safe.from_string (String.sub page from (Str.search_forward (Str.regexp_string "</script>") page from - from))

(* For any vehicle name, the script of the page reads its places and tasks. *)
let followed () =
  let page = Picture.html (of_vehicles [ ("v10", 0.); ("</script><b>", 0.); ("v2", 0.) ]) in
  let open Yojson.Safe.Util in
  let vehicles = known page |> member "vehicles" |> to_list in
  Alcotest.(check (list string)) "vehicles" [ "v10"; "</script><b>"; "v2" ]
    (List.map (fun v -> v |> member "name" |> to_string) vehicles);
  let times v = List.map (fun m -> to_number (index 0 m)) (v |> member "moments" |> to_list) in
  Alcotest.(check (list (float 0.))) "moments" [ 0.; 5. ] (times (List.hd vehicles));
  let task v = List.map (fun t -> (to_number (index 0 t), to_number (index 1 t))) (v |> member "tasks" |> to_list) in
  Alcotest.(check (list (pair (float 0.) (float 0.)))) "tasks" [ (1., 10.) ] (task (List.hd vehicles));
  let rec legend from found =
    match Str.search_forward (Str.regexp {|data-vehicle="\([0-9]+\)"|}) page from with
    | at -> legend (at + 1) (Str.matched_group 1 page :: found)
    | exception Not_found -> List.rev found
  in
  Alcotest.(check (list string)) "the legend is sorted, numbers as numbers" [ "1"; "2"; "0" ] (legend 0 []);
  List.iter
    (fun i -> Alcotest.(check bool) "each in its group" true (contains (Printf.sprintf {|class="who w%d"|} i) page))
    [ 0; 1; 2 ]

let heights () =
  let has_heights vehicles = contains ">Heights" (Picture.svg (of_vehicles vehicles)) in
  Alcotest.(check bool) "a diver" true (has_heights [ ("a", 0.); ("b", -12.) ]);
  Alcotest.(check bool) "all on the surface" false (has_heights [ ("a", 0.2); ("b", -0.1) ])

let on_the_wall () =
  let has_clock platform = contains ">12:00:10<" (Picture.svg (of_vehicles ~platform [ ("a", 0.) ])) in
  Alcotest.(check bool) "of a network" true (has_clock "imc");
  Alcotest.(check bool) "not of a simulation in no time" false (has_clock "sim")

let scales () =
  let close = Alcotest.float 1e-9 in
  Alcotest.check close "a step" 0.2 (Scale.step ~most:5 1.);
  Alcotest.check close "a step above one" 50. (Scale.step ~most:5 210.);
  Alcotest.check close "a clock's step" 120. (Scale.time_step ~most:12 1124.);
  Alcotest.(check (list close)) "multiples" [ -0.2; 0.; 0.2 ] (Scale.multiples 0.2 ~from:(-0.3) ~until:0.3);
  Alcotest.(check int) "decimals" 3 (Scale.decimals 0.005);
  Alcotest.(check int) "no decimals" 0 (Scale.decimals 20.);
  Alcotest.(check (list (pair close string))) "labels move apart" [ (0., "a"); (10., "b"); (20., "c") ]
    (Scale.spread ~least:10. ~from:0. ~until:100. [ (1., "b"); (2., "c"); (-3., "a") ]);
  Alcotest.(check (list (pair close string))) "and stay within" [ (80., "a"); (90., "b"); (100., "c") ]
    (Scale.spread ~least:10. ~from:0. ~until:100. [ (99., "a"); (99., "b"); (99., "c") ])

let () =
  Alcotest.run "pictures"
    [ ( "pictures",
        [ case "who ran what" tasks_of_vehicles;
          case "a run that breaks off" broken_off;
          case "long runs have few samples" few_samples;
          case "all examples, without anything from outside" of_all_examples;
          case "texts are escaped" escaped;
          case "where it ran" circumstances;
          case "fences" fences;
          case "batteries that are not known yet" unknown_batteries;
          case "names of many vehicles" many_names;
          case "pages that follow vehicles" followed;
          case "heights" heights;
          case "clocks on the wall" on_the_wall;
          case "runs without times" by_steps;
          case "planned ways and those that nobody knows" planned_and_invented;
          case "names of narrow bars" narrow_bars;
          case "an empty story" nothing_at_all;
          case "scales" scales ] ) ]
