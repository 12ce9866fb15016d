(* The choices of the world, by hand: values of sensors, the vehicles that come and their order, and the outcomes of
   lost ones. Each case has labels of some run, and labels of none. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Generate = Test_support.Generate
module Pure_run = Test_support.Pure_run

let pick = "v = pick { id 'a' }\n"

(* All labels of the graph, and the messages of its ends; or the reason why a graph is missing. *)
let labels ?(environment = Environment.default) ?(world = Generate.open_world) source =
  match Reference.explore environment (Pure_run.compile_exn source) world with
  | None -> Alcotest.fail "too many states"
  | Some graph ->
    let label ((t : Transition.t), _) = Format.asprintf "%a" Label.pp t.label in
    List.sort_uniq String.compare (List.concat_map (List.map label) (Array.to_list graph.edges))
  | exception Environment.Unclear fault -> [ "unsettled: " ^ fault.message ]

let happens name ?environment ?world ~some ~none source =
  let check () =
    let found = labels ?environment ?world source in
    let is_there label = List.mem label found in
    let missing = List.filter (fun l -> not (is_there l)) some and there = List.filter is_there none in
    if missing <> [] || there <> [] then
      Alcotest.failf "not in any run: %s; in some run: %s; all: %s" (String.concat ", " missing)
        (String.concat ", " there) (String.concat ", " found)
  in
  Alcotest.test_case name `Quick check

let say condition = Printf.sprintf "%smessage (%s)" pick condition
let both = [ "message 'true'"; "message 'false'" ]

let either name condition = happens name ~some:both ~none:[] (say condition)
let only name result condition =
  happens name (say condition)
    ~some:[ Printf.sprintf "message '%b'" result ]
    ~none:[ Printf.sprintf "message '%b'" (not result) ]

let comparisons n =
  String.concat " || " (List.init n (fun i -> Printf.sprintf "battery(v) == %d" i))

let sensors =
  [ either "less" "battery(v) < 0.3"; either "at least, behind arithmetic" "10 <= battery(v) * 100 - 5";
    either "equal" "battery(v) == 1"; either "by property" "v.battery > 0.5";
    either "rounded" "(battery(v) * 100).round() > Math.floor(20.5)";
    either "two of them" "battery(v) < battery(pick { id 'c' })";
    either "in an area" "position(v) in (Location.APDL ^ 2.km)";
    either "an area around it" "Location.APDL in (position(v) ^ 2.km)";
    either "a coordinate" "position(v).latitude > 41"; either "a distance" "position(v).distance(Location.APDL) < 100";
    either "one of several" "(v + pick { id 'c' }).any { battery(it) < 0.2 }";
    only "the same comparison again" true "(battery(v) < 0.3) == (battery(v) < 0.3)";
    only "the opposite of a comparison" false "battery(v) < 0.3 && battery(v) >= 0.3";
    happens "one of the values that are given" (say "battery(pick { id 'b' })")
      ~some:[ "message '1.0'"; "message '0.2'" ] ~none:[];
    happens "what was shown before is not what is shown now"
      (pick ^ "h = battery(v)\npost x: 1\nif (h < 0.3 && battery(v) >= 0.3) { halt 'charged' }")
      ~some:[ "halt(charged)"; "end" ] ~none:[];
    happens "nor two that were shown before"
      (pick ^ "h = battery(v)\npost x: 1\ni = battery(v)\npost x: 1\nif (h < 0.3 && i >= 0.3) { halt 'charged' }")
      ~some:[ "halt(charged)" ] ~none:[];
    happens "a local of a function"
      (pick ^ "def f(b) { post x: 1; return b < 0.3 && battery(v) >= 0.3 }\nif (f(battery(v))) { halt 'charged' }")
      ~some:[ "halt(charged)"; "end" ] ~none:[];
    happens "a message with what a sensor shows" (say "\"at ${battery(v)}\"") ~some:[ "message 'at battery(a)'" ]
      ~none:[];
    happens "told of, behind words" (say "'at ' + battery(v)") ~some:[ "message 'at battery(a)'" ] ~none:[];
    happens "twelve comparisons in one step" (say (comparisons 12)) ~some:both ~none:[];
    happens "what one handler keeps is not what another one kept"
      (pick
       ^ "h = battery(v)\nexecute watch (watch action { 1 / 0 } onError { if (h < 0.3) { post low: 1; h = battery(v) } }) onError { \
          if (h >= 0.3) { post high: 1 } ; ignore() }\nif (poll(low: 1) && poll(high: 1)) { message 'charged' }")
      ~some:[ "message 'charged'" ] ~none:[];
    happens "what was answered is not what is shown later"
      ~environment:{ Environment.default with answers = (fun _ -> [ [ "battery(v)" ] ]) }
      (pick ^ "h = ask 'level?'\nif (h < 0.3 && battery(v) >= 0.3) { halt 'charged' }")
      ~some:[ "halt(charged)"; "end" ] ~none:[];
    happens "a loop that ends some time" (pick ^ "while (battery(v) > 0.3) { pause 5 }") ~some:[ "pause(5)"; "end" ]
      ~none:[];
    happens "code that waits for a sensor has no end" (pick ^ "execute action { while (battery(v) > 0.3) { } }")
      ~some:[ "act"; "broken(this code does not come to an end, and code inside of a task is atomic)" ] ~none:[] ]

let unsettled ?world name source =
  let check () =
    match labels ?world source with
    | [ why ] when String.length why > 9 && String.sub why 0 9 = "unsettled" -> ()
    | found -> Alcotest.failf "it is told: %s" (String.concat ", " found)
  in
  Alcotest.test_case name `Quick check

(* The outcomes of these cannot be listed. *)
let beyond =
  let rest = pick ^ "p = imcPlan { locate 41, -8; goTo() }\n" in
  let world = World.open_sensor Progress "a" [] Generate.open_world in
  let unsettled_rest = unsettled ~world in
  let decided_rest name result source =
    happens name source ~world ~some:[ Printf.sprintf "message '%b'" result ]
      ~none:[ Printf.sprintf "message '%b'" (not result) ]
  in
  [ unsettled_rest "the length of a rest" (rest ^ "if (p.rest(v).length < 100) { halt 'h' }");
    unsettled_rest "a rest is the plan" (rest ^ "if (p.rest(v) == p) { halt 'h' }");
    unsettled_rest "a rest among plans" (rest ^ "message p in [p.rest(v)]");
    unsettled_rest "a list in a list" (rest ^ "message ([[p.rest(v)]] == [[p]])");
    unsettled_rest "a part of a task" (rest ^ "message ((p.rest(v) >> p) == (p >> p))");
    unsettled_rest "captured by code" (rest ^ "def code(q) { return { q } }\nmessage (code(p.rest(v)) == code(p))");
    unsettled_rest "one that is posted" (rest ^ "post x: p.rest(v)\nmessage consume(x: p)");
    unsettled_rest "one that is polled" (rest ^ "post x: p\nmessage poll(x: p.rest(v))");
    unsettled_rest "lists without it" (rest ^ "message ([p.rest(v)] - [p])");
    unsettled_rest "the order of rests" (rest ^ "message ([p.rest(v), p].sort())");
    unsettled_rest "the greatest rest" (rest ^ "message ([1, 2].max { it == 1 ? p.rest(v) : p })");
    unsettled_rest "one of two that may be equal"
      (rest ^ "post x: [1, p.rest(v)], x: [1, p]\nmessage consume(x: { it[1] != 2 })");
    decided_rest "one that a pattern has chosen" true
      (rest ^ "post x: [1, p.rest(v)], x: [2, p]\nmessage consume(x: { it[0] == 1 })");
    decided_rest "one that no pattern chooses" false (rest ^ "post x: [1, p.rest(v)]\nmessage consume(x: { it[0] == 2 })");
    decided_rest "another plan" false (rest ^ "q = imcPlan { locate 41, -8; goTo() }\nmessage p.rest(v) == q");
    decided_rest "no plan" false (rest ^ "post x: 1\nmessage poll(x: p.rest(v))");
    decided_rest "plans beside it" true (rest ^ "post x: p.rest(v)\npost y: p\nmessage poll(y: p)");
    unsettled "as a truth value" (pick ^ "if (battery(v)) { halt 'h' }");
    unsettled "posted" (pick ^ "post level: battery(v)");
    unsettled "polled" (pick ^ "if (poll(level: battery(v))) { halt 'h' }");
    unsettled "as an index" (pick ^ "xs = [1, 2]\nmessage xs[battery(v)]");
    unsettled "in a list" (pick ^ "xs = [battery(v)]");
    unsettled "as a time" (pick ^ "pause battery(v)");
    unsettled "as a time of a task" (pick ^ "execute during { battery(v) } run idle(1)");
    unsettled "as a divisor" (pick ^ "x = 1 / battery(v)");
    unsettled "in a plan" (pick ^ "p = imcPlan { locate Location.APDL; goTo speed: battery(v) }");
    unsettled "thirteen comparisons in one step" (say (comparisons 13));
    unsettled "an argument that is named" (pick ^ "def f(m) { return m.level < 0.3 }\nmessage f(level: battery(v))");
    unsettled "captured" (pick ^ "def f(b) { return { -> b < 0.3 } }\nf(battery(v))");
    unsettled "the greatest" (pick ^ "w = pick { id 'c' }\nx = (v + w).max { battery(it) }") ]

(* {1 Vehicles} *)

let missing_a =
  "no-vehicles(could not pick 1 vehicle with id 'a': b has another id; c has another id; a is not connected)"
let late limit = { Environment.default with faults = { Faults.none with join = limit }; may_be_late = (fun v -> v <> "a") }
let lossy limit = { Environment.default with faults = { Faults.none with loss = limit } }
let everybody = "v = pick { count _ }"
let closed = Generate.world

let vehicles =
  [ happens "nobody is late" ~world:closed everybody ~some:[ "bind(a, b, c)" ]
      ~none:[ "bind(a)"; "bind(a, b)"; "bind(a, c, b)" ];
    happens "any of those that may be late is late, or missing" ~environment:(late Any_number) ~world:closed everybody
      ~some:[ "bind(a, b, c)"; "bind(a, c, b)"; "bind(a, b)"; "bind(a, c)"; "bind(a)" ]
      ~none:[ "bind(b, c)"; "bind(b, a)"; "bind(b)"; "bind(c)" ];
    happens "one of them is late, or missing" ~environment:(late (At_most 1)) ~world:closed everybody
      ~some:[ "bind(a, b, c)"; "bind(a, c, b)"; "bind(a, b)"; "bind(a, c)" ] ~none:[ "bind(a)" ];
    happens "who comes first is picked" ~environment:(late (At_most 1)) ~world:closed "v = pick { count 2 }"
      ~some:[ "bind(a, b)"; "bind(a, c)"; "bind(b, c)"; "bind(c, b)" ] ~none:[ "bind(b, a)" ];
    happens "the others may be too few" ~environment:(late Any_number) ~world:closed "v = pick { count 2; type 'UUV' }"
      ~some:[ "bind(a, b)";
              "no-vehicles(could not pick 2 vehicles of type 'UUV': a fits; c is a UAV; b is not connected)" ]
      ~none:[];
    happens "one who is late is late for good" ~environment:(late (At_most 1)) ~world:closed
      "v = pick { count _; type 'UUV' }\nif (v.size() == 1) { w = pick { id 'c' } }"
      ~some:[ "bind(a)"; "bind(a, b)"; "bind(c)" ]
      ~none:
        [ "no-vehicles(could not pick 1 vehicle with id 'c': a is already bound; b has another id; c is not \
           connected)" ];
    happens "a loss fails the task" ~environment:(lossy Any_number) ~world:closed (pick ^ "execute task('p')[v]")
      ~some:[ "done(a, p)"; "fail(a, p, connection lost)" ] ~none:[ "fail(a, p, failure)" ];
    happens "a lost vehicle is still bound, may come back, and then fail no more" ~environment:(lossy (At_most 1))
      ~world:closed
      (pick
       ^ "t = watch task('p')[v] onError { post failed: 1; ignore() }\nexecute t\nexecute t\n\
          if (consume(failed: 1) && !poll(failed: 1)) { execute watch task('q')[v] onError { halt 'again' } }")
      ~some:[ "done(a, q)" ] ~none:[ "halt(again)" ];
    happens "while nothing is heard of it, all it does fails" ~environment:(lossy (At_most 1)) ~world:closed
      (pick
       ^ "t = watch task('p')[v] onError { post failed: 1; ignore() }\nexecute t\nexecute t\n\
          if (consume(failed: 1) && consume(failed: 1)) { halt 'twice' }")
      ~some:[ "halt(twice)" ] ~none:[];
    happens "nothing is heard of it when another one is picked" ~environment:(lossy (At_most 1)) ~world:closed
      (pick
       ^ "t = watch task('p')[v] onError { post failed: 1; ignore() }\nexecute t\nw = pick { id 'b' }\nexecute t\n\
          if (consume(failed: 1) && consume(failed: 1)) { halt 'twice' }")
      ~some:[ "halt(twice)" ] ~none:[];
    happens "a lost vehicle that was released may be missing" ~environment:(lossy (At_most 1)) ~world:closed
      (pick
       ^ "execute watch task('p')[v] onError { ignore() }\nrelease v\nw = pick { id 'a' }\nmessage 'there'")
      ~some:[ "message 'there'"; missing_a ]
      ~none:[];
    happens "one that was not lost is not" ~environment:(lossy (At_most 0)) ~world:closed
      (pick ^ "release v\nw = pick { id 'a' }")
      ~some:[ "end" ] ~none:[ missing_a ];
    happens "given positions matter to a pick" "v = pick { id 'c'; region Location.APDL, 1.km }"
      ~some:[ "bind(c)"; "no-vehicles(could not pick 1 vehicle with id 'c' in region (41.185242, -8.704803) ^ 1000 m: \
                          a has another id; b has another id; c is at (41.230264, -8.704803), outside of the region)" ]
      ~none:[] ]

let () =
  Alcotest.run "world" [ ("sensors", sensors); ("beyond comparisons", beyond); ("vehicles", vehicles) ]
