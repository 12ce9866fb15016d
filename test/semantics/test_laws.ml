open Dolphin_semantics
open Test_support
open Generate
module Gen = QCheck2.Gen
open Gen

(* {1 Comparing tasks} *)

let closure body = expression (Closure (code body))
let message text = statement (call "message" [ Positional (expression (String text)) ])

(* Contexts around a compared task, and tasks beside it; no vehicles. *)
let contexts : (Ast.expression -> Ast.expression) list =
  let action body = call "action" [ Positional (closure body) ] in
  let consumed k = call "consume" [ Named ({ it = k; at = Dolphin_syntax.Location.none }, expression Wildcard) ] in
  [ Fun.id;
    (fun t -> binary Sequence t (action [ message "next" ]));
    (fun t -> binary Parallel (action [ statement (post "x" 1); statement (post "z" 2) ]) t);
    (fun t -> expression (Until (Completes, code [ statement (consumed "y") ], t)));
    (fun t -> expression (Watch (t, code [ message "handled"; statement (call "ignore" []) ])));
    (fun t -> binary Sequence (action [ statement (post "y" 2) ]) t) ]

type tasks = {
  around : int;
  posts : bool;
  a : Ast.expression;
  b : Ast.expression;
  c : Ast.expression;
  g : Ast.closure;
  anywhere : Ast.closure;  (* a guard that does not ask who is idle *)
}

(* Tasks on disjoint vehicles, so that they may stand side by side. *)
let tasks =
  let* around = int_bound (List.length contexts - 1) in
  let* posts = bool in
  let* order = shuffle_l vehicles in
  let one i = [ List.nth order i ] in
  let* a = task ~vehicles:(one 0) ~depth:2 in
  let* b = task ~vehicles:(one 1) ~depth:2 in
  let* c = task ~vehicles:(one 2) ~depth:1 in
  let* g = guard and* anywhere = guard_anywhere in
  return { around; posts; a; b; c; g; anywhere }

let program_of x t =
  let before = if x.posts then [ statement (post "x" 1); statement (post "y" 2) ] else [] in
  executing ~before ((List.nth contexts x.around) t)

let graph x t = Graph.explore ~limit:1_500 (compile (program_of x t)) world

(* Graphs that are too large prove nothing; how many pairs were compared is checked at the end. *)
let compared = ref 0
let skipped = ref 0

let alike ?named x t t' =
  match graph x t, graph x t' with
  | Some g, Some g' ->
    Property.count compared;
    Bisimulation.equivalent ?named ~observed:Bisimulation.shared g g'
  | None, _ | _, None ->
    Property.count skipped;
    true

let law ?named ?(applies = fun _ -> true) ?(count = 500) name left right =
  let print x = Printf.sprintf "%s\n---\n%s" (print (program_of x (left x))) (print (program_of x (right x))) in
  Property.case ~count name ~print tasks (fun x -> (not (applies x)) || alike ?named x (left x) (right x))

(* No recruit may get a vehicle that was dismissed: code that makes a task still has its name. *)
let recruits_none_dismissed x =
  let text = print (program_of x (binary Sequence x.c x.a)) in
  let has word =
    match Str.search_forward (Str.regexp_string word) text 0 with _ -> true | exception Not_found -> false in
  not (has "dismiss" && has "recruit")

(* Two tasks that both ensure something may do it in another order where they stand the other way round. *)
let ensures =
  Fold.expression (fun found (e : Ast.expression) -> found || match e.it with Ensure _ -> true | _ -> false) false

let law_of_order name left right =
  let in_any_order x = not (ensures x.a && ensures x.b) in
  let print x = Printf.sprintf "%s\n---\n%s" (print (program_of x (left x))) (print (program_of x (right x))) in
  Property.case ~count:500 name ~print tasks (fun x -> (not (in_any_order x)) || alike x (left x) (right x))

(* {1 The laws} *)

let ( >> ) = binary Sequence
let ( <|> ) = binary Parallel
let until g t = expression (Until (Completes, g, t))
let assure g t = expression (Until (Fails, g, t))
let during n t = expression (During (Completes, expression (Integer n), t))
let within n t = expression (During (Fails, expression (Integer n), t))
let watch t h = expression (Watch (t, code h))
let branches builder bs =
  expression (Builder (builder, List.map (fun (g, t) -> statement (expression (When (g, t)))) bs))

(* The union of at least one vehicle; one twice, for the static check that knows what does not fit on one vehicle. *)
let set vs = List.fold_left (binary Add) (variable (List.hd vs)) (List.map variable vs)

