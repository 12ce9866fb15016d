open Dolphin_semantics
module Gen = QCheck2.Gen
open Gen
module Pure_run = Test_support.Pure_run

type t = { text : string; world : string * World.t; invariant : string }

(* {1 Worlds} *)

let uav = Pure_run.vehicle ~kind:"UAV"

let worlds =
  let world = Pure_run.world in
  let uuv = Pure_run.vehicle in
  let alike = world [ uuv "a"; uuv "b"; uuv "c"; uuv "d"; uav "e" ] in
  let places v = (Pure_run.vehicle ~north:200. v).position in
  [ ("alike", alike);
    ("five alike", world [ uuv "a"; uuv "b"; uuv "c"; uuv "d"; uuv "e" ]);
    ("at different places",
     world [ uuv "a" ~north:300.; uuv "b"; uuv "c"; uuv "d" ~north:5_000.; uuv "e" ~north:5_000. ]);
    ("two and two", world [ uuv "a"; uuv "b"; uav "c"; uav "d" ]);
    ("in turns", world [ uuv "a"; uav "b"; uuv "c"; uav "d"; uuv "e" ]);
    ("one between", world [ uuv "a"; uuv "d"; uav "e"; uuv "b"; uuv "c" ]);
    ("other batteries", world [ uuv "a"; uuv "b" ~battery:0.2; uuv "c"; uuv "d" ~battery:0.2 ]);
    ("other payload", world [ uuv "a"; uuv "b" ~payload:[ "DVL" ]; uuv "c" ~payload:[ "DVL" ]; uuv "d" ]);
    ("open batteries",
     alike |> World.open_battery "a" [] |> World.open_battery "b" [] |> World.open_battery "c" [ 1.; 0.2 ]);
    ("open alike",
     let far = (uuv "a" ~north:5_000.).position in
     let opened w v = World.open_battery v [ 1.; 0.2 ] (World.open_position v [ places v; far ] w) in
     List.fold_left opened alike [ "a"; "b"; "c"; "d" ]);
    ("open progress", List.fold_left (fun w v -> World.open_sensor Progress v [] w) alike [ "a"; "b"; "c"; "d"; "e" ]);
    ("open places", alike |> World.open_position "a" [ places "a"; places "d" ] |> World.open_position "b" []) ]

(* {1 Programs} *)

let f = Printf.sprintf
let variable = oneofl [ "p"; "q"; "r" ]
let plan = oneofl [ "s"; "t" ]

let vehicles =
  let* v = variable and* w = variable in
  frequencyl [ (6, v); (2, f "(%s + %s)" v w); (2, f "%s[0]" v); (1, f "(%s - %s)" v w); (1, f "(%s & %s)" v w);
               (1, f "(%s | { v -> v != %s })" v w) ]

(* Conditions that do not distinguish alike vehicles, and some that may. *)
let condition =
  let* v = vehicles and* w = vehicles and* k = oneofl [ "x"; "y" ] in
  frequency
    [ (3, oneofl [ f "poll(%s: %s)" k v; f "poll %s: 1" k; f "consume(%s: %s)" k v; f "consume(%s: 1)" k;
                   f "consume(%s: _)" k ]);
      (3, oneofl [ f "%s == %s" v w; f "%s in %s" v w; f "%s.size() > 1" v; f "%s[0] == %s[-1]" v w;
                   f "%s.any { u -> u == %s[0] }" v w; f "%s.contains(%s)" v w; f "g > 1" ]);
      (1, oneofl [ f "%s[0].getId() == 'b'" v; f "\"${%s[0]}\" == 'b'" v; f "%s[0].id < %s[0].id" v w;
                   f "%s.toString() == 'b'" v; f "('' + %s) == 'b'" v; f "%s.ids.contains('c')" v;
                   f "[%s[0], %s[0]].sort()[0] == %s[0]" v w v; f "battery(%s[0]) < 0.5" v;
                   f "%s[0].getBattery() < battery(%s[0])" v w; f "progress(%s[0]) < 0.5" v;
                   f "progress(%s[0]) < progress(%s[0])" v w;
                   f "position(%s[0]) in area(location(41.18521, -8.7048), 1.km)" v;
                   f "[(%s): 1].containsKey('b')" v ]) ]

