open Dolphin_geo
open Ground

let settings ?bearing ?(overlap = 0.) ?(turn = 0.) spacing = { Coverage.spacing; bearing; overlap; turn }

let points settings area =
  match Coverage.points settings area with Ok ps -> ps | Error e -> Alcotest.failf "%a" Coverage.pp_error e

let plane = Plane.around origin
let on_plane = Plane.of_position plane

let nearest p segments = List.fold_left (fun least s -> Float.min least (distance_to p s)) infinity segments

(* {1 Laws} *)

let rims = function
  | Area.Circle _ -> []
  | Shape s -> List.concat_map (fun ring -> segments (List.map on_plane (ring @ [ List.hd ring ]))) (Area.rings s)

let distance_from area p =
  if Area.contains area (Plane.to_position plane p) then 0. else nearest p (rims area)

let is_along bearing ((ax, ay), (bx, by)) =
  let angle = Angle.radians (90. -. bearing) in
  let across = ((by -. ay) *. cos angle) -. ((bx -. ax) *. sin angle) in
  Float.abs across <= 0.003


let between share ((ax, ay), (bx, by)) = (ax +. (share *. (bx -. ax)), ay +. (share *. (by -. ay)))

let covers (corners, holes, bearing, spacing, probes) =
  let whole = match polygon ~holes corners with Ok whole -> whole | Error _ -> area (polygon corners) in
  match Coverage.points (settings ~bearing spacing) whole with
  | Error (Coverage.Wide _) -> true
  | Error e -> Alcotest.failf "%a" Coverage.pp_error e
  | Ok way ->
    let way = segments (List.map on_plane way) in
    let strips = List.filter (is_along bearing) way in
    let inside = List.filter (fun p -> Area.contains whole (Plane.to_position plane p)) probes in
    let corners = List.map on_plane (Area.corners whole) in
    let slack = 0.005 +. (1e-3 *. spacing) in
    let shares = [ 0.; 0.1; 0.3; 0.5; 0.7; 0.9; 1. ] in
    let on segments = List.concat_map (fun s -> List.map (fun share -> between share s) shares) segments in
    List.for_all (fun p -> nearest p strips <= (spacing /. 2.) +. slack) (inside @ corners)
    && List.for_all (fun p -> distance_from whole p <= (spacing /. 2.) +. slack) (on strips)
    && List.for_all (fun p -> distance_from whole p <= (1.5 *. spacing) +. slack) (on way)

let hole = [ (-8., -5.); (8., -5.); (3., 6.) ]

let covered =
  let open QCheck2.Gen in
  let probes = list_repeat 40 (pair (float_range (-100.) 150.) (float_range (-100.) 110.)) in
  let drawn = tup4 corners (float_range 0. 360.) (float_range 3. 60.) probes in
  let with_holes holes = map (fun (corners, b, s, probes) -> (corners, holes, b, s, probes)) drawn in
  oneof [ with_holes []; with_holes [ hole ] ]

let print_covered (corners, holes, bearing, spacing, _) =
  Fmt.str "%a without %d, bearing %f, spacing %f" pp_corners corners (List.length holes) bearing spacing

(* {1 Known ways} *)

let rounded way =
  let metres p =
    let x, y = on_plane p in
    (Float.to_int (Float.round x), Float.to_int (Float.round y))
  in
  List.map metres way

let ways () =
  let check what expected settings corners =
    Alcotest.(check (list (pair int int))) what expected (rounded (points settings (area (polygon corners))))
  in
  let square = square 0. 0. 100. in
  check "northwards" [ (25, 0); (25, 100); (75, 100); (75, 0) ] (settings ~bearing:0. 50.) square;
  check "eastwards, with turns" [ (-15, 75); (115, 75); (115, 25); (-15, 25) ]
    (settings ~bearing:90. ~turn:15. 50.) square;
  check "a spacing that does not divide" [ (17, 0); (17, 100); (50, 100); (50, 0); (83, 0); (83, 100) ]
    (settings ~bearing:0. 49.) square;
  check "overlap" [ (17, 0); (17, 100); (50, 100); (50, 0); (83, 0); (83, 100) ]
    (settings ~bearing:0. ~overlap:0.3 50.) square;
  check "along the longer side by itself" [ (0, 30); (200, 30); (200, 10); (0, 10) ] (settings 20.)
    [ (0., 0.); (200., 0.); (200., 40.); (0., 40.) ];
  check "a U"
    [ (5, 50); (5, 0); (15, 0); (15, 10); (25, 0); (25, 10); (35, 10); (35, 0); (45, 0); (45, 50) ]
    (settings ~bearing:0. 10.)
    [ (0., 0.); (50., 0.); (50., 50.); (40., 50.); (40., 10.); (10., 10.); (10., 50.); (0., 50.) ]

