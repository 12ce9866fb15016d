open Dolphin_geo

(* {1 The same by brute force, on geodesics} *)

let at latitude longitude = { Position.latitude; longitude; height = 0. }

(* Along a side of some kilometres the distance from a point falls and then rises. *)
let rec least f low high n =
  if n = 0 then f ((low +. high) /. 2.)
  else
    let a = low +. ((high -. low) /. 3.) and b = high -. ((high -. low) /. 3.) in
    if f a < f b then least f low b (n - 1) else least f a high (n - 1)

let from_side p (a, b) =
  if Position.equal a b then Wgs84.distance p a
  else
    let metres share = Wgs84.distance p (Wgs84.interpolate a b share) in
    Float.min (least metres 0. 1. 44) (Float.min (metres 0.) (metres 1.))

let sides ring = List.mapi (fun i a -> (a, List.nth ring ((i + 1) mod List.length ring))) ring
let nearest p lines = List.fold_left (fun d line -> Float.min d (from_side p line)) infinity lines

let depth area p =
  match area with
  | Area.Circle { centre; radius } -> radius -. Wgs84.distance centre p
  | Shape shape ->
    let from_rim = nearest p (List.concat_map sides (Area.rings shape)) in
    if Area.contains area p then from_rim else -.from_rim

let excess (rule : Fence.rule) radius p =
  let margin = rule.margin +. radius in
  match rule.side with Inside -> margin -. depth rule.area p | Outside -> margin +. depth rule.area p

let samples (s : Fence.stretch) = List.init 9 (fun i -> Wgs84.interpolate s.from s.towards (float_of_int i /. 8.))
let worst rule (s : Fence.stretch) =
  List.fold_left (fun most p -> Float.max most (excess rule s.radius p)) neg_infinity (samples s)

let slack = 0.03

let agrees (rule, way) =
  match Fence.breach (Fence.make [ rule ]) way with
  | None -> List.for_all (fun s -> worst rule s <= Fence.tolerance +. slack) way
  | Some { rule = 0; stretch; at; by } ->
    let before = List.filteri (fun i _ -> i < stretch) way and s = List.nth way stretch in
    let apart = Wgs84.distance s.from s.towards /. 32. in
    List.for_all (fun s -> worst rule s <= Fence.tolerance +. slack) before
    && from_side at (s.from, s.towards) <= slack
    && Float.abs (excess rule s.radius at -. by) <= slack
    && by > Fence.tolerance
    && worst rule s <= by +. apart +. slack
  | Some _ -> false

(* {1 Random ones} *)

let origins = [ at 41.185 (-8.705); at (-17.5) 179.999; at 84.2 20.; at 0. 0.; at 0.001 (-179.9995) ]

open QCheck2.Gen

let place origin =
  map2 (fun bearing metres -> Wgs84.move origin ~bearing metres) (float_range 0. 360.) (float_range 0. 1000.)

(* The corners of a star, which never cross. *)
let star origin least most =
  let* n = int_range 3 8 in
  let* metres = list_repeat n (float_range least most) in
  let corner i r = Wgs84.move origin ~bearing:(float_of_int i *. 360. /. float_of_int n) r in
  return (List.mapi corner metres)

let area origin =
  let circle = map (fun radius -> Area.circle origin radius) (float_range 0. 800.) in
  let polygon = map (fun corners -> Area.polygon corners) (star origin 100. 800.) in
  let with_hole =
    map2 (fun corners hole -> Area.polygon corners ~holes:[ hole ]) (star origin 300. 800.) (star origin 5. 60.) in
  let fallback = Area.circle origin 100. in
  let made = oneof [ circle; polygon; with_hole ] in
  map (function Ok area -> area | Error _ -> Result.get_ok fallback) made

let way origin =
  let* n = int_range 1 4 in
  let* places = list_repeat (n + 1) (place origin) in
  let* radii = list_repeat n (oneof [ return 0.; float_range 0. 120. ]) in
  let stretch i radius = { Fence.from = List.nth places i; towards = List.nth places (i + 1); radius } in
  return (List.mapi stretch radii)

let case =
  let* origin = oneofl origins in
  let* side = oneofl [ Fence.Inside; Outside ] in
  let* area = area origin in
  let* margin = oneof [ return 0.; float_range 0. 150. ] in
  map (fun way -> ({ Fence.side; area; margin }, way)) (way origin)

let pp_stretch ppf (s : Fence.stretch) =
  Fmt.pf ppf "%a-%a r %g" Position.pp s.from Position.pp s.towards s.radius

let print ((rule : Fence.rule), way) =
  Fmt.str "%s %a margin %g: %a"
    (match rule.side with Inside -> "inside" | Outside -> "outside")
    Area.pp rule.area rule.margin Fmt.(list ~sep:comma pp_stretch) way

