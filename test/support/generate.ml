open Dolphin_syntax
module Gen = QCheck2.Gen
open Gen
module Ast = Dolphin_syntax.Ast
open Ast

let world =
  let readings = [ ("T", 12.) ] in
  Pure_run.world
    [ Pure_run.vehicle "a" ~readings; Pure_run.vehicle "b" ~readings ~north:100.;
      Pure_run.vehicle "c" ~readings ~kind:"UAV" ~north:200. ]

let open_world =
  let module World = Dolphin_semantics.World in
  let link = Dolphin_semantics.Core.[ Boolean true; Boolean false ] in
  let place north = (Pure_run.vehicle ~north "c").position in
  World.at Any world |> World.open_battery "a" [] |> World.open_position "a" [] |> World.open_battery "b" [ 1.; 0.2 ]
  |> World.open_sensor Connected "a" link |> World.open_sensor Speed "b" []
  |> World.open_sensor (Measurement "T") "a" []
  |> World.open_sensor (Measurement "T") "c" [ Number 12.; Number 18. ]
  |> World.open_position "b" [] |> World.open_battery "c" [] |> World.open_position "c" [ place 200.; place 5_000. ]
  |> World.open_sensor Progress "a" [] |> World.open_sensor Progress "b" []
  |> World.open_sensor Progress "c" [ Number 0.; Number 0.5 ]

let answer = "1"

(* {1 Building syntax} *)

let located it = { it; at = Location.none }
let expression (it : expression_node) : expression = located it
let variable x = expression (Variable x)
let integer i = expression (Integer i)
let string s = expression (String s)
let binary op a b = expression (Binary (op, a, b))
let call name arguments = expression (Call { callee = variable name; arguments })
let call_method subject name =
  expression (Call { callee = expression (Member { subject; name = located name; safe = false }); arguments = [] })

let named k e = Named (located k, e)
let code body = { parameters = None; body }
let statement e : statement = located (Ast.Expression e)
let assign x value : statement = located (Assign { target = variable x; operator = None; value })
let post k x = call "post" [ named k (integer x) ]

let parse source =
  match Parse.program ~file:"generated.dol" source with
  | Ok program -> program
  | Error _ -> invalid_arg ("Generate.parse: " ^ source)

(* {1 Rests of plans} *)

(* Plans with a way. *)
let parsed plan =
  let text =
    Printf.sprintf "imcPlan { planName '%s'; locate 41.1852, -8.7048; goTo(); locate 41.1862, -8.7048; goTo() }" plan in
  match parse (Printf.sprintf "t = %s\n" text) with
  | [ { it = Assign { value; _ }; _ } ] -> value
  | _ -> invalid_arg ("Generate.parsed: " ^ text)

let inline_p = parsed "p"
let inline_q = parsed "q"
let inline plan = if plan = "p" then inline_p else inline_q

let progress v = call "progress" [ Positional (variable v) ]

let rest_of plan argument =
  let callee = expression (Member { subject = plan; name = located "rest"; safe = false }) in
  expression (Call { callee; arguments = [ Positional argument ] })

(* Of what one of [vehicles] has done, of a share, of a rest again. *)
let rest vehicles =
  let* plan = map inline (oneofl [ "p"; "q" ]) and* v = oneofl vehicles and* w = oneofl vehicles in
  let of_vehicle = rest_of plan (variable v) in
  frequencyl
    [ (5, of_vehicle); (1, rest_of plan (expression (Number 0.5))); (1, rest_of of_vehicle (variable w));
      (1, rest_of plan (progress v)) ]

(* Values that a rest may be equal to; it may not be equal to [q]. *)
let r = variable "r"
let known_plan = assign "r" (inline "p")

let rest_compared =
  let* v = map variable (oneofl [ "va"; "vb" ]) in
  let rest = rest_of r v and list x = expression (List [ x ]) in
  let asks name x = call name [ named "z" x ] in
  frequencyl
    [ (1, binary Equal rest r); (1, binary Member_of r (list rest));
      (1, binary Equal (list (list rest)) (list (list r)));
      (1, binary Equal (binary Sequence rest r) (binary Sequence r r)); (2, asks "poll" r); (2, asks "consume" r);
      (2, asks "poll" rest); (1, asks "consume" rest); (2, binary Equal rest (inline "q")) ]

let posting_rest =
  let* v = map variable (oneofl [ "va"; "vb" ]) and* whole = frequencyl [ (3, false); (1, true) ] in
  return (call "post" [ named "z" (if whole then r else rest_of r v) ])

let progress_compared =
  let* v = map progress (oneofl [ "va"; "vb"; "vc" ])
  and* share = map (fun x -> expression (Number x)) (oneofl [ 0.; 0.5 ]) in
  oneofl
    [ binary Less v share; binary Greater v share; binary Greater_equal v (integer 1);
      binary Less (progress "va") (progress "vb") ]

(* {1 Code} *)

