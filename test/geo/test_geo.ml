open Dolphin_geo

let at ?(height = 0.) latitude longitude : Position.t = { latitude; longitude; height }

let case name run = Alcotest.test_case name `Quick run

let law ?(count = 1000) name = Test_support.Property.case ~count name

let position = Alcotest.testable Position.pp Position.equal

let area = function Ok area -> area | Error e -> Alcotest.failf "%a" Area.pp_error e

let metres accuracy = Alcotest.float accuracy

(* {1 Positions} *)

let make_checks_ranges () =
  let rejected ~latitude ~longitude ~height =
    match Position.make ~latitude ~longitude ~height with
    | Ok _ -> "accepted"
    | Error error -> Fmt.str "%a" Position.pp_error error
  in
  let check = Alcotest.(check string) in
  check "pole and date line" "accepted" (rejected ~latitude:(-90.) ~longitude:180. ~height:(-50.));
  check "latitude" "latitude 90.5 is not from -90 to 90 degrees" (rejected ~latitude:90.5 ~longitude:0. ~height:0.);
  check "not a number" "latitude nan is not from -90 to 90 degrees"
    (rejected ~latitude:Float.nan ~longitude:0. ~height:0.);
  check "longitude" "longitude -181 is not from -180 to 180 degrees"
    (rejected ~latitude:0. ~longitude:(-181.) ~height:0.);
  List.iter
    (fun (height, shown) ->
       check "height" (Printf.sprintf "height %s is not from -20000 to 1000000 metres" shown)
         (rejected ~latitude:0. ~longitude:0. ~height))
    [ (Float.infinity, "inf"); (Float.nan, "nan"); (1e308, "1e+308"); (-20001., "-20001"); (1000001., "1e+06") ]

let angles () =
  let check = Alcotest.(check (float 1e-15)) in
  check "half a turn" Float.pi (Angle.radians 180.);
  check "an eighth, the other way" (-45.) (Angle.degrees (-.Float.pi /. 4.))

let printing () =
  let check expected position = Alcotest.(check string) expected expected (Fmt.str "%a" Position.pp position) in
  check "(41.185242, -8.704803)" Place.apdl;
  check "(0.000000, -0.000001, -12.5 m)" (at ~height:(-12.5) (-1e-9) (-1e-6));
  Alcotest.(check string)
    "area" "(41.178192, -8.595431) ^ 2000 m"
    (Fmt.str "%a" Area.pp (area (Area.circle Place.feup 2000.)))

(* {1 Known values} *)

(* One degree around 45° north, and along the equator; a quarter of a meridian. *)
let degrees_of_arc () =
  let distance = Wgs84.distance in
  Alcotest.check (metres 0.1) "latitude at 45" 111_131.8 (distance (at 44.5 7.) (at 45.5 7.));
  Alcotest.check (metres 0.001) "longitude at 0" 111_319.491 (distance (at 0. 179.5) (at 0. (-179.5)));
  Alcotest.check (metres 0.001) "equator to pole" 10_001_965.729 (distance (at 0. 30.) (at 90. 0.))

(* The worked example of Geoscience Australia: Flinders Peak to Buninyong. *)
let flinders_peak_to_buninyong () =
  let angle degrees minutes seconds = degrees +. (minutes /. 60.) +. (seconds /. 3600.) in
  let flinders_peak = at (-.angle 37. 57. 3.72030) (angle 144. 25. 29.52440) in
  let buninyong = at (-.angle 37. 39. 10.15610) (angle 143. 55. 35.38390) in
  Alcotest.check (metres 0.001) "distance" 54_972.271 (Wgs84.distance flinders_peak buninyong);
  Alcotest.check (Alcotest.float 1e-5) "bearing" (angle 306. 52. 5.37) (Wgs84.bearing flinders_peak buninyong);
  Alcotest.check (Alcotest.float 1e-5) "bearing back"
    (angle 127. 10. 25.07)
    (Wgs84.bearing buninyong flinders_peak);
  let reached = Wgs84.move flinders_peak ~bearing:(angle 306. 52. 5.37) 54_972.271 in
  Alcotest.check (metres 0.01) "moved there" 0. (Wgs84.distance reached buninyong)

let bearings () =
  let check = Alcotest.check (Alcotest.float 1e-9) in
  check "north" 0. (Wgs84.bearing (at 41. (-8.)) (at 42. (-8.)));
  check "south" 180. (Wgs84.bearing (at 41. (-8.)) (at 40. (-8.)));
  check "east" 90. (Wgs84.bearing (at 0. 179.) (at 0. (-179.)));
  check "west" 270. (Wgs84.bearing (at 0. 1.) (at 0. 0.));
  check "nowhere" 0. (Wgs84.bearing Place.apdl Place.apdl)

(* The inverse formula does not converge here: the sphere is used instead, as the interface states. *)
let opposite_points () =
  let half_meridian = 20_003_931.46 in
  List.iter
    (fun (a, b) ->
       let error = Float.abs (Wgs84.distance a b -. half_meridian) /. half_meridian in
       Alcotest.(check bool) "within 0.6 %" true (error < 0.006))
    [ (at 90. 0., at (-90.) 0.); (at 0. 0., at 0.5 179.7); (at 10. 20., at (-10.) (-160.)); (at 0. 0., at 0. 180.) ]

let places () =
  Alcotest.(check (option position)) "APDL" (Some (at 41.185242 (-8.704803))) (Place.find "APDL");
  Alcotest.(check (option position)) "FEUP" (Some (at 41.1781918 (-8.5954308))) (Place.find "FEUP");
  Alcotest.(check (option position)) "another" None (Place.find "apdl");
  Alcotest.check (metres 5.) "nine kilometres apart" 9_211. (Wgs84.distance Place.apdl Place.feup)

let movement () =
  let a = at ~height:0. 41.18 (-8.7) and b = at ~height:100. 41.19 (-8.7) in
  Alcotest.check position "at the start" a (Wgs84.towards a b (-1.));
  Alcotest.check position "at the end, not beyond" b (Wgs84.towards a b 1e6);
  Alcotest.check position "no way to go" a (Wgs84.towards a a 10.);
  let middle = Wgs84.interpolate a b 0.5 in
  Alcotest.check (metres 1e-6) "height of the middle" 50. middle.height;
  Alcotest.check (Alcotest.float 1e-8) "latitude of the middle" 41.185 middle.latitude;
  Alcotest.check_raises "no number" (Invalid_argument "Wgs84.displace: nan") (fun () ->
      ignore (Wgs84.displace a ~north:Float.nan ~east:0.))

let beyond_the_pole () =
  let reached = Wgs84.displace (at 89.99 20.) ~north:5_000. ~east:0. in
  Alcotest.check (Alcotest.float 1e-6) "the other side" (-160.) reached.longitude

let areas () =
  Alcotest.(check bool) "negative radius" true (Result.is_error (Area.circle Place.apdl (-1.)));
  Alcotest.(check bool) "endless radius" true (Result.is_error (Area.circle Place.apdl Float.infinity));
  let area = area (Area.circle Place.apdl 9_000.) in
  Alcotest.(check bool) "centre" true (Area.contains area { Place.apdl with height = 1e4 });
  Alcotest.(check bool) "outside" false (Area.contains area Place.feup)

(* {1 GeographicLib's test set} *)

let geodesics () =
  let file = open_in "geodesics.txt" in
  let rec lines found = match input_line file with line -> lines (line :: found) | exception End_of_file -> found in
  let read line =
    match List.map float_of_string (String.split_on_char ' ' line) with
    | [ lat1; lon1; course1; lat2; lon2; course2; metres ] -> ((at lat1 lon1, course1), (at lat2 lon2, course2), metres)
    | _ -> Alcotest.fail line
  in
  let all = List.map read (List.filter (fun line -> line <> "" && line.[0] <> '#') (lines [])) in
  close_in file;
  Alcotest.(check int) "lines" 100 (List.length all);
  all

(* How far apart two positions are, however near; the inverse formula is not what is judged here. *)
let apart a b = Wgs84.straight (Wgs84.cartesian a) (Wgs84.cartesian b)

let worst error lines = List.fold_left (fun most line -> Float.max most (error line)) 0. lines
let within what accuracy found = if found > accuracy then Alcotest.failf "%s: an error of %g m" what found

let on_the_test_set () =
  let all = geodesics () in
  let moved ((a, bearing), (b, _), metres) = apart b (Wgs84.move a ~bearing metres) in
  within "move" 1e-4 (worst moved all);
  let measured ((a, _), (b, _), metres) = Float.abs (Wgs84.distance a b -. metres) in
  let converges (_, _, metres) = metres < 19_900_000. in
  let far, others = List.partition (fun line -> not (converges line)) all in
  within "distance" 1e-4 (worst measured others);
  within "distance of opposite points" (0.006 *. 2e7) (worst measured far)

(* The same geodesics, their first metres. *)
let short_ways () =
  let lengths = [ 0.5; 20.; 300.; 10_000. ] in
  let error ((a, bearing), _, _) =
    let one metres = Float.abs (Wgs84.distance a (Wgs84.move a ~bearing metres) -. metres) in
    List.fold_left (fun most metres -> Float.max most (one metres)) 0. lengths
  in
  within "up to 10 km" 1e-6 (worst error (geodesics ()))

let ways () =
  let a = at 41.18 (-8.7) in
  let b = Wgs84.move a ~bearing:90. 100. in
  let c = Wgs84.move b ~bearing:0. 50. in
  let check what expected way =
    Alcotest.check (metres 1e-6) what 0. (apart expected (Option.get (Wgs84.along [ a; b; c ] way)))
  in
  check "before the start" a (-1.);
  check "at the first corner" b 100.;
  check "after it" (Wgs84.move b ~bearing:0. 20.) 120.;
  check "beyond the end" c 1e9;
  Alcotest.(check (option position)) "of nothing" None (Wgs84.along [] 1.)

(* {1 Coordinates as texts} *)

let read text = match Coordinates.of_string text with Ok p -> Fmt.str "%a" Position.pp p | Error why -> why

let texts () =
  let check expected texts = List.iter (fun text -> Alcotest.(check string) text expected (read text)) texts in
  check "(41.185000, -8.706667)"
    [ "41\xc2\xb011.1'N 8\xc2\xb042.4'W"; "41\xc2\xb011'6\"N, 8\xc2\xb042'24\"W";
      "41\xc2\xb0 11\xe2\x80\xb2 6\xe2\x80\xb3 N  8\xc2\xb0 42\xe2\x80\xb2 24\xe2\x80\xb3 W"; "N 41 11.1 W 8 42.4";
      "41 11.1 N 8 42.4 W"; "8\xc2\xb042.4'W 41\xc2\xb011.1'N"; "41d11m6s N 8d42m24s W"; "41\xc2\xb011'6''N 8\xc2\xb042'24''W";
      "41.185, -8.7066666667"; "+41.185 -8.7066666667"; "41.185N 8.7066666667W"; "41\xc2\xb011.1', -8\xc2\xb042.4'" ];
  check "(-0.500000, -0.250000)" [ "-0 30, -0 15"; "0 30 S 0 15 W"; "-0\xc2\xb030', -0\xc2\xb015'" ];
  check "(33.300000, 44.400000)"
    [ "38S 444140.545 3684706.356"; "38 north 444140.545 3684706.356"; "38n 444140.545, 3684706.356" ];
  check "(-33.900000, 18.400000)" [ "34H 259583.222 6245888.045"; "34s 259583.222 6245888.045" ];
  check "(41.185242, -8.704803)" [ "29T 524756.897 4559363.009" ];
  check "(83.900000, 179.900000)" [ "60X 534390.831E 9317795.754N" ]

let bad_texts () =
  let check (text, why) =
    Alcotest.(check string) text (Printf.sprintf "'%s' is not a position: %s" text why) (read text)
  in
  List.iter check
    [ ("", "a latitude and a longitude are missing, as in 41\xc2\xb011.1'N 8\xc2\xb042.4'W");
      ("41.5", "a latitude and a longitude are missing, as in 41\xc2\xb011.1'N 8\xc2\xb042.4'W");
      ("Porto", "it cannot be read"); ("41 61 N 8 0 W", "minutes are below 60, not 61");
      ("91 N 8 W", "latitude 91 is not from -90 to 90 degrees"); ("41N 8N", "it has no latitude and longitude, by its letters");
      ("41N, 8", "both have a letter of N, S, E and W, or none has");
      ("-41N 8W", "a sign and a letter of N, S, E and W exclude each other");
      ("41.5 11.1 N 8 W", "only the last of degrees, minutes and seconds has a fraction");
      ("41 11 6 3 N 8 W", "degrees, minutes and seconds come in this order, each once");
      ("41'11\xc2\xb0N 8W", "degrees, minutes and seconds come in this order, each once");
      ("41..5, 8", "a number of it cannot be read"); ("1, 2, 3", "a number is missing");
      ("61T 524756 4559363", "UTM has the zones 1 to 60, not 61");
      ("29T 4559363 524756", "eastings of UTM are from 100000 to 900000 m, not 4559363");
      ( "34S 259583 6245888",
        "the letter S of UTM is a band of latitudes, and these metres are not in it; write 34 south for the southern half" ) ];
  Alcotest.(check string) "long" "the text is too long for a position" (read (String.make 10_000 '1'))

(* Reading ends for every text. *)
let any_text = QCheck2.Gen.(string_size ~gen:(oneofl [ '4'; '1'; '.'; ' '; 'N'; 'W'; 's'; '-'; ','; '\''; '\xc2'; '\xb0' ]) (int_bound 12))
let reads_anything text = match Coordinates.of_string text with Ok p -> Float.abs p.latitude <= 90. | Error _ -> true

(* {1 Areas with corners} *)

let origin = at 41.18 (-8.7)
let place (east, north) = Wgs84.displace origin ~north ~east
let polygon ?holes corners = Area.polygon ?holes:(Option.map (List.map (List.map place)) holes) (List.map place corners)
let square x y side = [ (x, y); (x +. side, y); (x +. side, y +. side); (x, y +. side) ]
let said = function Ok a -> Fmt.str "%a" Area.pp a | Error e -> Fmt.str "%a" Area.pp_error e

(* The sizes that GeographicLib's PolygonArea gives. *)
let sizes () =
  let check what accuracy expected corners =
    let error = Float.abs ((Area.size (area (Area.polygon corners)) /. expected) -. 1.) in
    if error > accuracy then Alcotest.failf "%s: an error of %g" what error
  in
  check "10 km" 1e-6 100691293.69378662 [ at 41.1 (-8.8); at 41.1 (-8.68); at 41.19 (-8.68); at 41.19 (-8.8) ];
  check "around a pole" 1e-4 24952305678.0 [ at 89. 0.; at 89. 90.; at 89. 180.; at 89. (-90.) ];
  check "over 180 degrees" 1e-4 5900061489.721558
    [ at (-17.) 179.5; at (-17.) (-179.5); at (-16.5) (-179.4); at (-16.5) 179.6 ];
  Alcotest.check (metres 0.1) "circle" 31415.9 (Area.size (area (Area.circle origin 100.)))

let where () =
  let check = Alcotest.(check bool) in
  let pole = area (Area.polygon [ at 89. 0.; at 89. 90.; at 89. 180.; at 89. (-90.) ]) in
  check "the pole" true (Area.contains pole (at 90. 57.));
  check "not the other" false (Area.contains pole (at (-90.) 57.));
  let line = area (Area.polygon [ at (-17.) 179.5; at (-17.) (-179.5); at (-16.) (-179.5); at (-16.) 179.5 ]) in
  check "180" true (Area.contains line (at (-16.5) 180.));
  check "-180" true (Area.contains line (at (-16.5) (-180.)));
  check "0" false (Area.contains line (at (-16.5) 0.));
  let corners (a, b) = Fmt.str "%a %a" Position.pp a Position.pp b in
  Alcotest.(check string) "its box" "(-17.000000, 179.500000) (-16.000000, -179.500000)" (corners (Area.bounds line));
  Alcotest.(check string)
    "the pole's box" "(89.000000, -180.000000) (90.000000, 180.000000)" (corners (Area.bounds pole));
  let ring = area (polygon ~holes:[ square 25. 25. 50. ] (square 0. 0. 100.)) in
  let has p = Area.contains ring (place p) in
  Alcotest.(check (list bool)) "inside, in the hole, on its rim, outside" [ true; false; true; false ]
    [ has (10., 10.); has (50., 50.); has (25., 50.); has (110., 50.) ];
  Alcotest.check (metres 0.01) "its centre" 0. (Wgs84.distance (Area.centre ring) (place (50., 50.)))

let no_areas () =
  let check expected found = Alcotest.(check string) expected expected (said found) in
  check "a polygon does not cross itself: its sides from corner 1 and from corner 3 meet"
    (polygon [ (0., 0.); (100., 100.); (100., 0.); (0., 100.) ]);
  check "the corners of a polygon are not on one line" (polygon [ (0., 0.); (0., 100.); (0., 50.) ]);
  check "a polygon has three corners or more that differ, not 2" (polygon [ (0., 0.); (9., 9.); (9., 9.); (0., 0.) ]);
  check "an area has 20000 corners at most, not 20001"
    (polygon (List.init 20001 (fun i -> (float_of_int i, float_of_int (i * i mod 977)))));
  check "an area reaches at most 200 km from its middle" (Area.polygon [ at 0. 0.; at 10. 0.; at 0. 10. ]);
  check "an area reaches at most 200 km from its middle" (Area.polygon [ at 0. 0.; at 0. 120.; at 0. (-120.) ]);
  check "hole 1 is not inside of the polygon, or meets another hole"
    (polygon ~holes:[ square 50. 50. 100. ] (square 0. 0. 100.));
  check "hole 2 is not inside of the polygon, or meets another hole"
    (polygon ~holes:[ square 10. 10. 50.; square 40. 40. 50. ] (square 0. 0. 100.));
  check "hole 1: a polygon has three corners or more that differ, not 1"
    (polygon ~holes:[ [ (1., 1.) ] ] (square 0. 0. 9.));
  check "it takes more than 0 m, not 0" (Area.corridor [ origin ] 0.);
  let a = area (polygon (square 0. 0. 100.)) in
  check "nothing is left: the area is empty" (Area.intersection a (area (polygon (square 200. 0. 10.))));
  check "nothing is left: the area is empty" (Area.difference a a);
  check "nothing is left: the area is empty" (Area.offset a (-51.));
  check "a radius is 0 m or more, not nan" (Area.offset a Float.nan);
  (match Area.grid a 0.001 with Error Intricate -> () | _ -> Alcotest.fail "a grid of that many points");
  match Area.of_rings [ List.rev_map place (square 0. 0. 100.) ] with
  | Error Rims -> ()
  | found -> Alcotest.fail (said found)

let operations () =
  let size found = Float.round (Area.size (area found)) in
  let check what expected found = Alcotest.check (metres 1.) what expected (size found) in
  let a = area (polygon (square 0. 0. 100.)) and b = area (polygon (square 50. 50. 100.)) in
  check "union" 17500. (Area.union a b);
  check "intersection" 2500. (Area.intersection a b);
  check "difference" 7500. (Area.difference a b);
  check "neighbours" 20000. (Area.union a (area (polygon (square 100. 0. 100.))));
  check "a hole" 7500. (Area.difference a (area (polygon (square 25. 25. 50.))));
  check "two apart" 20000. (Area.union a (area (polygon (square 300. 0. 100.))));
  check "with a circle" 7851. (Area.intersection a (area (Area.circle (place (50., 50.)) 50.)));
  check "smaller" 6400. (Area.offset a (-10.));
  check "larger" 14312. (Area.offset a 10.);
  check "hull" 20000. (Area.hull [ a; area (polygon (square 100. 0. 100.)) ]);
  check "corridor" 1078. (Area.corridor [ place (0., 0.); place (100., 0.) ] 10.);
  Alcotest.(check int) "grid" 100 (List.length (Result.get_ok (Area.grid a 10.)));
  let back = Area.of_rings (match Area.offset a 10. with Ok (Shape s) -> Area.rings s | _ -> []) in
  Alcotest.(check bool) "rings" true (Area.equal (area (Area.offset a 10.)) (area back));
  Alcotest.(check bool) "either order of corners" true
    (Area.equal a (area (polygon (List.rev (square 0. 0. 100.)))))

(* Star-shaped polygons and points, some on the same few lines, so that corners and sides coincide. *)
let polygons =
  let open QCheck2.Gen in
  let coordinate = oneof [ map float_of_int (map (fun i -> 20 * i) (int_bound 5)); float_range 0. 100. ] in
  let corners = list_size (int_range 3 8) (pair coordinate coordinate) in
  triple corners corners (list_repeat 20 (pair coordinate coordinate))

let print_polygons (a, b, points) =
  let pp = Fmt.(Dump.list (Dump.pair float float)) in
  Fmt.str "%a %a %a" pp a pp b pp points

(* Metres from [p] to the side from [a] to [b]. *)
let from_side (px, py) ((ax, ay), (bx, by)) =
  let dx = bx -. ax and dy = by -. ay in
  let square = (dx *. dx) +. (dy *. dy) in
  let share = if square = 0. then 0. else (((px -. ax) *. dx) +. ((py -. ay) *. dy)) /. square in
  let share = Float.max 0. (Float.min 1. share) in
  Float.hypot (px -. ax -. (share *. dx)) (py -. ay -. (share *. dy))

let sides corners = List.combine corners (List.tl corners @ [ List.hd corners ])

(* Points near a rim may be on either side of it. *)
let agrees (corners, corners', points) =
  match polygon corners, polygon corners' with
  | Ok a, Ok b ->
    let clear p = List.for_all (fun side -> from_side p side > 0.01) (sides corners @ sides corners') in
    let points = List.filter clear points in
    let holds f found =
      let has p =
        match found with
        | Ok area -> Area.contains area (place p)
        | Error Area.Empty -> false
        | Error e -> Alcotest.failf "%a" Area.pp_error e
      in
      List.for_all (fun p -> has p = f (Area.contains a (place p)) (Area.contains b (place p))) points
    in
    holds ( || ) (Area.union a b) && holds ( && ) (Area.intersection a b)
    && holds (fun a b -> a && not b) (Area.difference a b)
    && holds ( || ) (Result.bind (Area.union a b) (Area.union b))
  | _ -> true

(* {1 Laws} *)

let position_generator =
  let open QCheck2.Gen in
  map3
    (fun latitude longitude height -> at ~height latitude longitude)
    (float_range (-85.) 85.) (float_range (-180.) 180.) (float_range (-100.) 1000.)

let displacement = QCheck2.Gen.float_range (-100_000.) 100_000.

let moved = QCheck2.Gen.triple position_generator displacement displacement

let print_moved (a, north, east) = Fmt.str "%a %f %f" Position.pp a north east

let close accuracy a b = Float.abs (a -. b) <= accuracy

let displaced_that_far (a, north, east) =
  let b = Wgs84.displace a ~north ~east in
  close 1e-3 (Wgs84.distance a b) (hypot north east) && b.height = a.height

let displaced_that_way (a, north, east) =
  QCheck2.assume (hypot north east > 1.);
  let bearing = Wgs84.bearing a (Wgs84.displace a ~north ~east) in
  let error = Float.rem (bearing -. (atan2 east north *. 180. /. Float.pi) +. 720.) 360. in
  Float.min error (360. -. error) < 1e-3

let displaced_back (a, north, east) =
  QCheck2.assume (Float.abs a.Position.latitude < 60.);
  let north = north /. 10. and east = east /. 10. in
  let back = Wgs84.displace (Wgs84.displace a ~north ~east) ~north:(-.north) ~east:(-.east) in
  let length = hypot north east in
  Wgs84.distance a back <= 1e-3 +. (1.1 *. length *. length *. tan (Float.pi /. 3.) /. 6.35e6)

let symmetric (a, north, east) =
  let b = Wgs84.displace a ~north:(80. *. north) ~east:(80. *. east) in
  close 1e-3 (Wgs84.distance a b) (Wgs84.distance b a)

(* Thirty equal steps arrive, each as long as asked for. *)
let towards_reaches (a, north, east) =
  let b = { (Wgs84.displace a ~north ~east) with height = a.height +. 50. } in
  let step = (hypot north east /. 30.) +. 0.001 in
  let rec walk position steps =
    if steps = 0 then Position.equal position b
    else
      let next = Wgs84.towards position b step in
      let length = Wgs84.distance position next in
      (close 2e-3 length step || Position.equal next b) && walk next (steps - 1)
  in
  walk a 30

(* The chord of an arc of length d is shorter by d³ / 24 R². *)
let straight_is_shorter (a, north, east) =
  let a = { a with Position.height = 0. } in
  let b = Wgs84.displace a ~north ~east in
  let ground = Wgs84.distance a b in
  let straight = Wgs84.straight (Wgs84.cartesian a) (Wgs84.cartesian b) in
  straight <= ground +. 1e-3 && ground -. straight <= 1e-3 +. (1.1 *. (ground ** 3.) /. (24. *. (6.33e6 ** 2.)))

let rim_belongs (a, north, east) =
  let radius = hypot north east in
  let rim = Wgs84.displace a ~north ~east in
  QCheck2.assume (radius > 0.01);
  Area.contains (area (Area.circle a radius)) rim && not (Area.contains (area (Area.circle a (radius -. 0.01))) rim)

let () =
  let law name property = law name moved ~print:print_moved property in
  Alcotest.run "geo"
    [
      ("position", [ case "ranges" make_checks_ranges; case "printing" printing; case "angles" angles ]);
      ( "known values",
        [
          case "degrees of arc" degrees_of_arc;
          case "Flinders Peak to Buninyong" flinders_peak_to_buninyong;
          case "bearings" bearings;
          case "opposite points" opposite_points;
          case "places" places;
          case "movement" movement;
          case "beyond the pole" beyond_the_pole;
          case "areas" areas;
        ] );
      ( "GeographicLib",
        [ case "its test set" on_the_test_set; case "short ways" short_ways; case "along a way" ways ] );
      ( "areas",
        [ case "sizes" sizes; case "contains" where; case "no areas" no_areas; case "operations" operations;
          Test_support.Property.case ~count:2000 "points of operations" ~print:print_polygons polygons agrees ] );
      ( "coordinates",
        [ case "texts" texts; case "bad texts" bad_texts;
          Test_support.Property.case ~count:5000 "any text" ~print:Fun.id any_text reads_anything ] );
      ( "laws",
        [
          law "a displacement is as long as asked for" displaced_that_far;
          law "a displacement goes where asked to" displaced_that_way;
          law "there and back" displaced_back;
          law "distance is symmetric" symmetric;
          law "steps towards a position reach it" towards_reaches;
          law "the rim belongs to the area" rim_belongs;
          law "straight lines are shorter" straight_is_shorter;
        ] );
    ]