let on t vs = expression (Index (t, set vs))
let propagate = [ statement (call "propagate" []) ]
let repeat ?rounds ?until body =
  expression (Repeat { rounds = Option.map (fun n -> expression (Integer n)) rounds; body; until })

(* A round without end must wait. *)
let waiting t = binary Sequence t (call "idle" [ Positional (expression (Integer 1)) ])
let ignored t = watch t [ statement (call "ignore" []) ]
let never = code [ statement (expression (Boolean false)) ]
let always = code [ statement (expression (Boolean true)) ]
let polls =
  let key = { Ast.it = "y"; at = Dolphin_syntax.Location.none } in
  call "poll" [ Named (key, expression Wildcard) ]

let polling = code [ statement polls ]
let not_polling = code [ statement (expression (Unary (Not, polls))) ]

(* MAKE and ALLOCATE read as actions that do nothing. *)
let as_actions (l : Label.t) =
  match l with Make | Allocate _ -> "act" | l -> Format.asprintf "%a" Label.pp l

let nothing_done = call "action" [ Positional (closure []) ]

let fresh names t =
  let name x = { Ast.it = x; at = Dolphin_syntax.Location.none } in
  let code = { Ast.parameters = Some (List.map name names); body = [ statement t ] } in
  call "fresh" [ Positional (expression (Closure code)) ]

(* A task that posts pairs of a key of its own, and ends by taking one. *)
let with_key k t =
  let pair = Ast.Keyed (variable k, expression (Integer 1)) in
  let posts = call "action" [ Positional (closure [ statement (call "post" [ pair ]) ]) ] in
  until (code [ statement (call "consume" [ pair ]) ]) (binary Parallel posts t)

let ensure body t = expression (Ensure (t, code body))
let one = [ statement (post "x" 1) ]
let two = [ statement (post "y" 2) ]