let key = oneofl [ "x"; "y"; "z" ]
let number = oneofl [ 1; 2 ]

(* The same key, written out or computed. *)
let keyed k e =
  frequency
    [ (12, return (named k e)); (1, return (Keyed (string k, e)));
      (1, return (Keyed (binary Add (string "") (string k), e))) ]

let posting =
  let* k = key and* x = number in
  map (fun pair -> call "post" [ pair ]) (keyed k (integer x))

let pattern =
  let it = variable "it" in
  let* test = oneofl [ binary Greater it (integer 1); binary Less it (integer 2); binary Equal it it ] in
  return (expression (Closure (code [ statement test ])))

let taking name =
  let* k = key in
  let wanted = frequency [ (4, return (expression Wildcard)); (3, pattern) ] in
  let* by_number = frequencyl [ (3, true); (1, false) ] in
  if by_number then
    let* x = number in
    map (fun pair -> call name [ pair ]) (keyed k (integer x))
  else map (fun x -> call name [ named k x ]) wanted

let counted = assign "g" (binary Add (variable "g") (integer 1))
let this body = map (fun body -> code (List.map statement body)) body

let some_idle =
  let idle = call "idle" [ Positional (variable "va") ] in
  expression (Unary (Not, call_method idle "isEmpty"))

let some_running =
  let running = call "running" [ Positional (variable "va") ] in
  oneofl [ running; expression (Unary (Not, running)) ]

let if_running yes = map (fun e -> code [ located (If (e, [ statement (post "y" 2) ], [])); statement yes ]) some_running

(* Guards that do not ask who is idle. *)
let guard_anywhere =
  frequency
    [ (1, return (code [ statement (expression (Boolean true)) ]));
      (4, this (map (fun e -> [ e ]) (taking "poll")));
      (4, this (map (fun e -> [ e ]) (taking "consume")));
      (1, return (code [ statement (expression (Boolean false)) ]));
      (1, return (code [ statement (binary Greater_equal (variable "g") (integer 1)) ]));
      (1, map2 (fun p e -> code [ statement p; counted; statement e ]) posting (taking "consume"));
      (1, map (fun e -> code [ counted; statement e ]) (taking "poll")) ]

let plain_guard =
  frequency
    [ (28, guard_anywhere); (2, map (fun e -> code [ statement (binary And some_idle e) ]) (taking "poll"));
      (1, map2 (fun running e -> code [ statement (binary And running e) ]) some_running (taking "consume"));
      (1, this (map (fun e -> [ e ]) some_running)) ]

(* {2 Sensors} *)

let share x = expression (Number x)
let kept = assign "h" (call "battery" [ Positional (variable "va") ])

let now = call "now" []

(* A comparison of the date with a constant. *)
let dated =
  let* n = map integer (int_range 0 6) in
  let* op = oneofl [ Less; Less_equal; Greater; Greater_equal; Equal; Not_equal ] in
  oneofl
    [ binary op now n; binary op n now;
      binary And (binary Greater_equal now n) (binary Less now (binary Add n (integer 2))) ]

(* A comparison with a sensor's present or earlier value. *)
let comparison =
  let* kind = frequencyl [ (24, `Sensor); (6, `Dated); (3, `Progress); (1, `Rest) ] in
  match kind with
  | `Rest -> rest_compared
  | `Dated -> dated
  | `Progress -> progress_compared
  | `Sensor ->
    let* v = map variable (oneofl [ "va"; "vb"; "vc" ]) in
    let battery = call "battery" [ Positional v ] and position = call "position" [ Positional v ] in
    let west = expression (Unary (Negate, share 8.7048)) in
    let centre = call "location" [ Positional (share 41.1852); Positional west ] in
    let near = call "area" [ Positional centre; Positional (integer 400) ] in
    oneofl
      [ binary Less battery (share 0.3); binary Greater_equal battery (share 0.3);
        binary Greater (binary Multiply battery (integer 100)) (integer 50); binary Less (variable "h") (share 0.3);
        binary Less (call "battery" [ Positional (variable "va") ]) (call "battery" [ Positional (variable "vb") ]);
        (* It has been charged since. *)
        binary And (binary Less (variable "h") (share 0.3))
          (binary Greater_equal (call "battery" [ Positional (variable "va") ]) (share 0.3));
        binary Member_of position near; call "connected" [ Positional v ];
        binary Greater (binary Subtract now (variable "h")) (integer 2);
        binary Greater (call "speed" [ Positional v ]) (share 0.5);
        binary Less (call "reading" [ Positional v; Positional (string "T") ]) (integer 15) ]

let sensing_guard =
  let one e = code [ statement e ] in
  frequency
    [ (3, map one comparison);
      (2, map2 (fun e e' -> one (binary And e e')) comparison (taking "consume"));
      (1, map2 (fun e e' -> one (binary Or e e')) comparison (taking "poll"));
      (1, map (fun e -> code [ kept; statement e ]) comparison);
      (3, plain_guard) ]

