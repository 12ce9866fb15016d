open Dolphin_geo

let case name run = Alcotest.test_case name `Quick run
let at origin (north, east) = Wgs84.displace origin ~north ~east
let place latitude longitude = { Position.latitude; longitude; height = 0. }
let harbour = Place.apdl

(* Metres from a point of the plane to the nearest of the lines between [kept]. *)
let rec away kept (x, y) =
  match kept with
  | (ax, ay) :: ((bx, by) :: _ as rest) ->
    let dx = bx -. ax and dy = by -. ay in
    let square = (dx *. dx) +. (dy *. dy) in
    let share = if square = 0. then 0. else (((x -. ax) *. dx) +. ((y -. ay) *. dy)) /. square in
    let share = Float.max 0. (Float.min 1. share) in
    Float.min (Float.hypot (x -. ax -. (share *. dx)) (y -. ay -. (share *. dy))) (away rest (x, y))
  | [ (ax, ay) ] -> Float.hypot (x -. ax) (y -. ay)
  | [] -> infinity

let check what origin offsets expected =
  case what (fun () ->
      let points = List.map (at origin) offsets in
      let kept = Polyline.simplified ~tolerance:0.5 points in
      Alcotest.(check int) "points" expected (List.length kept))

let line n = List.init n (fun i -> (float_of_int i, 0.))

(* There and back again, 10 m apart: all of it corners, on rows of 100 m. *)
let rows n = List.init n (fun i -> ((if i mod 4 = 1 || i mod 4 = 2 then 100. else 0.), 10. *. float_of_int (i / 2)))

let shapes =
  [ check "none" harbour [] 0;
    check "one" harbour (line 1) 1;
    check "two at one place" harbour [ (0., 0.); (0., 0.) ] 2;
    check "a straight line" harbour (line 900) 2;
    check "there and back on it" harbour (line 400 @ List.rev (line 300)) 3;
    check "round and back" harbour [ (0., 0.); (100., 0.); (100., 100.); (0., 100.); (0., 0.) ] 5;
    check "a corner of a metre" harbour [ (0., 0.); (50., 1.); (100., 0.) ] 3;
    check "one of a decimetre" harbour [ (0., 0.); (50., 0.1); (100., 0.) ] 2;
    check "rows, all of them corners" harbour (rows 5000) 5000;
    check "the antimeridian" (place (-17.) 180.) [ (0., -300.); (0., -100.); (0., 100.); (20., 300.); (0., 500.) ] 4;
    check "a pole" (place 89.999 0.) [ (0., 0.); (111., 0.); (222., 0.); (222., 300.) ] 3 ]

let faithful =
  let offset = QCheck2.Gen.(pair (float_range (-30.) 30.) (float_range (-30.) 30.)) in
  let print = QCheck2.Print.(list (pair float float)) in
  Test_support.Property.case ~count:300 "nothing is left out by more than the tolerance" ~print
    QCheck2.Gen.(list_size (int_range 0 25) offset)
    (fun offsets ->
       let points = List.map (fun offset -> (at harbour offset, offset)) offsets in
       let kept = Polyline.simplified ~tolerance:8. (List.map fst points) in
       let kept_offsets = List.filter_map (fun p -> List.assq_opt p points) kept in
       let rec within kept points =
         match kept, points with
         | [], _ -> true
         | _ :: _, [] -> false
         | k :: ks, (p, _) :: ps -> if k == p then within ks ps else within kept ps
       in
       let ends = function [] -> [] | first :: _ as ps -> [ first; List.nth ps (List.length ps - 1) ] in
       within kept points
       && ends kept_offsets = ends offsets
       && List.for_all (fun offset -> away kept_offsets offset <= 8.01) offsets)

let () = Alcotest.run "polylines" [ ("simplified", faithful :: shapes) ]