let laws =
  [ law "T ensure { } is T" (fun x -> ensure [] x.a) (fun x -> x.a);
    law "of two ensure, the inner one comes first" (fun x -> ensure two (ensure one x.a)) (fun x -> ensure (one @ two) x.a);
    law "ensure goes into until" (fun x -> ensure one (until x.anywhere x.a)) (fun x -> until x.anywhere (ensure one x.a));
    law "ensure goes into assure" (fun x -> ensure one (assure x.anywhere x.a))
      (fun x -> assure x.anywhere (ensure one x.a));
    law "ensure goes into within" (fun x -> ensure one (within 5 x.a)) (fun x -> within 5 (ensure one x.a));
    law "ensure goes into during" (fun x -> ensure one (during 5 x.a)) (fun x -> during 5 (ensure one x.a));
    law "fresh is its task" (fun x -> fresh [ "k" ] (x.c >> x.a)) (fun x -> x.c >> x.a);
    law "fresh is its task, in a context" (fun x -> fresh [ "k" ] (x.c >> x.a) >> x.b) (fun x -> (x.c >> x.a) >> x.b);
    law "the name of a key does not matter" (fun x -> fresh [ "k" ] (with_key "k" x.a))
      (fun x -> fresh [ "other" ] (with_key "other" x.a));
    law "fresh twice is fresh with two keys" (fun x -> fresh [ "k" ] (fresh [ "l" ] (with_key "l" x.a)))
      (fun x -> fresh [ "k"; "l" ] (with_key "l" x.a));
    law ">> is associative" (fun x -> (x.a >> x.b) >> x.c) (fun x -> x.a >> (x.b >> x.c));
    law "| is associative" (fun x -> (x.a <|> x.b) <|> x.c) (fun x -> x.a <|> (x.b <|> x.c));
    law_of_order "| is commutative" (fun x -> x.a <|> x.b) (fun x -> x.b <|> x.a);
    law "during a run during b run T is the shorter" (fun x -> during 5 (during 3 x.a)) (fun x -> during 3 x.a);
    law "during a run during b run T is the shorter, whichever it is" (fun x -> during 3 (during 5 x.a))
      (fun x -> during 3 x.a);
    law "watch T onError { propagate() } is T" (fun x -> watch x.a propagate) (fun x -> x.a);
    law "watch T onError { } is T" (fun x -> watch x.a []) (fun x -> x.a);
    law "oneOf with one branch is waitFor" (fun x -> branches One_of [ (x.g, x.a) ])
      (fun x -> expression (Wait_for (x.g, x.a)));
    law "allOf with one branch is waitFor" (fun x -> branches All_of [ (x.g, x.a) ])
      (fun x -> expression (Wait_for (x.g, x.a)));
    law "until { false } run T is T" (fun x -> until never x.a) (fun x -> x.a);
    law "assure { true } run T is T" (fun x -> assure always x.a) (fun x -> x.a);
    law "assure goes into >>" (fun x -> assure x.g (x.a >> x.b)) (fun x -> assure x.g x.a >> assure x.g x.b);
    law_of_order "assure goes into |" (fun x -> assure x.anywhere (x.a <|> x.b))
      (fun x -> assure x.anywhere x.a <|> assure x.anywhere x.b);
    law "assure, its errors ignored, is until" (fun x -> ignored (assure not_polling x.a))
      (fun x -> until polling (ignored x.a));
    law "within, its errors ignored, is during" (fun x -> ignored (within 5 x.a)) (fun x -> during 5 (ignored x.a));
    law "code that makes T is T after two silent steps, where nothing is held" ~named:as_actions
      ~applies:recruits_none_dismissed (fun x -> maker (x.c >> x.a))
      (fun x -> nothing_done >> (nothing_done >> (x.c >> x.a)));
    law "a branch with code is the branch with the task, where nothing is held" ~named:as_actions
      ~applies:recruits_none_dismissed (fun x -> branches One_of [ (x.g, maker (during 5 x.a)); (never, x.b) ])
      (fun x -> branches One_of [ (x.g, nothing_done >> (nothing_done >> during 5 x.a)); (never, x.b) ]);
    law ">> goes into oneOf from the right"
      (fun x -> branches One_of [ (x.g, x.a); (never, x.b) ] >> x.c)
      (fun x -> branches One_of [ (x.g, x.a >> x.c); (never, x.b >> x.c) ]);
    law "the branches of oneOf commute" (fun x -> branches One_of [ (x.g, x.a); (never, x.b); (x.g, x.c) ])
      (fun x -> branches One_of [ (x.g, x.c); (x.g, x.a); (never, x.b) ]);
    law "repeat 1, T is T" (fun x -> repeat ~rounds:1 x.a) (fun x -> x.a);
    law "repeat n, T is T >> repeat n - 1, T" (fun x -> repeat ~rounds:3 x.a) (fun x -> x.a >> repeat ~rounds:2 x.a);
    law "repeat m, repeat n, T is repeat m * n, T" (fun x -> repeat ~rounds:2 (repeat ~rounds:2 x.c))
      (fun x -> repeat ~rounds:4 x.c);
    law "repeat T is T >> repeat T" (fun x -> repeat (waiting x.c)) (fun x -> waiting x.c >> repeat (waiting x.c));
    law "repeat (T >> T') is T >> repeat (T' >> T)" (fun x -> repeat (x.c >> waiting x.b))
      (fun x -> x.c >> repeat (waiting x.b >> x.c));
    law "repeat repeat T is repeat T" (fun x -> repeat (repeat (waiting x.c))) (fun x -> repeat (waiting x.c));
    law "repeat repeat n, T is repeat T" (fun x -> repeat (repeat ~rounds:2 (waiting x.c)))
      (fun x -> repeat (waiting x.c));
    (* Both sides name [x.a]: which keys are queues depends on the whole program. *)
    law "nothing follows repeat T" (fun x -> repeat (waiting x.c) >> x.a)
      (fun x -> repeat (waiting x.c) >> (nothing_done >> x.a));
    law "the branches of allOf commute" (fun x -> branches All_of [ (x.g, x.a); (x.g, x.c) ])
      (fun x -> branches All_of [ (x.g, x.c); (x.g, x.a) ]) ]

(* {1 Laws of allocation} *)

(* Tasks that name no vehicles, and sets of vehicles. *)
let free_task =
  let plan name = call "task" [ Positional (expression (String name)) ] in
  let rec free depth =
    if depth = 0 then oneofl [ plan "p"; plan "q"; call "idle" [ Positional (expression (Integer 1)) ] ]
    else
      let* shape = int_bound 4 in
      let part () = free (depth - 1) in
      match shape with
      | 0 -> free 0
      | 1 -> map2 ( >> ) (part ()) (part ())
      | 2 -> map2 ( <|> ) (part ()) (part ())
      | 3 -> map2 (fun g t -> branches All_of [ (g, t); (never, t) ]) guard (part ())
      | _ -> map2 until guard (part ())
  in
  free 2

let some_vehicles =
  let* chosen = flatten_l (List.map (fun v -> map (fun yes -> (v, yes)) bool) vehicles) in
  match List.filter_map (fun (v, yes) -> if yes then Some v else None) chosen with
  | [] -> return [ "va" ]
  | vs -> return vs