let guard_of ~sensing = if sensing then sensing_guard else plain_guard
let guard = plain_guard
let deciding yes = map (fun e -> located (If (e, [ statement yes ], []))) comparison

let division_by_zero = binary Divide (integer 1) (integer 0)

let action_code ~sensing =
  let sensed =
    if sensing then
      [ (3, map (fun s -> code [ s ]) (deciding (post "x" 1))); (1, this (map (fun e -> [ e ]) posting_rest));
        (2, return (code [ kept ]));
        (1, return (code [ statement (call "message" [ Positional now ]) ]));
        (1, map (fun s -> code [ s ]) (deciding (call "halt" [ Positional (string "h") ]))) ]
    else []
  in
  let asserting g = code [ statement (call "assert" [ Positional (expression (Closure g)) ]) ] in
  frequency
    (sensed
     @ [ (1, return (code []));
         (6, this (map (fun e -> [ e ]) posting));
         (2, this (map (fun e -> [ e ]) (taking "consume")));
         (2, return (code [ counted ]));
         (2, return (code [ statement (call "message" [ Positional (string "m") ]) ]));
         (2, this (map2 (fun a b -> [ a; b ]) posting posting));
         (1, map asserting (guard_of ~sensing));
         (1, if_running (post "x" 2));
         (1, return (code [ statement division_by_zero ]));
         (1, return (code [ statement (call "fail" [ Positional (string "f") ]) ])) ])

(* Handlers that run the task again, or another one in its place: always, or if a pair is there. *)
let recovering =
  let retry = statement (call "retry" []) in
  let dismissed vs verdict = [ statement (call "dismiss" [ Positional vs ]); statement (call verdict []) ] in
  let of_error = expression (Member { subject = variable "it"; name = located "vehicle"; safe = false }) in
  let failed = code [ located (If (of_error, dismissed of_error "retry", [ statement (call "ignore" []) ])) ] in
  let instead plan = statement (call "task" [ Positional (string plan) ]) in
  let if_taken yes e = code [ located (If (e, [ yes ], [ statement (call "ignore" []) ])) ] in
  frequency
    [ (1, return (code [ retry ])); (1, return failed);
      (1, map (fun verdict -> code (dismissed (variable "va") verdict)) (oneofl [ "retry"; "ignore"; "propagate" ]));
      (3, map (if_taken retry) (taking "consume"));
      (1, map (fun p -> code [ instead p ]) (oneofl [ "p"; "q" ]));
      (1, map2 (fun p e -> if_taken (instead p) e) (oneofl [ "p"; "q" ]) (taking "consume")) ]

let handler ~sensing =
  let no_arguments name = statement (call name []) in
  let sensed = if sensing then [ map (fun s -> code [ s ]) (deciding (call "ignore" [])) ] else [] in
  oneof
    (sensed
     @ [ recovering; recovering; return (code [ no_arguments "ignore" ]); if_running (call "ignore" []);
         return (code []);
         return (code [ no_arguments "propagate" ]);
         map (fun e -> code [ statement e; no_arguments "ignore" ]) posting;
         map (fun e -> code [ statement e ]) posting;
         return (code [ statement (call "message" [ Positional (variable "it") ]); no_arguments "ignore" ]);
         return (code [ statement (call "halt" [ Positional (string "h") ]) ]);
         return (code [ statement division_by_zero ]) ])

let duration =
  frequency
    [ (4, map integer (int_range 1 3));
      (2, map (fun i -> expression (Closure (code [ statement (integer i) ]))) (int_range 1 3));
      (1, return (expression (Closure (code [ counted; statement division_by_zero ])))) ]

(* {1 Tasks} *)

let code_task ~sensing =
  let guard = guard_of ~sensing in
  frequency
    [ (3, map (fun c -> call "action" [ Positional (expression (Closure c)) ]) (action_code ~sensing));
      (2, map (fun c -> call "condition" [ Positional (expression (Closure c)) ]) guard);
      (2,
       let* i = int_range 0 2 in
       let* asks = frequencyl [ (2, false); (1, true) ] in
       return
         (if asks then call "confirm" [ Positional (string (Printf.sprintf "go %d?" i)) ]
          else call "idle" [ Positional (integer i) ]));
      (1, map (fun c -> call "assert" [ Positional (expression (Closure c)); Positional (string "a") ]) guard) ]

let platform_task vehicles =
  let* plan = oneofl [ "p"; "q" ] in
  let* v = oneofl vehicles in
  let* t =
    frequency
      [ (12, return (call "task" [ Positional (string plan) ])); (1, return (inline plan)); (1, rest vehicles) ] in
  return (expression (Index (t, variable v)))

let leaf ~sensing = function
  | [] -> code_task ~sensing
  | vehicles -> frequency [ (3, platform_task vehicles); (1, code_task ~sensing) ]

(* Code in the place of a task: on its vehicles, on any, or on those of the [V] around it. Some of it does not only
   compute. *)
let maker t = expression (Closure { parameters = None; body = [ statement t ] })