let action =
  let* v = vehicles and* w = vehicles and* k = oneofl [ "x"; "y" ] and* c = condition in
  frequencyl
    [ (3, f "post %s: %s" k v); (2, f "post %s: 1" k); (1, f "consume %s: _" k); (1, f "g = g + 1");
      (2, f "message \"at ${%s}\"" v); (1, f "p = %s" w); (1, f "if (%s) { post %s: 2 }" c k);
      (1, f "if (%s) { halt \"here ${%s}\" }" c v) ]

(* A plan with a way, of which there are rests. *)
let inline = "imcPlan { planName 's'; locate 41.1852, -8.7048; goTo(); locate 41.1862, -8.7048; goTo() }"

(* Tasks that are made at their turn: for vehicles that are given, were taken from N, are idle, or may be any. *)
let made =
  let* p = plan and* v = vehicles and* w = vehicles and* k = oneofl [ "x"; "y" ] and* a = action and* c = condition in
  frequencyl
    [ (4, f "({ task('%s') })[%s]" p v); (1, f "({ task('%s') })" p);
      (1, f "({ imcPlan { planName 'i'; locate 41.1852, -8.7048; goTo speed:1.0 } })[%s]" v);
      (1, f "({ %s.rest(%s[0]) })[%s]" inline w v); (1, f "%s.rest(%s[0])[%s[0]]" inline w v);
      (2, f "({ %s ? task('%s') : idle(1.seconds) })[%s]" c p v);
      (2, f "(waitFor { consume %s: _ } then { u -> task('%s')[u] })" k p);
      (1, f "(waitFor { consume %s: _ } then { u -> task(\"%s${u}\") })" k p);
      (1, f "(waitFor { consume %s: _ } then { u -> action { post y: u ; if (u == %s) { g = g + 1 } } })" k v);
      (2, f "(waitFor { !idle(%s).isEmpty() } then { task('%s')[idle(%s)] })" v p v);
      (1, f "(waitFor { idle(%s) == %s } then { task('%s')[%s[0]] })" v v p v);
      (2, f "(watch (task('%s')[%s]) onError { %s ; retry() })" p v a);
      (2, f "(watch (task('%s')[%s]) onError { e -> post x: e.vehicle; task('t') })" p v);
      (1, f "(watch ({ task('%s') })[%s] onError { e -> post lost: e.vehicle; retry() })" p v);
      (2, f "(watch ({ task('%s') })[%s] onError { e -> if (e.vehicle) { dismiss e.vehicle; retry() } })" p v);
      (1, f "(watch (task('%s')[%s]) onError { dismiss %s ; ignore() })" p v v) ]