let allocation_law name left right =
  let generator = Gen.quad free_task free_task some_vehicles some_vehicles in
  let program side (a, b, vs, ws) = executing (side a b vs ws) in
  let explored side x = Graph.explore (compile (program side x)) world in
  let print x = Generate.print (program left x) ^ "---\n" ^ Generate.print (program right x) in
  Property.case ~count:400 name ~print generator (fun x ->
      match explored left x, explored right x with
      | Some g, Some g' ->
        Property.count compared;
        Bisimulation.equivalent ~observed:Bisimulation.shared g g'
      | None, _ | _, None ->
        Property.count skipped;
        true)

let allocation_laws =
  [ allocation_law "T[V][W] is T[V & W]"
      (fun a _ vs ws -> on (on a vs) ws)
      (fun a _ vs ws -> expression (Index (a, binary Intersect (set vs) (set ws))));
    allocation_law "[V] goes into >>" (fun a b vs _ -> on (a >> b) vs) (fun a b vs _ -> on a vs >> on b vs);
    allocation_law "[V] goes into code" (fun a b vs _ -> on (maker a) vs <|> b) (fun a b vs _ -> maker (on a vs) <|> b);
    allocation_law "[V] goes into |" (fun a b vs _ -> on (a <|> b) vs) (fun a b vs _ -> on a vs <|> on b vs);
    allocation_law ">> is associative without vehicles" (fun a b vs _ -> (a >> b) >> on a vs)
      (fun a b vs _ -> a >> (b >> on a vs));
    allocation_law "| is associative without vehicles"
      (fun a b vs _ -> (a <|> b) <|> on a vs)
      (fun a b vs _ -> a <|> (b <|> on a vs)) ]

(* {1 Equations that are not laws} *)