let some_made ~sensing vehicles =
  let* plan = oneofl [ "p"; "q" ] in
  let any = call "task" [ Positional (string plan) ] in
  (* Its vehicle is asked at its turn. Without one it would be the nearest, wherever vehicles have gone. *)
  let left =
    match vehicles with
    | [] -> return any
    | vehicles -> map2 (fun t v -> expression (Index (t, variable v))) (rest vehicles) (oneofl vehicles)
  in
  let* inside = frequency [ (8, return any); (1, left); (4, leaf ~sensing vehicles) ] in
  let* then_ = frequency [ (3, return inside); (1, map (binary Sequence inside) (code_task ~sensing)) ] in
  let* t = frequency [ (4, return (maker then_)); (1, return (maker (maker then_))) ] in
  frequency [ (2, return t); (1, return (expression (Index (t, variable "va")))) ]

(* Of any vehicle, of those of a kind, of one. The task made of it may have more than its own vehicle, or none. *)
let recruiting ~sensing =
  let* asked = oneofl [ []; [ ("type", "UUV") ]; [ ("type", "UAV") ]; [ ("id", "c") ]; [ ("id", "b") ] ] in
  let* plan = oneofl [ "p"; "q" ] in
  let own = call "task" [ Positional (string plan) ] in
  let* other = code_task ~sensing in
  let* made =
    frequencyl
      [ (4, own); (2, binary Sequence own other); (1, binary Parallel own other);
        (1, binary Sequence other (maker own));
        (1, expression (Index (own, variable "it"))); (1, binary Parallel own own) ]
  in
  let settings = List.map (fun (k, x) -> statement (call k [ Positional (string x) ])) asked in
  return (expression (Recruit (settings, code [ statement made ])))

(* [waitFor { consume x: _ } then { w -> task("p$w") }] *)
let taker plan =
  let name = expression (Template [ Literal plan; Hole (variable "w") ]) in
  let body = [ statement (call "task" [ Positional name ]) ] in
  expression (Closure { parameters = Some [ located "w" ]; body })

let on_cut = frequencyl [ (3, Completes); (1, Fails) ]

(* With a number of rounds, with a condition, with both, without end. A round without end waits at least for a timer. *)
let repeated ~sensing t =
  let guard = guard_of ~sensing in
  let counted n until = expression (Repeat { rounds = Option.map integer n; body = t; until }) in
  frequency
    [ (4, map (fun n -> counted (Some n) None) (int_range 1 3)); (2, map (fun g -> counted None (Some g)) guard);
      (1, map2 (fun n g -> counted (Some n) (Some g)) (int_range 1 3) guard);
      (1,
       let body = binary Sequence t (call "idle" [ Positional (integer 1) ]) in
       return (expression (Repeat { rounds = None; body; until = None }))) ]

(* [vehicles] shared out to two branches. *)
let shared_out vehicles =
  let* lefts = flatten_l (List.map (fun _ -> bool) vehicles) in
  let both = List.combine vehicles lefts in
  let side wanted = List.filter_map (fun (v, left) -> if left = wanted then Some v else None) both in
  return (side true, side false)

(* [t ensure { post x: 1; g = 2 }]. *)
let ensured t =
  let post =
    let* k = key and* x = number in
    return (statement (call "post" [ named k (integer x) ]))
  in
  let assignment = map (fun x -> assign "g" (integer x)) number in
  let* body = list_size (int_range 1 2) (frequency [ (3, post); (1, assignment) ]) in
  return (expression (Ensure (t, code body)))

(* [using x: 1 run t]: [t] may be code that gets the taken value. *)
let using t =
  let* k = key and* x = number and* any = map (fun n -> n = 0) (int_bound 2) in
  let wanted = if any then expression Wildcard else integer x in
  let taken = code [ statement (call "consume" [ named k wanted ]) ] in
  let back = code [ statement (call "giveBack" []) ] in
  return (expression (Wait_for (taken, expression (Ensure (t, back)))))