(* Tasks that recruit: the tasks that they make know the vehicle, leave it known, or ask for its name. *)
let recruiting =
  let asked =
    frequencyl
      [ (4, "type 'UUV'"); (4, ""); (1, "type 'UAV'"); (1, "payload 'DVL'"); (1, "id 'b'"); (1, "id 'ab'.substring(1)");
        (1, "region location(41.18521, -8.7048), 1.km") ]
  in
  let recruit =
    let* q = asked and* q' = asked and* p = plan and* v = vehicles and* k = oneofl [ "x"; "y" ] in
    let* a = action and* c = condition in
    let+ made =
      frequencyl
        [ (4, f "task('%s')" p); (3, f "task('%s')[u]" p); (2, f "(task('%s') >> action { post %s: u })" p k);
          (2, f "action { %s }" a); (1, "action { p = u }"); (2, "(idle(1.seconds) | task('s'))");
          (2, f "action { if (u == %s) { g = g + 1 } }" v); (1, f "action { if (poll(%s: u)) { halt 'again' } }" k);
          (2, f "(waitFor { %s } then task('%s'))" c p); (1, f "task(\"%s${u}\")" p);
          (1, "action { if (\"${u}\" == 'b') { halt 'b' } }");
          (2, f "(watch (task('%s')) onError { e -> post x: e.vehicle; ignore() })" p);
          (1, f "(watch (task('%s')[u]) onError { %s ; retry() })" p a);
          (1, f "(waitFor { consume %s: _ } then { w -> task('%s')[w] })" k p);
          (2, f "(recruit { %s } then { w -> action { if (w == %s) { post %s: w } else { post %s: u } } })" q' v k k);
          (1, f "(task('s') >> recruit { %s } then { w -> task('t') })" q') ]
    in
    f "(recruit { %s } then { u -> %s })" q made
  in
  let* one = recruit and* two = recruit and* c = condition and* p = plan and* v = vehicles and* a = action in
  frequencyl
    [ (6, one); (4, f "(%s | %s)" one two); (2, f "(%s >> %s)" one two); (2, f "(repeat 2, %s)" one);
      (1, f "((repeat 2, %s) | %s)" one two); (1, f "(repeat (%s >> idle(1.seconds)) until { %s })" one c);
      (1, f "(until { %s } run (repeat (%s >> idle(1.seconds))))" c one); (1, f "(%s within 5.seconds)" one);
      (1, f "(%s | task('%s')[%s])" one p v); (1, f "(watch (%s) onError { %s ; ignore() })" one a);
      (1, f "(watch (%s) onError { e -> if (e.vehicle) { dismiss e.vehicle }; retry() })" one) ]

let rec task depth =
  let leaf =
    let* p = plan and* v = vehicles and* a = action and* c = condition in
    frequencyl
      [ (5, f "task('%s')[%s]" p v); (1, f "task('%s')" p); (3, f "action { %s }" a); (1, f "condition { %s }" c);
        (1, "idle(1.seconds)"); (1, f "assert({ !(%s) }, 'a')" c);
        (1, f "imcPlan { planName 'i'; locate 41.1852, -8.7048; goTo speed:1.0 }[%s]" v) ]
  in
  let leaf = frequency [ (15, leaf); (4, made); (2, recruiting) ] in
  if depth = 0 then leaf
  else
    let part = task (depth - 1) in
    let* t = part and* t' = part and* a = action and* c = condition and* v = vehicles in
    frequencyl
      [ (3, f "(%s | %s)" t t'); (2, f "(%s >> %s)" t t'); (1, f "(%s)[%s + p]" t v);
        (1, f "(watch (%s) onError { %s ; ignore() })" t a);
        (1, f "(watch (%s) onError { if (it == 's failed on b: failure') { post x: 1 } ; ignore() })" t);
        (1, f "(until { %s } run (%s))" c t); (1, f "(waitFor { %s } then %s)" c t) ]

let pick =
  frequencyl
    [ (4, "count 2"); (5, "count 1"); (3, "count 2; type 'UUV'"); (5, "type 'UUV'"); (1, "payload 'DVL'");
      (1, "type 'UAV'; timeout 1.seconds"); (1, "id 'b'"); (1, "id 'ab'.substring(1)");
      (1, "count _; timeout 1.seconds");
      (1, "count _; type 'UUV'; timeout 1.seconds"); (1, "count 2; region location(41.18521, -8.7048), 1.km") ]

let rec statement depth =
  let* v = variable and* w = vehicles and* k = pick and* a = action and* c = condition and* t = task 1 in
  let simple =
    [ (3, f "%s = pick { %s }" v k); (2, f "%s = pick { %s } else { %s\n%s }" v k a w); (3, f "release %s\n%s = pick { %s }" v v k); (3, f "release %s" w); (2, f "%s = %s" v w);
      (2, a); (4, f "execute %s" t);
      (1, f "post x: %s" w); (1, f "consume x: %s" w); (1, "consume y: _"); (1, f "fly(%s)" w);
      (1, "g = g + 1"); (1, f "m = [:]\nm[%s] = g\nif (m['b'] == g) { post y: 3 }" w); (1, f "%s = null" v);
      (1, "p = ask('which')") ]
  in
  if depth = 0 then frequencyl simple
  else
    let* inner = statements (depth - 1) and* other = statements (depth - 1) in
    frequencyl
      (simple
       @ [ (2, f "for (u in %s) { execute task('s')[u]\n%s }" w a); (1, f "if (%s) { %s } else { %s }" c inner other);
           (2, f "for (i in 1..2) { %s }" inner); (1, f "while (g < 2) { g = g + 1\n%s }" inner);
           (1, f "while (g < 3) { %s }" inner);
           (1, f "if (%s) { %s }" c inner) ])

and statements depth =
  let* n = int_range 1 3 in
  map (String.concat "\n") (list_repeat n (statement depth))

(* A function with a variable of its own. *)
let functions =
  frequencyl
    [ (3, "def fly(t) { execute task('s')[t] }");
      (1, "def fly(t) { def u = pick { type 'UUV' }\nexecute task('s')[u]\nrelease u }");
      (1, "def fly(t) { def u = pick { count 2 }\nfor (v in u) { message \"${v}\" }\n\
           execute task('s')[u]\nrelease u + t }");
      (1, "def fly(t) { for (v in t) { release v }\nreturn t }") ]

(* Replies of a supplier, which may name vehicles. *)
let supplied =
  let* v = vehicles and* v' = variable and* a = action in
  let+ calls =
    list_size (int_range 1 2)
      (frequencyl
         [ (3, f "if (%s == s.mine) { %s } else { g = g + 1 }" v a); (2, f "%s = s.mine" v');
           (1, f "execute task('t')[%s & s.mine]" v); (2, f "%s = pick { id s.name }" v');
           (1, f "m = s.book\nm[%s] = g\nfor (x in m) { if (x.key == 'b') { post y: 4 } }" v);
           (3, "execute s.next()"); (1, f "if (s.ready(%s)) { post x: %s }" v v) ])
  in
  String.concat "\n" ("s = getSupplier()" :: calls)

let replies call : (Core.value, string) result list list =
  let task name = Ok (Core.Task (Platform { name; plan = None; task_site = Fault.unknown_site })) in
  match call with
  | "getSupplier" -> [ [ Ok (Host "s") ] ]
  | "s.mine" -> [ [ Ok (Vehicles [ "b" ]) ]; [ Ok (Vehicles [ "c" ]); Ok (Vehicles [ "b" ]) ] ]
  | "s.name" -> [ [ Ok (String "b"); Ok (String "c") ] ]
  | "s.book" -> [ [ Ok (Map []) ] ]
  | "s.next" -> [ [ task "s"; task "t" ] ]
  | "s.ready" -> [ [ Ok (Boolean true); Error "closed" ] ]
  | _ -> []

let invariant =
  let* v = vehicles and* w = vehicles in
  oneofl
    [ "g < 2"; f "%s.size() < 2" v; "!bound('b')"; "!running('s')"; "!running('t', 'c')"; f "%s != %s" v w;
      f "%s[0].getId() != 'c'" v; f "!poll(x: %s)" v; f "battery(%s[0]) > 0.5" v; f "!(bound('d') && %s == %s)" v w ]

(* Few vehicles are picked, so that others are left to be recruited; recruited ones are looked at, and picked. *)
let after_recruits =
  let* one = recruiting and* two = recruiting and* k = pick and* v = vehicles and* w = vehicles and* a = action in
  let* first = frequencyl [ (2, "p = pick { count 1 }\n"); (1, "p = pick { count 1 }\nrelease p\n") ] in
  let+ then_ =
    frequencyl
      [ (3, ""); (2, a); (1, f "release %s" v); (2, f "q = pick { %s }" k); (1, f "release %s\nq = pick { %s }" w k);
        (2, f "execute %s" two); (1, f "q = pick { %s }\nexecute %s" k two); (1, f "if (%s == %s) { post y: 3 }" v w) ]
  in
  f "g = 0\n%sq = p\nr = p\nexecute %s\n%s\n" first one then_

let gen =
  let first = frequencyl [ (3, "count 1"); (3, "count 2"); (1, "type 'UUV'"); (1, "count 2; type 'UUV'") ] in
  let between = frequency [ (2, return "\n"); (1, map (fun calls -> "\n" ^ calls ^ "\n") supplied) ] in
  let body = map3 (fun first calls then_ -> first ^ calls ^ then_) (statements 1) between (statements 1) in
  let* k = first and* k' = first and* body = body in
  let* functions = functions and* world = oneofl worlds in
  let picked =
    String.concat "\n" [ functions; "g = 0"; f "p = pick { %s }" k; f "q = pick { %s }" k'; "r = p"; body; "" ] in
  let* text = frequency [ (3, return picked); (1, after_recruits) ] in
  let* invariant = invariant in
  return { text; world; invariant }

let print p = f "in the world '%s', with the invariant %s:\n%s" (fst p.world) p.invariant p.text