(* Several rules at once break as each of them does. *)
let first_of_all (rules, way) =
  let key (b : Fence.breach) rule = (b.stretch, rule) in
  let alone i rule = Option.map (fun b -> (key b i, b.by)) (Fence.breach (Fence.make [ rule ]) way) in
  let expected = List.sort compare (List.filter_map Fun.id (List.mapi alone rules)) in
  match Fence.breach (Fence.make rules) way, expected with
  | None, [] -> true
  | Some b, (first, by) :: _ -> key b b.rule = first && Float.abs (b.by -. by) <= slack
  | Some _, [] | None, _ :: _ -> false

let several =
  let* origin = oneofl origins in
  let* elsewhere = place (Wgs84.move origin ~bearing:70. 14_000.) in
  let rule =
    let* side = oneofl [ Fence.Outside; Outside; Inside ] in
    let* area = oneof [ area origin; area elsewhere ] in
    map (fun margin -> { Fence.side; area; margin }) (float_range 0. 50.)
  in
  pair (list_size (int_range 1 5) rule) (way origin)

(* Ways of tens of kilometres that come from anywhere, and past or through the area. *)
let from_afar =
  let* origin = oneofl origins in
  let* area = area origin in
  let* margin = oneof [ return 0.; float_range 0. 150. ] in
  let* bearing = float_range 0. 360. and* turn = float_range (-3.) 3. in
  let* before = float_range 0. 60_000. and* behind = float_range 0. 60_000. in
  let* radius = oneof [ return 0.; float_range 0. 120. ] in
  let from = Wgs84.move origin ~bearing before in
  let towards = Wgs84.move origin ~bearing:(bearing +. 180. +. turn) behind in
  return ({ Fence.side = Outside; area; margin }, [ { Fence.from; towards; radius } ])

(* The rules that a place breaks, anywhere around the area. *)
let of_places ((rule : Fence.rule), p) =
  let by = excess rule 0. p in
  match Fence.breaches_at (Fence.make [ rule ]) p with
  | [] -> by <= Fence.tolerance +. slack
  | [ (0, found) ] -> Float.abs (found -. by) <= slack +. (1e-4 *. by)
  | _ -> false

let rule_and_place =
  let* origin = oneofl origins in
  let* side = oneofl [ Fence.Outside; Outside; Inside ] in
  let* area = area origin in
  let* margin = oneof [ return 0.; float_range 0. 150. ] in
  let* bearing = float_range 0. 360. in
  let* metres = oneof [ float_range 0. 1_000.; float_range 0. 20_000. ] in
  return ({ Fence.side; area; margin }, Wgs84.move origin ~bearing metres)

let without_margins (rules, p) =
  let bare = List.map (fun (rule : Fence.rule) -> { rule with margin = 0. }) rules in
  Fence.breaches_at (Fence.without_margins (Fence.make rules)) p = Fence.breaches_at (Fence.make bare) p

(* {1 Ways beside each other} *)

let apart a b =
  let of_stretch (s : Fence.stretch) (t : Fence.stretch) =
    List.fold_left
      (fun d p -> Float.min d (from_side p (t.from, t.towards) -. s.radius -. t.radius))
      infinity (samples s)
  in
  List.fold_left (fun d s -> List.fold_left (fun d t -> Float.min d (of_stretch s t)) d b) infinity a

let meets (within, a, b) =
  match Fence.nearest ~within a b with
  | None -> apart a b >= within -. Fence.tolerance -. slack
  | Some { first; second; place; distance } ->
    let s = List.nth a first and t = List.nth b second in
    let between = from_side place (t.from, t.towards) -. s.radius -. t.radius in
    distance < within && Float.abs (distance -. Float.max 0. between) <= slack
    && from_side place (s.from, s.towards) <= slack
    && distance <= Float.max 0. (apart a b) +. slack

let two_ways =
  let* origin = oneofl origins in
  let* elsewhere = place origin in
  triple (float_range 1. 600.) (way origin) (way elsewhere)

let print_two (within, a, b) =
  Fmt.str "within %g: %a and %a" within Fmt.(list pp_stretch) a Fmt.(list pp_stretch) b

(* {1 Special ones} *)

let square = Result.get_ok (Area.polygon [ at 41. (-8.); at 41. (-7.99); at 41.01 (-7.99); at 41.01 (-8.) ])
let rule ?(margin = 0.) side area = { Fence.side; area; margin }
let line from towards = { Fence.from; towards; radius = 0. }
let point p = line p p
let breach rule way = Fence.breach (Fence.make [ rule ]) way
let breaks name expected rule way = Alcotest.(check bool) name expected (breach rule way <> None)

