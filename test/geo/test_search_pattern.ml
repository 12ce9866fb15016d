open Dolphin_geo
open Ground

let plane = Plane.around origin

let rounded way =
  let metres p =
    let x, y = Plane.of_position plane p in
    (Float.to_int (Float.round x), Float.to_int (Float.round y))
  in
  List.map metres way

let way = function Ok way -> way | Error e -> Alcotest.failf "%a" Search_pattern.pp_error e
let check what expected found = Alcotest.(check (list (pair int int))) what expected (rounded (way found))

let squares () =
  check "northwards" [ (0, 0); (0, 10); (10, 10); (10, -10); (-10, -10); (-10, 20) ]
    (Search_pattern.expanding_square origin ~spacing:10. ~radius:10. ~bearing:0.);
  check "eastwards" [ (0, 0); (10, 0); (10, -10); (-10, -10); (-10, 10); (20, 10) ]
    (Search_pattern.expanding_square origin ~spacing:10. ~radius:3. ~bearing:90.)

let sectors () =
  check "northwards"
    [ (0, 0); (0, 100); (87, 50); (0, 0); (-87, -50); (-87, 50); (0, 0); (87, -50); (0, -100); (0, 0) ]
    (Search_pattern.sector origin ~radius:100. ~bearing:0.);
  let found = way (Search_pattern.sector origin ~radius:100. ~bearing:77.) in
  Alcotest.(check (float 0.01)) "nine legs" 900. (length found)

let bad () =
  let check expected found =
    let said = match found with Ok _ -> "points" | Error e -> Fmt.str "%a" Search_pattern.pp_error e in
    Alcotest.(check string) expected expected said
  in
  let square = Search_pattern.expanding_square origin and spiral = Search_pattern.spiral origin in
  check "the spacing of a search is above 0 m, not 0" (square ~spacing:0. ~radius:10. ~bearing:0.);
  check "the radius of a search is above 0 and at most 200 km, not nan m"
    (spiral ~spacing:1. ~radius:Float.nan ~bearing:0.);
  check "a bearing is a finite number of degrees, not inf" (Search_pattern.sector origin ~radius:1. ~bearing:infinity);
  check "this search would have 360018 points, more than 10000" (spiral ~spacing:1. ~radius:10_000. ~bearing:0.);
  check "this search would have 1000000000000000 points, more than 10000" (square ~spacing:1e-300 ~radius:10_000. ~bearing:0.)

(* A point of the square in the direction of the bearing, and one of the disc. A point between three legs of a square
   is up to 0.586 spacings away from them. The chords of a spiral are nearer to its
   middle than its arcs, by less than half a percent. *)
let covers (spacing, turns, bearing, (x, y)) =
  let radius = spacing *. turns in
  let near share found p =
    let way = segments (List.map (Plane.of_position plane) (way found)) in
    List.exists (fun s -> distance_to p s <= (share *. spacing) +. (0.005 *. radius) +. 0.01) way
  in
  let angle = Angle.radians bearing in
  let ahead = x *. radius and right = y *. radius in
  let in_square = ((ahead *. sin angle) +. (right *. cos angle), (ahead *. cos angle) -. (right *. sin angle)) in
  let metres = radius *. Float.abs x and course = Float.pi *. y in
  near (2. -. sqrt 2.) (Search_pattern.expanding_square origin ~spacing ~radius ~bearing) in_square
  && near 0.5 (Search_pattern.spiral origin ~spacing ~radius ~bearing) (metres *. sin course, metres *. cos course)

let drawn =
  let open QCheck2.Gen in
  tup4 (float_range 1. 100.) (float_range 0.1 12.) (float_range (-360.) 360.)
    (pair (float_range (-1.) 1.) (float_range (-1.) 1.))

let print (spacing, turns, bearing, (x, y)) = Fmt.str "spacing %f, turns %f, bearing %f, (%f, %f)" spacing turns bearing x y
let case name run = Alcotest.test_case name `Quick run

let () =
  Alcotest.run "searches"
    [ ("ways", [ case "expanding squares" squares; case "sectors" sectors; case "bad numbers" bad ]);
      ("laws", [ Test_support.Property.case ~count:1000 "what is covered" ~print drawn covers ]) ]