let rec task_of ~sensing ~vehicles ~depth : expression Gen.t =
  let leaf = leaf ~sensing and guard = guard_of ~sensing in
  if depth <= 0 then leaf vehicles
  else
    let part = fun () -> task_of ~sensing ~vehicles ~depth:(depth - 1) in
    let* shape =
      frequencyl
        [ (2, `Leaf); (5, `Sequence); (5, `Parallel); (2, `All_of); (2, `One_of); (1, `Wait_for); (2, `Until);
          (2, `During); (4, `Watch); (1, `Allocated); (2, `Repeat); (2, `Made); (1, `Taken);
          (2, `Ensure); (1, `Using) ]
    in
    match shape with
    | `Leaf -> leaf vehicles
    | `Sequence -> map2 (binary Sequence) (part ()) (part ())
    | `Parallel ->
      let* left, right = shared_out vehicles in
      let* a = task_of ~sensing ~vehicles:left ~depth:(depth - 1) in
      map (binary Parallel a) (task_of ~sensing ~vehicles:right ~depth:(depth - 1))
    | `All_of -> map (fun branches -> expression (Builder (All_of, branches))) (branches guard part)
    | `One_of -> map (fun branches -> expression (Builder (One_of, branches))) (branches guard part)
    | `Wait_for -> map2 (fun c t -> expression (Wait_for (c, t))) guard (part ())
    | `Until -> map3 (fun e c t -> expression (Until (e, c, t))) on_cut guard (part ())
    | `During -> map3 (fun e d t -> expression (During (e, d, t))) on_cut duration (part ())
    | `Watch -> map2 (fun t c -> expression (Watch (t, c))) (part ()) (handler ~sensing)
    | `Repeat -> Gen.bind (part ()) (repeated ~sensing)
    | `Ensure -> Gen.bind (part ()) ensured
    | `Using -> Gen.bind (frequency [ (3, part ()); (1, map taker (oneofl [ "p"; "q" ])) ]) using
    | `Made -> frequency [ (3, some_made ~sensing vehicles); (1, recruiting ~sensing) ]
    | `Taken -> map2 (fun g plan -> expression (Wait_for (g, taker plan))) guard (oneofl [ "p"; "q" ])
    | `Allocated ->
      let all = match vehicles with [] -> [ "va" ] | vehicles -> vehicles in
      let set = List.map variable all in
      let set = List.fold_left (binary Add) (List.hd set) (List.tl set) in
      map (fun t -> expression (Index (t, set))) (part ())

and branches guard part =
  let branch () = map2 (fun c t -> statement (expression (When (c, t)))) guard (part ()) in
  let* n = int_range 1 3 in
  flatten_l (List.init n (fun _ -> branch ()))

(* {1 Nests} *)

(* Each vehicle goes to one of [n]. *)
let dealt n vehicles =
  let* owners = flatten_l (List.map (fun _ -> int_bound (n - 1)) vehicles) in
  let both = List.combine vehicles owners in
  return (List.init n (fun i -> List.filter_map (fun (v, owner) -> if owner = i then Some v else None) both))

let branch guard t = statement (expression (When (guard, t)))

(* A task with a key of its own, which [t] may end by, wait for, or pass on. *)
let with_key ~sensing t =
  let* name = oneofl [ "k"; "l" ] and* x = number and* other = code_task ~sensing in
  let pair x = Keyed (variable name, integer x) in
  let action body = call "action" [ Positional (expression (Closure (code body))) ] in
  let posts = action [ statement (call "post" [ pair x ]) ] in
  let* asks = oneofl [ "poll"; "consume" ] in
  let there = code [ statement (call asks [ pair x ]) ] in
  let untaken = code [ statement (expression (Unary (Not, call "poll" [ pair x ]))) ] in
  let passed_on = action [ statement (call "post" [ named "x" (variable name) ]) ] in
  let made e = expression (Closure { parameters = None; body = [ statement e ] }) in
  let* body =
    frequencyl
      [ (1, t); (2, binary Parallel posts t); (1, binary Sequence posts t);
        (3, expression (Until (Completes, there, binary Parallel (binary Sequence other posts) t)));
        (1, expression (Until (Fails, untaken, binary Parallel (binary Sequence other posts) t)));
        (2, binary Parallel (expression (Wait_for (there, other))) (binary Sequence t posts));
        (1, binary Parallel (made (expression (Wait_for (there, posts)))) (binary Sequence other posts));
        (1, binary Parallel passed_on (binary Sequence posts t)) ]
  in
  return (call "fresh" [ Positional (expression (Closure { parameters = Some [ located name ]; body = [ statement body ] })) ])

let some_keys ~sensing t =
  let* n = frequencyl [ (6, 0); (2, 1); (1, 2) ] in
  let rec wrap n t = if n = 0 then return t else Gen.bind (with_key ~sensing t) (wrap (n - 1)) in
  wrap n t

(* [withBreaks(v, p, t) { g }], [onlyWhile(v, p) { g }] of the prelude. They have fresh keys, as [with_key]. *)
let with_breaks ~sensing vehicles =
  let* plan = map inline (oneofl [ "p"; "q" ]) and* v = map variable (oneofl vehicles) in
  (* As an argument, [confirm] alone is one of the script. *)
  let as_task (t : expression) =
    match t.it with
    | Call { callee = { it = Variable "confirm"; _ }; _ } -> binary Sequence t (call "idle" [ Positional (integer 0) ])
    | _ -> t
  in
  let* other = map as_task (leaf ~sensing vehicles) and* only_while = frequencyl [ (2, false); (1, true) ] in
  let+ is_broken = map (fun c -> Positional (expression (Closure c))) (guard_of ~sensing) in
  if only_while then call "onlyWhile" [ Positional v; Positional plan; is_broken ]
  else call "withBreaks" [ Positional v; Positional plan; Positional other; is_broken ]

(* [t], perhaps after a plan with breaks, or before one. *)
let some_breaks ~sensing vehicles t =
  let beside order = map (order t) (with_breaks ~sensing vehicles) in
  if vehicles = [] then return t
  else frequency [ (10, return t); (1, beside (binary Sequence)); (1, beside (fun t b -> binary Sequence b t)) ]

let in_context ~sensing vehicles t =
  let leaf = leaf ~sensing and guard = guard_of ~sensing in
  let* shape =
    frequencyl
      [ (3, `Until); (2, `During); (4, `Watch); (2, `Before); (1, `After); (2, `All_of); (1, `One_of); (1, `Repeat);
        (2, `Fresh); (2, `Ensure); (1, `Using) ]
  in
  match shape with
  | `Ensure -> ensured t
  | `Using -> using t
  | `Fresh -> with_key ~sensing t
  | `Until -> map2 (fun e c -> expression (Until (e, c, t))) on_cut guard
  | `During -> map2 (fun e d -> expression (During (e, d, t))) on_cut duration
  | `Watch -> map (fun c -> expression (Watch (t, c))) (handler ~sensing)
  | `Repeat -> repeated ~sensing t
  | `Before -> map (binary Sequence t) (leaf vehicles)
  | `After -> map (fun first -> binary Sequence first t) (leaf vehicles)
  | `One_of -> map (fun g -> expression (Builder (One_of, [ branch g t ]))) guard
  | `All_of ->
    let* g = guard and* g' = guard and* other = leaf vehicles in
    return (expression (Builder (All_of, [ branch g t; branch g' other ])))

let rec nested_of ~sensing ~vehicles ~depth =
  let leaf = leaf ~sensing in
  let* n = frequencyl [ (3, 2); (1, 3) ] in
  let* shares = dealt n vehicles in
  let part vehicles =
    let* is_nest = if depth <= 0 then return false else map (fun i -> i < 2) (int_bound 4) in
    let* is_made = map (( = ) 0) (int_bound 7) in
    if is_nest then nested_of ~sensing ~vehicles ~depth:(depth - 1)
    else if is_made then
      frequency
        ([ (6, some_made ~sensing vehicles); (2, recruiting ~sensing) ]
         @ if vehicles = [] then [] else [ (1, with_breaks ~sensing vehicles) ])
    else
      let* task = leaf vehicles and* next = leaf vehicles and* short = bool in
      return (if short then task else binary Sequence task next)
  in
  let* parts = flatten_l (List.map part shares) in
  let t = List.fold_left (binary Parallel) (List.hd parts) (List.tl parts) in
  let* contexts = frequencyl [ (1, 0); (4, 1); (2, 2) ] in
  let rec wrap n t =
    if n = 0 then return t
    else
      let* t = in_context ~sensing vehicles t in
      wrap (n - 1) t
  in
  wrap contexts t

let nested = nested_of ~sensing:false
let sensing_nested = nested_of ~sensing:true
let task = task_of ~sensing:false
let sensing_task = task_of ~sensing:true

(* {1 Scripts} *)

let replace ~by pattern text =
  let n = String.length pattern in
  let b = Buffer.create (String.length text) in
  let rec from i =
    if i + n > String.length text then Buffer.add_substring b text i (String.length text - i)
    else if String.sub text i n = pattern then begin
      Buffer.add_string b by;
      from (i + n)
    end
    else begin
      Buffer.add_char b text.[i];
      from (i + 1)
    end
  in
  from 0;
  Buffer.contents b

let printed p = Format.asprintf "%a" Print.program p
let has part text = replace ~by:"" part text <> text


let pick_by_id (v, id) =
  assign v (expression (Builder (Pick, [ statement (call "id" [ Positional (string id) ]) ])))

let all = [ ("va", "a"); ("vb", "b"); ("vc", "c") ]
let vehicles = List.map fst all
let start = assign "g" (integer 0)

let executing ?(before = []) t =
  let executed = Format.asprintf "%a" Print.expression t in
  let plans = if has "r.rest(" executed || has ": r" executed then [ known_plan ] else [] in
  (start :: plans @ List.map pick_by_id all)
  @ before
  @ [ statement (call "execute" [ Positional t ]); statement (call "message" [ Positional (string "after") ]) ]

let picks =
  let by_type =
    assign "va" (expression (Builder (Pick, [ statement (call "type" [ Positional (string "UUV") ]) ])))
  in
  let everything =
    assign "va"
      (expression (Builder (Pick, [ statement (call "count" [ Positional (expression Wildcard) ]) ])))
  in
  frequency
    [ (2, return ([ pick_by_id ("va", "a") ], [ "va" ]));
      (3, return (List.map pick_by_id [ ("va", "a"); ("vb", "b") ], [ "va"; "vb" ]));
      (2, return (List.map pick_by_id all, vehicles));
      (1, return ([ by_type ], [ "va" ]));
      (1, return ([ everything ], [ "va" ])) ]

let rec body ~sensing vehicles level : statement list Gen.t =
  let* n = int_range 1 (if level = 0 then 3 else 2) in
  let* parts = flatten_l (List.init n (fun _ -> some_statements ~sensing vehicles level)) in
  return (List.concat parts)

and some_statements ~sensing vehicles level =
  let* shape =
    frequencyl
      ([ (6, `Execute); (2, `Post); (1, `Message); (1, `Pause); (1, `Ask); (1, `Release); (1, `Set_timeout);
         (1, `Consume); (1, `Pick_else) ]
       @ if level < 2 then [ (2, `If); (1, `While) ] else [])
  in
  let one s = return [ s ] in
  match shape with
  | `Execute ->
    let* depth = int_bound (3 - level) in
    let* t = Gen.bind (task_of ~sensing ~vehicles ~depth) (some_breaks ~sensing vehicles) in
    let* t = some_keys ~sensing t in
    return [ statement (call "execute" [ Positional t ]) ]
  | `Post -> map (fun e -> [ statement e ]) posting
  | `Consume -> map (fun e -> [ statement e ]) (taking "consume")
  | `Message -> one (statement (call "message" [ Positional (variable "g") ]))
  | `Pause -> one (statement (call "pause" [ Positional (integer 1) ]))
  | `Ask -> one (assign "g" (call "ask" [ Positional (string "how many?") ]))
  | `Release -> map (fun v -> [ statement (call "release" [ Positional (variable v) ]) ]) (oneofl vehicles)
  | `Pick_else ->
    let* v = oneofl vehicles and* kind = oneofl [ "UUV"; "UAV"; "ROV" ] and* p = posting in
    let settings = [ statement (call "type" [ Positional (string kind) ]) ] in
    one (assign v (expression (Pick_else (settings, [ statement p; statement (variable v) ]))))
  | `Set_timeout -> one (statement (call "setConnectionTimeout" [ Positional (integer 10) ]))
  | `If ->
    let* test = if sensing then oneof [ taking "poll"; comparison ] else taking "poll" in
    let* yes = body ~sensing vehicles (level + 1) in
    let* no = body ~sensing vehicles (level + 1) in
    one (located (If (test, yes, no)))
  | `While ->
    let i = Printf.sprintf "i%d" level in
    let* inside = body ~sensing vehicles (level + 1) in
    let next = assign i (binary Add (variable i) (integer 1)) in
    return [ assign i (integer 0); located (While (binary Less (variable i) (integer 2), next :: inside)) ]

(* Whose vehicles may have no value yet, or that of all that are bound. *)
let on_interrupt ~sensing vehicles =
  let* kind = frequencyl [ (4, `None); (1, `Task); (1, `Code) ] in
  let declared e = [ statement (call "onInterrupt" [ Positional e ]) ] in
  match kind with
  | `None -> return []
  | `Task -> map declared (task_of ~sensing ~vehicles ~depth:1)
  | `Code ->
    let of_vehicles (t : expression) =
      let body = [ statement (located (Index (t, variable "vs"))) ] in
      declared (located (Closure { parameters = Some [ located "vs" ]; body }))
    in
    map of_vehicles (task_of ~sensing ~vehicles:[ "vs" ] ~depth:1)

let programs ~sensing =
  let* picked, vehicles = if sensing then return (List.map pick_by_id all, vehicles) else picks in
  let* before = body ~sensing vehicles 1 in
  let* depth = frequencyl [ (1, 0); (1, 1); (2, 2); (5, 3); (4, 4) ] in
  let* posts = oneofl [ []; [ ("x", 1) ]; [ ("x", 1); ("y", 2); ("z", 1) ] ] in
  let posts = List.map (fun (k, x) -> statement (post k x)) posts in
  let* t = Gen.bind (task_of ~sensing ~vehicles ~depth) (some_breaks ~sensing vehicles) in
  let* t = some_keys ~sensing t in
  let* after = body ~sensing vehicles 0 in
  let* first = bool in
  let executed = [ statement (call "execute" [ Positional t ]) ] in
  let start = if sensing then [ start; assign "h" (integer 1); known_plan ] else [ start ] in
  let* declared = on_interrupt ~sensing vehicles in
  return (declared @ start @ picked @ posts @ if first then executed @ after else before @ executed @ after)

let stands_first (s : Ast.statement) =
  match s.it with
  | Assign { value = { it = Builder _ | Integer _; _ }; _ }
  | Expression { it = Call { callee = { it = Variable "onInterrupt"; _ }; _ }; _ } -> true
  | _ -> false

let for_ever program =
  let first, rest = List.partition stands_first program in
  first @ [ located (While (expression (Boolean true), rest)) ]

(* Of several vehicles a plan with a place takes the nearest, wherever they have gone. *)
let rec program_gen ~sensing =
  let* p = programs ~sensing in
  let text = printed p in
  if has "count _" text && has "imcPlan" text then program_gen ~sensing else return p

let program = program_gen ~sensing:false
let sensing_program = program_gen ~sensing:true

(* {1 Copies}

   A piece of program is copied as text: pairs with 1 become the copy's own, those with 2 stay; its plans and its
   vehicle are treated like those with 1. *)

let text e = Format.asprintf "%a" Print.expression e

let copy i text =
  let vehicle = List.nth [ "va"; "vb"; "vc" ] i and own = string_of_int (i + 3) in
  List.fold_left
    (fun text (pattern, by) -> replace ~by pattern text)
    text
    [ (": 1", ": " ^ own); ("'p'", "'p" ^ own ^ "'"); ("vown", vehicle) ]

(* Most copies are true ones. *)
let copies k text =
  let* slip = frequencyl [ (9, None); (1, Some 0) ] in
  let copy i = if slip = Some i then replace ~by:": 2" ": 1" (copy i text) else copy i text in
  return (List.init k copy)

let branch_text = map2 (fun g t -> text (expression (When (g, t)))) (guard_of ~sensing:false)

let replicated_any =
  let* k = frequencyl [ (3, 2); (2, 3) ] in
  let* vehicles = frequencyl [ (3, [ "vown" ]); (1, []) ] in
  let part vehicles depth = task ~vehicles ~depth in
  let* depth = frequencyl [ (1, 0); (3, 1); (3, 2) ] in
  let* row = map text (part vehicles depth) in
  let* row = copies k row in
  let* others = frequencyl [ (2, `None); (2, `All_of); (1, `One_of); (1, `Common); (1, `Row) ] in
  let* beside =
    match others with
    | `None -> return []
    | `Common -> map (fun t -> [ text t ]) (part [] 1)
    | `Row -> Gen.bind (map text (part [] 1)) (copies k)
    | (`All_of | `One_of) as kind ->
      let* depth = frequencyl [ (3, 0); (1, 1) ] in
      let* branches = Gen.bind (branch_text (part [] depth)) (copies k) in
      let name = match kind with `All_of -> "allOf" | `One_of -> "oneOf" in
      return [ Printf.sprintf "%s {\n%s\n}" name (String.concat "\n" branches) ]
  in
  let all = String.concat " | " (List.map (Printf.sprintf "(%s)") (row @ beside)) in
  let* wrapped =
    frequency
      [ (5, return all);
        (1, map (fun h -> text (expression (Watch (variable "t", h)))) (handler ~sensing:false));
        (1, map (fun g -> text (expression (Until (Completes, g, variable "t")))) (guard_of ~sensing:false));
        (1, map (fun t -> text (binary Sequence (variable "t") t)) (part [] 0)) ]
  in
  let executed = if wrapped = all then "execute " ^ all else Printf.sprintf "t = %s\nexecute %s" all wrapped in
  let own = List.init k (fun i -> i + 3) in
  let each format = String.concat "\n" (List.map (Printf.sprintf format) own) in
  let* before =
    frequencyl
      [ (3, ""); (2, each "post x: %d"); (1, each "post x: %d" ^ "\n" ^ each "post y: %d"); (1, "post x: 3");
        (1, "post x: 2, y: 2") ]
  in
  let* after =
    frequencyl
      [ (3, ""); (1, "if (poll(x: 4)) { halt 'four' }"); (1, "consume x: 3"); (1, "consume y: _");
        (1, each "consume x: %d");
        (1, "if (poll(y: 3)) { post x: 1 } else { consume x: _ }") ]
  in
  let* loop = frequencyl [ (4, false); (1, true) ] in
  let body = String.concat "\n" [ before; executed; after ] in
  let body = if loop then Printf.sprintf "while (g < 2) { g = g + 1\n%s\n}" body else body in
  let picks = "va = pick { id 'a' }\nvb = pick { id 'b' }\nvc = pick { id 'c' }" in
  return (parse (String.concat "\n" [ "g = 0"; picks; body; "" ]))

(* Few of them make tasks, ensure something, ask for idle or running vehicles, or dismiss: symmetry of tasks is off
   then. *)
let rec replicated_gen () =
  let* p = replicated_any in
  let words = List.filter (( <> ) "") (String.split_on_char ' ' (String.map (function '\n' -> ' ' | c -> c) (printed p))) in
  let text = String.concat " " words in
  let* keep = map (( = ) 0) (int_bound 8) in
  let without = [ "idle(va)"; "running(va)"; "dismiss"; "{ task"; "w ->"; "{ {"; "ensure {"; "using " ] in
  if keep || not (List.exists (fun part -> has part text) without) then return p else replicated_gen ()

let replicated = replicated_gen ()

let print p =
  let text = printed p in
  if has "withBreaks" text || has "onlyWhile" text then "include 'prelude'\n" ^ text else text

let has_rests p =
  let text = print p in
  has ".rest(" text || has "include 'prelude'" text

let rec without_rests programs =
  let* p = programs in
  if has_rests p then without_rests programs else return p

let source = map print program
let compile p = Pure_run.compile_exn (print p)
