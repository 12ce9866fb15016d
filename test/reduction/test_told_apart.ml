(* Programs that distinguish interchangeable vehicles, each in another way, and find something only with one that is
   not picked first; and programs that do not, which must be explored with few states however large the fleet is. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let uuv = Pure_run.vehicle
let uav = Pure_run.vehicle ~kind:"UAV"
let three = Pure_run.world [ uuv "a"; uuv "b"; uuv "c" ]
let list (xs : Core.value list) : Core.value = List (Vector.of_list xs)
let plain = Environment.default
let property = Alcotest.testable Property.pp ( = )

let finds name ?(environment = plain) ?(world = three) ~exchanged expected text () =
  match Agreement.check_peers ~limit:5_000 environment (Pure_run.compile_exn text) world with
  | Error what -> Alcotest.fail what
  | Ok None -> Alcotest.fail "too large"
  | Ok (Some (found, used)) ->
    Alcotest.(check (list property)) name expected found.broken;
    Alcotest.(check bool) "some are exchanged" exchanged used

let tells name ?environment ?world expected text =
  Alcotest.test_case name `Quick (finds name ?environment ?world ~exchanged:false expected text)

(* The program distinguishes some vehicles and not others, or their tasks but not their names. *)
let keeps name ?environment ?world expected text =
  Alcotest.test_case name `Quick (finds name ?environment ?world ~exchanged:true expected text)

let one = "v = pick { type 'UUV' }\n"
let answering answers = { plain with answers }

let by_name =
  [
    tells "an id" [ No_halt ] (one ^ "if (v.getId() == 'C'.toLowerCase()) { halt 'h' }");
    tells "a property" [ No_halt ] (one ^ "if (v.id == 'C'.toLowerCase()) { halt 'h' }");
    tells "a text" [ No_halt ] (one ^ {|if ("${v}" == 'C'.toLowerCase()) { halt 'h' }|});
    tells "a text by +" [ No_halt ] (one ^ {|if (('' + v) == 'C'.toLowerCase()) { halt 'h' }|});
    tells "a text of a list" [ No_halt ] (one ^ {|if ([v].join('') == 'C'.toLowerCase()) { halt 'h' }|});
    tells "a text of a task" [ No_halt ]
      (one ^ {|if ("${task('p')[v]}".contains('C'.toLowerCase())) { halt 'h' }|});
    tells "a text in a function" [ No_halt ]
      ("def name(x) { return \"${x}\" }\n" ^ one ^ {|if (name(v) == 'C'.toLowerCase()) { halt 'h' }|});
    tells "a text in a closure" [ No_halt ]
      (one ^ {|if (v.any { u -> u.toString() == 'C'.toLowerCase() }) { halt 'h' }|});
    tells "a text in an action" [ No_halt ]
      (one ^ {|execute action { if ("${v}" == 'C'.toLowerCase()) { halt 'h' } }|});
    tells "a key of a map" [ No_halt ] (one ^ "m = [:]\nm[v] = 1\nif (m.containsKey('c')) { halt 'h' }");
    tells "a key of a map that is written down" [ No_halt ]
      (one ^ "m = [(v): 1]\nif (m['C'.toLowerCase()] == 1) { halt 'h' }");
    tells "a key to look for" [ No_halt ] (one ^ "if (['ab', 'c'].contains(v.id)) { halt 'h' }");
    tells "a key that a map has" [ No_halt ] (one ^ "m = [c: 1]\nif (v in m) { halt 'h' }");
    tells "an element of a map" [ No_halt ] (one ^ "m = [c: 1]\nif (m[v] == 1) { halt 'h' }");
    tells "an element of a map, by get" [ No_halt ] (one ^ "m = [c: 1]\nif (m.get(v) == 1) { halt 'h' }");
    tells "the order of names" [ No_halt ]
      (one ^ "w = pick { type 'UUV' }\nif ([v, w].sort()[0] == w) { halt 'h' }");
    tells "the order of names, in a closure" [ No_halt ]
      (one ^ "w = pick { type 'UUV' }\nif ([v, w].max { u -> u } == v) { halt 'h' }");
    tells "a question" [ No_halt ]
      ~environment:(answering (fun prompt -> [ [ (if prompt = "who is c" then "1" else "0") ] ]))
      (one ^ {|if (ask("who is ${v}") == 1) { halt 'h' }|});
    tells "an answer" [ No_halt ] ~environment:(answering (fun _ -> [ [ "v.id == 'c'" ] ]))
      (one ^ "if (ask('h')) { halt 'h' }");
    keeps "a text of a number, in a function that is only called by its name" []
      ("def each(vs, make) { return vs.collect { u -> make(u) } }\ndef count(n) { return \"${n}\" }\n" ^ one
       ^ "each(v) { u -> 1 }\nif (count(3) == 'C'.toLowerCase()) { halt 'h' }");
    tells "a text in a function that is called as a value" [ No_halt ]
      ("def each(vs, make) { return vs.collect { u -> make(u) } }\ndef name(x) { return \"${x}\" }\n" ^ one
       ^ "if (each(v, name)[0] == 'C'.toLowerCase()) { halt 'h' }");
    tells "an error's text" [ No_error; No_halt ]
      ~environment:(Environment.failing plain)
      (one
       ^ "execute watch task('p')[v] onError { if (it == 'p failed on C: failure'.replace('C', 'c')) { halt 'h' } }");
    tells "an error's text, later" [ No_error; No_halt ]
      ~environment:(Environment.failing plain)
      (one
       ^ "e = ''\nexecute watch (watch task('p')[v] onError { e = it }) onError {\nif (e.contains('C'.toLowerCase() + ':')) { halt 'h' } }");
    keeps "a name in the program" [ Vehicles ] (one ^ "w = pick { id 'c'; timeout 1.seconds }");
    keeps "a name that is computed" [ Vehicles ] (one ^ "w = pick { id 'C'.toLowerCase(); timeout 1.seconds }");
    keeps "a plan for a vehicle" [ Allocation ]
      (one ^ "execute imcPlan { planName 'i'; vehicles 'c'; locate 41.1852, -8.7048; goTo speed:1.0 }");
    tells "a plan for a vehicle that is computed" [ Allocation ]
      (one ^ "execute imcPlan { planName 'i'; vehicles 'C'.toLowerCase(); locate 41.1852, -8.7048; goTo speed:1.0 }");
    tells "a plan for a vehicle that was picked" [ ]
      (one ^ "execute imcPlan { planName 'i'; vehicles v; locate 41.1852, -8.7048; goTo speed:1.0 }");
  ]

let late join : Environment.options = { plain with faults = { Faults.none with join }; may_be_late = (fun _ -> true) }
let near_and_far = Pure_run.world [ uuv "a" ~north:5_000.; uuv "b"; uuv "c"; uuv "d" ]
let open_alike = World.open_battery "c" [] (World.open_battery "b" [] three)
let weak = Pure_run.world [ uuv "a"; uuv "b"; uuv "c" ~battery:0.2 ]

let slow = { (uuv "c") with cruise = Some 0.5; drain = Some 0.5 }
let able id = { (uuv id) with cruise = Some 2.; drain = Some 0.1 }
let of_two_speeds = Pure_run.world [ able "a"; able "b"; slow ]
let there = "location(41.1951, -8.7048)"

let warm =
  Pure_run.world [ uuv "a" ~readings:[ ("T", 12.) ]; uuv "b" ~readings:[ ("T", 12.) ]; uuv "c" ~readings:[ ("T", 18.) ] ]

let silent = Pure_run.world [ uuv "a" ~readings:[ ("T", 12.) ]; uuv "b" ~readings:[ ("T", 12.) ]; uuv "c" ]

let by_what_they_are =
  [
    keeps "how fast it is" ~world:of_two_speeds [ No_halt ]
      (one ^ Printf.sprintf "if (eta(v, %s) > 1_000) { halt 'h' }" there);
    keeps "how long a plan takes it" ~world:of_two_speeds [ No_halt ]
      (one ^ Printf.sprintf "p = imcPlan { locate %s; goTo() }\nif (p.duration(v) > 1_000) { halt 'h' }" there);
    keeps "what a plan takes of its battery" ~world:of_two_speeds [ No_halt ]
      (one ^ Printf.sprintf "p = imcPlan { locate %s; goTo() }\nif (p.energy(v) > 5.percent) { halt 'h' }" there);
    keeps "how far a plan takes it" ~world:near_and_far [ No_halt ]
      (one ^ Printf.sprintf "p = imcPlan { locate %s; goTo() }\nif (p.length(v) > 3_000) { halt 'h' }" there);
    keeps "speeds that nobody asks for" ~world:of_two_speeds []
      (one ^ Printf.sprintf "p = imcPlan { locate %s; goTo() }\nexecute p" there);
    keeps "a battery" ~world:weak [ No_halt ] (one ^ "if (battery(v) < 0.5) { halt 'h' }");
    keeps "a battery, by a method" ~world:weak [ No_halt ] (one ^ "if (v.getBattery() < 0.5) { halt 'h' }");
    keeps "a battery that is open" ~world:(World.open_battery "c" [ 0.2; 1. ] three) [ No_halt ]
      (one ^ "if (battery(v) < 0.5) { halt 'h' }");
    keeps "batteries that are open alike" ~world:open_alike [ No_halt ]
      (one ^ "w = pick { type 'UUV' }\nif (battery(v) < 0.5 && battery(w) > 0.5) { halt 'h' }");
    tells "batteries that are open alike, put into a text" ~world:open_alike []
      (one ^ {|x = "${battery(v)}"|});
    keeps "a link" ~world:(World.open_sensor Connected "c" [ Boolean true; Boolean false ] three) [ No_halt ]
      (one ^ "if (!connected(v)) { halt 'h' }");
    keeps "a speed" ~world:(World.open_sensor Speed "c" [ Number 2. ] three) [ No_halt ]
      (one ^ "if (speed(v) > 1) { halt 'h' }");
    keeps "a measurement" ~world:warm [ No_halt ] (one ^ "if (reading(v, 'T') > 15) { halt 'h' }");
    keeps "a measurement that one does not tell" ~world:silent [ No_halt ]
      (one ^ "if ((reading(v, 'T') ?: 20) > 15) { halt 'h' }");
    keeps "batteries that nobody looks at" ~world:weak [] (one ^ "execute task('p')[v]");
    keeps "places that nobody looks at" ~world:near_and_far [] (one ^ "execute task('p')[v]");
    keeps "a place" ~world:near_and_far [ No_halt ]
      (one ^ "if (position(v) in area(location(41.1851, -8.7048), 10.km)) { } else { halt 'h' }\n\
              if (v.getPosition().distance(position(v)) > 0) { halt 'h' }\n\
              if (position(v).latitude > 41.2) { halt 'far' }");
    keeps "a region" ~world:near_and_far [ Vehicles ]
      ("w = pick { count 3; type 'UUV' }\nv = pick { region location(41.1851, -8.7048), 1.km; timeout 1.seconds }");
    keeps "a distance" ~world:near_and_far ~environment:{ plain with faults = { Faults.none with loss = At_most 1 } } [ Vehicles ]
      {|team = pick { count 2; type 'UUV' }
        w = pick { count 2; type 'UUV' }
        execute watch imcPlan { planName 'i'; locate 41.1851, -8.7048; goTo speed:1.0 }[team] onError { ignore() }
        release team[0]
        v = pick { type 'UUV'; timeout 1.seconds }|};
    keeps "payload" ~world:(Pure_run.world [ uuv "a"; uuv "b"; uuv "c" ~payload:[ "Multibeam" ] ]) [ Vehicles ]
      (one ^ "w = pick { payload 'Multibeam'; timeout 1.seconds }");
    keeps "type" ~world:(Pure_run.world [ uuv "a"; uuv "b"; uav "c" ]) [ No_halt ]
      "v = pick { count 1 }\nif (v.getType() == 'UAV') { halt 'h' }";
    keeps "a plan that fails on one"
      ~environment:{ plain with endings = (fun v _ -> if v = "c" then Fails else Succeeds) }
      [ No_error ] (one ^ "execute task('p')[v]");
    keeps "a plan that fails on one, with a name that is computed"
      ~environment:{ plain with endings = (fun v p -> if v = "c" && p = "p" then Fails else Succeeds) }
      [ No_error ] (one ^ "execute task('P'.toLowerCase())[v]");
    keeps "one that may be late"
      ~environment:{ plain with faults = { Faults.none with join = At_most 1 }; may_be_late = (fun v -> v = "a") }
      [ Vehicles ] (one ^ "w = pick { count 2; type 'UUV'; timeout 1.seconds }");
  ]

let on_c plan ending : Environment.options =
  let endings v p = if v = "c" && p = plan then ending else Environment.Succeeds in
  { plain with endings; plans = [ plan ] }

let handing = one ^ "post who: v\nexecute waitFor { consume who: _ } then "

(* Tasks that are made at their turn. *)
let by_what_is_made =
  [
    keeps "a task made for it" [] (one ^ "execute ({ task('p') })[v]");
    keeps "a task made for any" [] (one ^ "execute { task('p') | idle(1) }");
    keeps "a plan that fails on one, made for it" ~environment:(on_c "p" Fails) [ No_error ]
      (one ^ "execute ({ task('P'.toLowerCase()) })[v]");
    keeps "any plan fails on one" ~environment:{ plain with endings = (fun v _ -> if v = "c" then Fails else Succeeds) }
      [ No_error ] "v = pick { count 1 }\nexecute ({ task(\"${1}\") })[v]";
    keeps "a plan that a handler gives fails on one"
      ~environment:{ (on_c "p" Fails) with endings = (fun v p -> if p = "q" || v = "c" then Fails else Succeeds);
                                           plans = [ "p"; "q" ] }
      [ No_error ] (one ^ "execute watch task('q')[v] onError { e -> task('P'.toLowerCase()) }");
    keeps "who was taken" [ No_halt ]
      (handing ^ "{ u -> action { if (u == v) { halt 'h' } } }");
    tells "the name of who was taken" [ No_halt ]
      (handing ^ "{ u -> action { if (\"$u\" == 'C'.toLowerCase()) { halt 'h' } } }");
    tells "the name of who was taken, by a function" [ No_error; No_halt ]
      ("def f(u) { if (u.id == 'C'.toLowerCase()) { fail 'x' }\ntask('p')[u] }\ng = f\n"
       ^ handing ^ "g\nhalt 'h'");
    tells "a plan with the name of who was taken" ~environment:{ (on_c "pc" Fails) with plans = [ "pc" ] } [ No_error ]
      (handing ^ "{ u -> task(\"p$u\")[u] }");
    keeps "who is idle" [ No_deadlock; No_halt ]
      (one ^ "execute ({ task('p') })[v] | (waitFor { idle(v).isEmpty() } then action { halt 'h' })");
    keeps "who runs" [ No_deadlock; No_halt ]
      (one ^ "execute task('p')[v] | (waitFor { running(v) } then action { halt 'h' })");
    tells "the name of who is idle" [ No_halt ]
      (one ^ "execute action { if (idle(v).ids == ['C'.toLowerCase()]) { halt 'h' } }");
    tells "the name of who failed" ~environment:(Environment.failing plain) [ No_halt ]
      (one ^ "execute watch task('p')[v] onError { e -> if (e.vehicle.id == 'C'.toLowerCase()) { halt 'h' }\nidle(1) }");
  ]

(* [v] was there before, and may be recruited, or another one: the part that knows it prints [h] for one of the two. *)
let before = "v = pick { type 'UUV' }\nrelease v\n"
let posting = "recruit { type 'UUV' } then { u -> action { post at: u } }"

let by_recruits =
  [
    keeps "whoever is recruited" [] "execute recruit { type 'UUV' } then { v -> task('p') }";
    tells "the name of who is recruited" [ No_halt ]
      "execute recruit { type 'UUV' } then { v -> action { if (\"$v\" == 'C'.toLowerCase()) { halt 'h' } } }";
    tells "a plan with the name of who is recruited" ~environment:{ (on_c "pc" Fails) with plans = [ "pc" ] } [ No_error ]
      "execute recruit { type 'UUV' } then { v -> task(\"p$v\") }";
    keeps "a plan that fails on one who is recruited" ~environment:(on_c "p" Fails) [ No_error ]
      "execute recruit { type 'UUV' } then { v -> task('P'.toLowerCase()) }";
    keeps "a name to recruit" [ No_deadlock ] (one ^ "execute recruit { id 'c' } then { u -> task('p') }");
    keeps "a name to recruit that is computed" [ No_deadlock ]
      (one ^ "execute recruit { id 'C'.toLowerCase() } then { u -> task('p') }");
    keeps "a name to recruit that is computed, later" [ No_deadlock ]
      (one ^ "execute idle(1) >> { recruit { id 'C'.toLowerCase() } then { u -> task('p') } }");
    keeps "a region to recruit from" ~world:near_and_far [ No_deadlock ]
      "execute recruit { region location(41.1851, -8.7048), 1.km } then { u ->\n\
       if (position(u) in area(location(41.1851, -8.7048), 10.km)) task('p') else condition { false } }\n\
       v = pick { count 3; type 'UUV' }\n\
       execute recruit { region location(41.1851, -8.7048), 1.km } then { u -> task('p') }";
    keeps "another than who is in a variable" [ No_halt ]
      (before ^ "execute recruit { type 'UUV' } then { u -> action { if (u != v) { halt 'h' } } }");
    keeps "another than who is in N" [ No_halt ]
      (before ^ "post at: v\nv = null\n\
                 execute recruit { type 'UUV' } then { u -> action { if (!consume(at: u)) { halt 'h' } } }");
    keeps "another than who is known beside" [ No_halt ]
      ("def go(x) { " ^ posting ^ " | (waitFor { poll at: _ } then action { if (!consume(at: x)) { halt 'h' } }) }\n"
       ^ before ^ "t = go(v)\nv = null\nexecute t");
    keeps "another than who is known around" [ No_halt ]
      ("def go(x) { (" ^ posting ^ " | condition { poll at: _ }) >> action { if (!consume(at: x)) { halt 'h' } } }\n"
       ^ before ^ "t = go(v)\nv = null\nexecute t");
    keeps "another than who was lost" ~environment:{ plain with faults = { Faults.none with loss = At_most 1 } }
      [ Vehicles ]
      (one ^ "execute watch (task('p')[v]) onError { ignore() }\nrelease v\nv = null\n\
              execute recruit { type 'UUV' } then { u -> idle(1) }\n\
              for (i in 1..3) { w = pick { type 'UUV' } }");
    keeps "who recruits again" [ No_halt; No_leftover ]
      "execute repeat 2, recruit { type 'UUV' } then { u -> action { if (poll(at: u)) { halt 'h' } ; post at: u } }";
    keeps "those who were lost stay away" ~environment:{ plain with faults = { Faults.none with loss = Any_number } }
      [ No_deadlock ]
      "execute repeat 4, recruit { type 'UUV' } then { v -> watch task('p') onError { ignore() } }";
    keeps "some go on for ever without one" ~environment:(late Faults.Any_number) [ Vehicles; No_leftover ]
      (one ^ "execute (repeat idle(1) until { poll(x: 1) }) | recruit { type 'UUV' } then { u -> action { post x: 1 } }");
  ]

(* A supplier [s], which replies this. *)
let supplied known =
  let known = ("getSupplier", [ [ Ok (Core.Host "s") ] ]) :: known in
  let replies call = Option.value (List.assoc_opt call known) ~default:[] in
  { plain with replies }

let supplier = one ^ "s = getSupplier()\n"

let by_replies =
  [
    keeps "a vehicle of a reply" ~environment:(supplied [ ("s.mine", [ [ Ok (Core.Vehicles [ "c" ]) ] ]) ]) [ No_halt ]
      (supplier ^ "if (v == s.mine) { halt 'h' }");
    tells "a vehicle within the second reply"
      ~environment:(supplied [ ("s.mine", [ [ Ok Null ]; [ Ok (list []); Ok (list [ Vehicles [ "c" ] ]) ] ]) ]) [ No_halt ]
      (supplier ^ "s.mine\nif (v in s.mine) { halt 'h' }");
    keeps "the id of a reply" ~environment:(supplied [ ("s.name", [ [ Ok (String "c") ] ]) ]) [ Vehicles ]
      (supplier ^ "w = pick { id s.name; timeout 1.seconds }");
    tells "a key of a map of a reply" ~environment:(supplied [ ("s.book", [ [ Ok (Map []) ] ]) ]) [ No_halt ]
      (supplier ^ "m = s.book\nm[v] = 1\nif (m.containsKey('C'.toLowerCase())) { halt 'h' }");
    tells "keys of a map of a reply, one by one" ~environment:(supplied [ ("s.book", [ [ Ok (Map []) ] ]) ]) [ No_halt ]
      (supplier ^ "m = s.book\nm[v] = 1\nfor (x in m) { if (x.key == 'C'.toLowerCase()) { halt 'h' } }");
    tells "a name given to a supplier" ~environment:(supplied [ ("s.take", [ [ Ok (Boolean true) ] ]) ]) []
      (supplier ^ "s.take(\"${v}\")");
    keeps "replies that name no vehicle" ~environment:(supplied [ ("s.ready", [ [ Ok (Boolean true) ] ]) ]) []
      (supplier ^ "if (s.ready) { execute task('p')[v] }");
  ]

let turns = Pure_run.world [ uuv "a"; uav "b"; uuv "c" ]

let by_order =
  [
    tells "who was there before, picked among others" [ No_halt ]
      (one ^ "release v\nw = pick { count 2; type 'UUV' }\nif (w[1] == v) { halt 'h' }");
    tells "who was there before, all picked" [ No_halt ]
      (one ^ "release v\nw = pick { count _; type 'UUV'; timeout 1.seconds }\nif (w[1] == v) { halt 'h' }");
    tells "who was there before, for code of a task" [ No_halt ]
      (one ^ "release v\nw = pick { count 2; type 'UUV' }\nexecute action { if (w[1] == v) { halt 'h' } }");
    tells "who was there before, in a closure" [ No_halt ]
      (one ^ "same = { w -> w == v }\nrelease v\nw = pick { count 2; type 'UUV' }\nif (same.call(w[1])) { halt 'h' }");
    tells "who was there before, in N" [ No_halt; No_leftover ]
      (one ^ "post at: v\nrelease v\nv = null\nw = pick { count 2; type 'UUV' }\nif (poll(at: w[1])) { halt 'h' }");
    tells "who was lost before" ~environment:{ plain with faults = { Faults.none with loss = At_most 1 } } [ No_error; Vehicles ]
      (one
       ^ "w = pick { type 'UUV' }\nexecute watch (task('p')[v]) onError { ignore() }\n\
          execute task('q')[w]\nrelease v\nrelease w\nv = null\nw = null\n\
          x = pick { count 3; type 'UUV' }");
    tells "others between them" ~world:turns [ No_halt ]
      (one ^ "w = pick { count 2 }\nif (w[0].getType() == 'UUV') { halt 'h' }");
    keeps "others between them, of another pick" ~world:turns [] (one ^ "w = pick { type 'UUV' }");
    keeps "who was there before, picked again alone" [ No_halt ]
      (one ^ "release v\nw = pick { type 'UUV' }\nif (w == v) { halt 'h' }");
    keeps "who was posted" [ No_halt; No_leftover ]
      (one ^ "post at: v\nw = pick { type 'UUV' }\nrelease v\nu = pick { type 'UUV' }\nif (poll(at: u)) { halt 'h' }");
    keeps "who was posted first" [ No_halt ]
      (one ^ "w = pick { type 'UUV' }\npost at: w\npost at: v\nconsume at: _\nif (poll(at: v)) { halt 'h' }");
    keeps "who was there before, and is forgotten" []
      (one ^ "release v\nv = pick { count 2; type 'UUV' }\nrelease v\nv = pick { count 2; type 'UUV' }");
    keeps "who was there before, in loops and functions" []
      {|def fly(n) { def team = pick { count n; type 'UUV' }
                     for (v in team) { message "with ${v}" }
                     release team }
        for (i in 1..2) { fly(2) ; w = pick { count 2; type 'UUV' } ; release w }|};
    keeps "a function that reads what is assigned after it" [ No_halt ]
      {|def first() { return v[0] }
        v = pick { count 1; type 'UUV' }
        release v
        w = pick { count 1; type 'UUV' }
        if (first() == w) { halt 'h' }|};
    (* No superfluous states: variables that nothing reads are forgotten where a task begins, too. *)
    keeps "who was picked, before a loop in which nothing reads it" [ Termination ]
      "vs = pick { count _ }\nwhile (true) { execute action { message 'm' }\npause 1 }";
    keeps "who was picked, before a loop of symmetric tasks in which nothing reads it" [ No_halt ]
      {|vs = pick { count _ }
        n = 0
        while (true) {
          execute (idle(1) >> action { post x: 1 }) | (idle(1) >> action { post x: 2 })
          consume x: 1
          if (poll(x: 2)) { n = n + 1 }
          if (n == 2) { halt 'h' }
        }|};
    keeps "around, with another one each time" [ Termination ]
      (one ^ "while (true) { w = pick { type 'UUV' }\nrelease v\nv = w }");
  ]

(* {1 Large fleets} *)

let large n = Pure_run.world (List.init n (fun i -> uuv (Printf.sprintf "uuv-%d" i) ~north:(float i *. 100.)))

let explored ?(environment = plain) world text =
  let program = Pure_run.compile_exn text in
  let limits = { Limits.none with max_states = Some 10_000 } in
  (program, Search.run { Search.default with environment; reduction = All; limits } program world)

let small name ?environment ?(n = 100) most text =
  let test () =
    let _, outcome = explored ?environment (large n) text in
    if outcome.stopped <> None || outcome.states > most then
      Alcotest.failf "%d states, at most %d expected" outcome.states most;
    Alcotest.(check bool) "vehicles are exchanged" true outcome.vehicle_symmetry
  in
  Alcotest.test_case name `Quick test

let all_faults =
  { plain with faults = { Faults.none with fail = Any_number; loss = Any_number; join = Any_number };
               may_be_late = (fun _ -> true) }

let three_teams =
  {|a = pick { count 3; type 'UUV' }
    b = pick { count 3; type 'UUV' }
    c = pick { count 3; type 'UUV' }
    def fly(team, name) { return task(name + '1')[team] | task(name + '2')[team] | task(name + '3')[team] }
    execute fly(a, 'p') | fly(b, 'q') | fly(c, 'r')
    release a + b + c|}

let each_in_turn =
  {|for (i in 1..4) {
      team = pick { count 3; type 'UUV' }
      execute task('p')[team[0]] | task('q')[team[1]] | task('r')[team[2]]
      for (v in team) { message "${v} is back" }
      release team
    }|}

(* The run that shows it, in names of the fleet: each transition is one of the semantics. *)
let test_run () =
  let world = large 12 and environment = Environment.failing plain in
  let text = each_in_turn ^ "\nv = pick { count 2 }\nrelease v[0]\nhalt 'h'" in
  let program, outcome = explored ~environment world text in
  match List.assoc Property.No_halt outcome.verdicts with
  | Violated { steps; _ } ->
    let step (c, e) (t : Transition.t) =
      let is_it ((t' : Transition.t), _) = Label.equal t'.label t.label && Configuration.equal t'.next t.next in
      match Environment.find is_it (Environment.choices environment program world e c) with
      | Some (t, e) -> (t.next, e)
      | None -> Alcotest.failf "there is no %s" (Format.asprintf "%a" Label.pp t.label)
    in
    ignore (List.fold_left step (Configuration.initial program, Environment.initial) steps)
  | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> Alcotest.fail "it halts"

(* Two side by side; each round takes any vehicle that is present. *)
let recruits =
  {|for (i in 1..4) { post cell: i }
    def searching(c) {
      watch task("search_$c") >> action { post searched: c } onError { why ->
        message "$c is left to others: $why"
        post cell: c
        ignore()
      }
    }
    def search() { repeat recruit { type 'UUV' } then { v -> waitFor { consume cell: _ } then { c -> searching(c) } } }
    execute until { count(searched: _) == 4 } run search() | search()|}

let test_recruits () =
  let states ?(reduction = Reduction.All) n =
    let program = Pure_run.compile_exn recruits in
    let options = { Search.default with environment = Environment.failing plain; reduction } in
    (Search.run options program (large n)).states
  in
  Alcotest.(check int) "all" 27_192 (states ~reduction:Whole 3);
  let check n =
    Alcotest.(check int) (Printf.sprintf "%d vehicles, by symmetry" n) 322 (states ~reduction:Symmetry n);
    Alcotest.(check int) (Printf.sprintf "%d vehicles" n) 319 (states n)
  in
  List.iter check [ 2; 3; 10; 100 ]

let large_fleets =
  [
    small "three teams" 30 three_teams;
    small "three teams, with failures" ~environment:(Environment.failing plain) 35 three_teams;
    small "three teams, with losses" ~environment:{ plain with faults = { Faults.none with loss = Any_number } } 60 three_teams;
    small "teams in turn" 60 each_in_turn;
    small "one by one" 400
      "vs = pick { type 'UUV' }\nfor (i in 1..40) { vs = vs + pick { type 'UUV' } }\n\
       for (v in vs) { execute task('p')[v] }";
    small "all" ~n:50 20 "vs = pick { count _; timeout 1.seconds }\nexecute task('p')[vs[3]] | task('q')[vs]";
    (* Which of the two is named first where the task begins does not depend on how the program came there. *)
    small "two, known in another order before each task" ~environment:(answering (fun _ -> [ [ "1"; "2" ] ])) ~n:2 24
      {|vs = pick { count _ }
        a = vs[0]
        b = vs[1]
        release vs
        vs = 0
        while (true) {
          if (ask('which') == 1) { xs = [a, b] } else { xs = [b, a] }
          for (x in xs) { pause 1 ; if (x == a) { message 'a' } }
          xs = 0
          execute idle(1) >> idle(2) >> idle(3)
          if (a == b) { halt 'the same' }
        }|};
    small "a pool" ~environment:all_faults ~n:5 6_000
      {|vs = pick { count 4 }
        for (i in 1..4) { post goal: i }
        def worker(v) {
          (repeat oneOf {
            when { consume goal: _ } then { g -> watch task("survey_$g") onError { post goal: g; ignore() } }
            when { count(goal: _) == 0 } then action { }
          } until { count(goal: _) == 0 })[v]
        }
        execute worker(vs[0]) | worker(vs[1]) | worker(vs[2]) | worker(vs[3])|};
    Alcotest.test_case "a run that is shown" `Quick test_run;
    Alcotest.test_case "recruits" `Quick test_recruits;
  ]

let () =
  Alcotest.run "vehicles told apart"
    [ ("by name", by_name); ("by what they are", by_what_they_are);
      ("by what is made", by_what_is_made); ("by recruits", by_recruits); ("by replies", by_replies); ("by order", by_order);
      ("large fleets", large_fleets) ]