(* [differ name left right] checks that the two tasks differ. *)
let differ name left right =
  let explored text = Graph.explore ~limit:5_000 (Pure_run.compile_exn text) world in
  let program t =
    Printf.sprintf "g = 0\nva = pick { id 'a' }\nvb = pick { id 'b' }\npost x: 1\nexecute(%s)\nmessage 'after'" t
  in
  Alcotest.test_case name `Quick (fun () ->
      match explored (program left), explored (program right) with
      | Some g, Some g' ->
        Alcotest.(check bool) "like itself" true (Bisimulation.equivalent g g);
        Alcotest.(check bool) "told apart" false (Bisimulation.equivalent g g')
      | None, _ | _, None -> Alcotest.fail "too many states")

(* A task whose end assigns n to g; and t, its errors ignored, and then g. *)
let ends_with n = Printf.sprintf "(idle(%d) ensure { g = %d })" n n
let shown t = Printf.sprintf "(watch (%s) onError { ignore() }) >> action { message \"${g}\" }" t

let p = "task('p')[va]"
let q = "task('q')[vb]"

let no_laws =
  [ differ "idle 0 is no unit of >>" ("idle(0) >> " ^ p) p;
    differ "idle 0 is no unit of |" (p ^ " | idle(0)") p;
    differ "action { } is no unit of >>" ("action { } >> " ^ p) p;
    differ "condition { true } is no unit of >>" ("condition { true } >> " ^ p) p;
    differ "| is not idempotent" "task('p') | task('p')" "task('p')";
    differ "| is not commutative where allocation chooses" "task('p') | task('q')" "task('q') | task('p')";
    differ ">> is not commutative" (p ^ " >> " ^ q) (q ^ " >> " ^ p);
    differ ">> does not go into |" (p ^ " >> (idle(1) | idle(2))")
      (Printf.sprintf "(%s >> idle(1)) | (task('p')[vb] >> idle(2))" p);
    differ "what follows | waits for both" (Printf.sprintf "(%s | idle(1)) >> %s" p q)
      (Printf.sprintf "%s | (idle(1) >> %s)" p q);
    differ ">> does not go into oneOf from the left" (p ^ " >> oneOf { when { consume x: 1 } then idle(1) }")
      (Printf.sprintf "oneOf { when { consume x: 1 } then %s >> idle(1) }" p);
    differ "watch does not go into >>" (Printf.sprintf "watch (%s >> %s) onError { ignore() }" p q)
      (Printf.sprintf "(watch %s onError { ignore() }) >> (watch %s onError { ignore() })" p q);
    differ "watch does not go into |" (Printf.sprintf "watch (%s | %s) onError { ignore() }" p q)
      (Printf.sprintf "(watch %s onError { ignore() }) | (watch %s onError { ignore() })" p q);
    differ "what a handler posts is seen beside it"
      (Printf.sprintf "(watch %s onError { post y: 1; ignore() }) | until { consume y: 1 } run idle(1)" p)
      (Printf.sprintf "(watch %s onError { ignore() }) | until { consume y: 1 } run idle(1)" p);
    differ "ignore() is no propagate()" (Printf.sprintf "watch %s onError { ignore() }" p) p;
    differ "until does not go into >>" (Printf.sprintf "until { poll(x: 1) } run (%s >> %s)" p q)
      (Printf.sprintf "(until { poll(x: 1) } run %s) >> (until { poll(x: 1) } run %s)" p q);
    differ "within is not during" (Printf.sprintf "%s within 5" p) (Printf.sprintf "during 5 run %s" p);
    differ "assure is not until" (Printf.sprintf "assure { poll(y: 1) } run %s" p)
      (Printf.sprintf "until { !poll(y: 1) } run %s" p);
    differ "assure { false } run T may start T" (Printf.sprintf "watch (assure { false } run %s) onError { ignore() }" p)
      "condition { true }";
    differ "until { true } run T is not nothing" (Printf.sprintf "until { true } run %s" p) "action { }";
    differ "during { n } is not during n" (Printf.sprintf "during { 5 } run %s" p) (Printf.sprintf "during 5 run %s" p);
    (* An error cuts off the parts of the inner | first, and those of a flat | from left to right. *)
    differ "until { false } is seen by an end beside it"
      (shown (Printf.sprintf "%s | until { false } run (%s | action { fail 'no' })" (ends_with 1) (ends_with 2)))
      (shown (Printf.sprintf "%s | %s | action { fail 'no' }" (ends_with 1) (ends_with 2)));
    differ "assure does not go into | where both sides ensure"
      (shown (Printf.sprintf "assure { poll(y: 1) } run (%s | %s)" (ends_with 1) (ends_with 2)))
      (shown (Printf.sprintf "(assure { poll(y: 1) } run (%s)) | assure { poll(y: 1) } run (%s)" (ends_with 1)
                (ends_with 2)));
    differ "allOf is not |"
      (Printf.sprintf "allOf { when { true } then %s\nwhen { true } then %s }" p q)
      (Printf.sprintf "(condition { true } >> %s) | (condition { true } >> %s)" p q);
    differ "[V + W] of | is not [V] and [W]" "(task('p') | task('q'))[va + vb]" "task('p')[vb] | task('q')[va]" ]

(* {1 The checker itself} *)

(* Bisimilarity is an equivalence on the graphs of random tasks, finer than having the same labels. *)
let checker =
  [ Property.case ~count:100 "is reflexive" ~print:(fun x -> print (program_of x x.a)) tasks (fun x -> alike x x.a x.a);
    Property.case ~count:150 "is symmetric" ~print:(fun x -> print (program_of x (x.a >> x.b))) tasks (fun x ->
        match graph x x.a, graph x x.b with
        | Some g, Some g' -> Bisimulation.equivalent g g' = Bisimulation.equivalent g' g
        | None, _ | _, None -> true) ]

(* The classic: a.(b + c) and a.b + a.c have the same runs, but choose at different moments. *)
let branching_time () =
  let graph text = Option.get (Graph.explore (Pure_run.compile_exn text) Generate.world) in
  let branch g k = Printf.sprintf "when { %s } then condition { consume %s: 1 }" g k in
  let late =
    "post b: 1, c: 1\nexecute oneOf { when { true } then oneOf { when { consume b: 1 } then idle(1)\n\
     when { consume c: 1 } then idle(1) } }"
  in
  let early =
    Printf.sprintf "post b: 1, c: 1\nexecute(oneOf { %s\n%s } >> idle(1))" (branch "true" "b") (branch "true" "c")
  in
  let labels g =
    List.sort_uniq String.compare
      (List.concat_map
         (List.map (fun ((t : Transition.t), _) -> Format.asprintf "%a" Label.pp t.label))
         (Array.to_list g.Graph.edges))
  in
  Alcotest.(check (list string)) "same labels" (labels (graph late)) (labels (graph early));
  Alcotest.(check bool) "told apart" false (Bisimulation.equivalent (graph late) (graph early))

let enough () =
  Printf.printf "%d pairs compared, %d too large\n" !compared !skipped;
  Alcotest.(check bool) "most graphs were small enough" true (!compared > 10 * !skipped)

let case name f = Alcotest.test_case name `Quick f

let () =
  Alcotest.run "laws"
    [ ("laws", laws);
      ("allocation", allocation_laws);
      ("no laws", no_laws);
      ("checker", (case "sees when a choice is made" branching_time :: checker) @ [ case "compared enough" enough ]) ]