let rims () =
  let a = at 41. (-8.) and b = at 41. (-7.99) in
  breaks "along the rim, inside" false (rule Inside square) [ line a b ];
  breaks "along the rim, outside" false (rule Outside square) [ line a b ];
  breaks "a corner, inside" false (rule Inside square) [ point a ];
  breaks "with a margin" true (rule Inside square ~margin:1.) [ point a ];
  breaks "outside with a margin" true (rule Outside square ~margin:1.) [ point a ];
  breaks "out and in again" true (rule Inside square) [ line a (at 40.9999 (-7.995)); line (at 40.9999 (-7.995)) b ];
  breaks "across" true (rule Outside square) [ line (at 41.005 (-8.1)) (at 41.005 (-7.9)) ];
  breaks "past a corner" false (rule Outside square) [ line (at 40.999 (-8.001)) (at 41.011 (-8.001)) ]

let degenerate () =
  let p = at 41.005 (-7.995) in
  let nothing = Result.get_ok (Area.circle p 0.) in
  let thin = Result.get_ok (Area.polygon [ at 41. (-8.); at 41. (-7.99); at 41.0000001 (-7.995) ]) in
  breaks "a point within itself" false (rule Inside nothing) [ point p ];
  breaks "a disc within a point" true (rule Inside nothing) [ { (point p) with radius = 1. } ];
  breaks "a margin wider than the area" true (rule Inside square ~margin:1000.) [ point p ];
  breaks "a point out of a point" true (rule Outside nothing ~margin:0.1) [ point p ];
  breaks "over a sliver" true (rule Outside thin ~margin:1.) [ line (at 40.99 (-7.995)) p ];
  breaks "no way at all" false (rule Inside square) [];
  Alcotest.(check bool) "no rules" true (Fence.breach (Fence.make []) [ point p ] = None)

let far () =
  let porto = at 41.185 (-8.705) and boston = at 42.36 (-71.05) in
  let middle = Wgs84.interpolate porto boston 0.5 in
  let near = Result.get_ok (Area.circle middle 1000.) in
  let beside = Result.get_ok (Area.circle (Wgs84.move middle ~bearing:0. 3000.) 1000.) in
  breaks "across the sea" true (rule Outside near) [ line porto boston ];
  breaks "3 km beside" false (rule Outside beside) [ line porto boston ];
  breaks "on the other side of the globe" false (rule Outside near)
    [ line (at (-42.) 139.9) (at (-42.) 139.8); line (at (-43.) 140.2) (at (-42.) 139.7) ];
  breaks "not inside there" true (rule Inside near) [ point (at (-42.) 139.9) ];
  let wide = Result.get_ok (Area.circle porto 15_000_000.) in
  breaks "half the globe" false (rule Inside wide) [ line porto boston ];
  breaks "a little more" true (rule Inside wide) [ line porto (at (-41.) 160.) ]

let metres () =
  let by rule way = match breach rule way with Some b -> b.by | None -> nan in
  let out = Wgs84.move (at 41.005 (-7.99)) ~bearing:90. 12.5 in
  Alcotest.(check (float 0.01)) "beyond" 12.5 (by (rule Inside square) [ point out ]);
  Alcotest.(check (float 0.01)) "and the margin" 32.5 (by (rule Inside square ~margin:20.) [ point out ]);
  Alcotest.(check (float 0.01)) "too near" 7.5 (by (rule Outside square ~margin:20.) [ point out ]);
  Alcotest.(check (list (pair int (float 0.01)))) "of a place" [ (0, 12.5); (2, 7.5) ]
    (Fence.breaches_at
       (Fence.make [ rule Inside square; rule Outside square; rule Outside square ~margin:20. ])
       out)

let () =
  let law = Test_support.Property.case in
  Alcotest.run "fence"
    [ ("laws",
       [ law "as by brute force" ~count:150 ~print case agrees;
         law "from afar" ~count:150 ~print from_afar agrees;
         law "places" ~count:500 rule_and_place of_places
           ~print:(fun (rule, p) -> Fmt.str "%s %a" (print (rule, [])) Position.pp p);
         law "without margins" ~count:100 (pair (map fst several) (place (List.hd origins))) without_margins
           ~print:(fun (_, p) -> Fmt.str "%a" Position.pp p);
         law "the first of several" ~count:100 several first_of_all
           ~print:(fun (rules, way) -> String.concat "; " (List.map (fun rule -> print (rule, way)) rules));
         law "ways beside each other" ~count:100 ~print:print_two two_ways meets ]);
      ("cases",
       [ Alcotest.test_case "rims" `Quick rims; Alcotest.test_case "degenerate areas" `Quick degenerate;
         Alcotest.test_case "far away" `Quick far; Alcotest.test_case "metres" `Quick metres ]) ]