let bad () =
  let check expected settings =
    let found = Coverage.points settings (area (polygon (square 0. 0. 100.))) in
    let said = match found with Ok _ -> "points" | Error e -> Fmt.str "%a" Coverage.pp_error e in
    Alcotest.(check string) expected expected said
  in
  check "the spacing of strips is above 0 m, not 0" (settings 0.);
  check "the spacing of strips is above 0 m, not nan" (settings Float.nan);
  check "the spacing, 150 m, is wider than the area, which is 141 m across" (settings 150.);
  check "the area is too intricate: too many points or sides would arise" (settings 1e-5);
  check "the area is too intricate: too many points or sides would arise" (settings ~bearing:7. 0.01);
  check "strips overlap by 0 to 0.9 of their width, not by 10; write 10.percent" (settings ~overlap:10. 20.);
  check "a turn takes 0 to 10000 m, not -1" (settings ~turn:(-1.) 20.);
  check "a bearing is a finite number of degrees, not inf" (settings ~bearing:infinity 20.);
  match Coverage.points (settings 1.) (area (Area.circle origin 0.)) with
  | Error (Coverage.Area Area.Empty) -> ()
  | Ok _ | Error _ -> Alcotest.fail "a point is no area"

let anywhere () =
  List.iter
    (fun corners -> ignore (points (settings ~bearing:30. 5000.) (area (Area.polygon corners)) : Position.t list))
    [ [ at 89. 0.; at 89. 90.; at 89. 180.; at 89. (-90.) ];
      [ at (-17.) 179.5; at (-17.) (-179.5); at (-16.) (-179.5); at (-16.) 179.5 ] ]

(* {1 The optimum} *)

(* The shortest of all orders and directions, by the sets of strips that are done. *)
let optimum parts =
  let n = Array.length parts in
  let ground = Tour.make parts in
  let strip i = { Tour.part = i / 2; rightwards = i mod 2 = 0 } in
  let long i = Tour.length ground [ strip i ] in
  let gap = Array.init (2 * n) (fun i ->
      Array.init (2 * n) (fun j -> Tour.length ground [ strip i; strip j ] -. long i -. long j)) in
  let best = Array.make_matrix (1 lsl n) (2 * n) infinity in
  for i = 0 to (2 * n) - 1 do best.(1 lsl (i / 2)).(i) <- long i done;
  for set = 1 to (1 lsl n) - 1 do
    for i = 0 to (2 * n) - 1 do
      if best.(set).(i) < infinity then
        for j = 0 to (2 * n) - 1 do
          if set land (1 lsl (j / 2)) = 0 then begin
            let next = set lor (1 lsl (j / 2)) in
            best.(next).(j) <- Float.min best.(next).(j) (best.(set).(i) +. gap.(i).(j) +. long j)
          end
        done
    done
  done;
  Array.fold_left Float.min infinity best.((1 lsl n) - 1)

(* A hundred polygons, always the same. *)
let near_the_optimum () =
  let rand = Random.State.make [| 19 |] in
  let worst = ref 1. and exact = ref 0 and others = ref 0 in
  while !exact + !others < 100 do
    let corners = QCheck2.Gen.generate1 ~rand corners in
    let angle = Random.State.float rand Float.pi and spacing = 6. +. Random.State.float rand 30. in
    let _, region = Result.get_ok (Area.on_plane (area (polygon corners))) in
    let parts = Bands.make (Option.get (Slabs.make ~angle region)) ~most:(1000. *. spacing) in
    let n = Array.length parts in
    if n >= 2 && n <= 11 then begin
      incr (if n <= Tour.most_exact then exact else others);
      let ground = Tour.make parts in
      let ratio = Tour.length ground (Tour.shortest ground) /. optimum parts in
      if n <= Tour.most_exact then Alcotest.(check (float 1e-3)) "up to 8 strips" 1. ratio;
      worst := Float.max !worst ratio
    end
  done;
  Printf.printf "%d polygons up to 8 strips, %d with more; at most %.4f of the optimum\n" !exact !others !worst;
  Alcotest.(check bool) "at most 1.1" true (!worst <= 1.1 && !others >= 20)

let case name run = Alcotest.test_case name `Quick run

let () =
  Alcotest.run "coverage"
    [ ("ways", [ case "known" ways; case "bad settings" bad; case "around the pole, across 180 degrees" anywhere ]);
      ("orders", [ case "the optimum" near_the_optimum ]);
      ("laws", [ Test_support.Property.case ~count:200 "what is covered" ~print:print_covered covered covers ]) ]
