open Dolphin_geo
open Ground

let crown =
  polygon [ (0., 0.); (120., 0.); (120., 90.); (100., 30.); (80., 90.); (60., 30.); (40., 90.); (20., 30.); (0., 90.) ]

let spread sizes = List.fold_left Float.max 0. sizes -. List.fold_left Float.min infinity sizes

(* Parts on a grid of a millimetre: a point of a rim may be a millimetre away from its exact place. *)
let are_parts ?(share = 1e-6) ~neck whole n parts =
  let sizes = List.map Area.size parts in
  let rims = 1e-3 *. List.fold_left (fun sum part -> sum +. rim part) 0. parts in
  let slack = rims +. (share *. Area.size whole) in
  let none f a b = match f a b with Error Area.Empty -> true | Error _ -> false | Ok c -> Area.size c <= slack in
  let rec apart = function
    | [] -> true
    | part :: others -> List.for_all (none Area.intersection part) others && apart others
  in
  (* With a centimetre more or less, so that rounding does not matter. *)
  let connected part =
    match Result.bind (Area.offset part neck) (fun part -> Area.split part 2) with
    | Error (Area.Pieces _) -> false
    | Error _ | Ok _ -> true
  in
  let united =
    List.fold_left (fun sum part -> Result.bind sum (Area.union part)) (Ok (List.hd parts)) (List.tl parts)
  in
  List.length parts = n
  && spread sizes <= slack && apart parts && List.for_all connected parts
  && none Area.difference whole (area united) && none Area.difference (area united) whole

let parts () =
  let check ?share what n whole =
    let whole = area whole in
    match Area.split whole n with
    | Ok found -> Alcotest.(check bool) (Fmt.str "%s in %d" what n) true (are_parts ?share ~neck:(-0.05) whole n found)
    | Error e -> Alcotest.failf "%s in %d: %a" what n Area.pp_error e
  in
  List.iter
    (fun n ->
       check "a square" n (polygon (square 0. 0. 100.));
       check "a circle" n (Area.circle origin 100.);
       check "a ring" n (polygon ~holes:[ square 25. 25. 50. ] (square 0. 0. 100.));
       check "a crown" n crown;
       check "a mast on steps" n
         (polygon
            [ (0., 0.); (100., 0.); (100., 20.); (60., 20.); (60., 100.); (40., 100.); (40., 20.); (20., 20.);
              (20., 40.); (0., 40.) ]);
       check "a U, its lower part a third" n
         (polygon [ (0., 0.); (100., 0.); (100., 130.); (70., 130.); (70., 30.); (30., 30.); (30., 130.); (0., 130.) ]);
       check "a corridor that turns" n
         (Area.corridor (List.map place [ (0., 0.); (300., 0.); (300., 200.); (50., 200.); (50., 100.) ]) 20.))
    [ 1; 2; 3; 4; 7; 12 ];
  (* A cut along a step, a millimetre too high, takes the step too. *)
  check "a mast on steps of two parts" 4
    (polygon
       [ (0., 0.); (100., 0.); (100., 20.); (80., 20.); (80., 20.); (60., 20.); (60., 100.); (40., 100.); (40., 20.);
         (20., 20.); (20., 40.); (0., 40.) ]);
  check "a square" 100 (polygon (square 0. 0. 100.));
  check ~share:1e-3 "around the pole" 5 (Area.polygon [ at 89. 0.; at 89. 90.; at 89. 180.; at 89. (-90.) ]);
  check ~share:1e-3 "across 180 degrees" 5
    (Area.polygon [ at (-17.) 179.5; at (-17.) (-179.5); at (-16.) (-179.5); at (-16.) 179.5 ]);
  let quarters = Result.get_ok (Area.split (area (polygon (square 0. 0. 100.))) 4) in
  Alcotest.(check (list (float 0.1))) "quarters are square" [ 200.; 200.; 200.; 200. ] (List.map rim quarters)

(* Their upper sides cross by a millimetre, along 100 m. *)
let almost_the_same () =
  let a = [| (49992, -46645); (49993, 53355); (-50007, 53356); (-50008, -46644) |] in
  let b = [| (-50008, -46644); (49992, -46644); (49993, 53356); (-50007, 53355) |] in
  match Arrangement.combine (fun a b -> a && not b) [ a ] [ b ] with
  | Some [] -> ()
  | Some _ -> Alcotest.fail "something is left"
  | None -> Alcotest.fail "too many crossings"

let no_parts () =
  let check expected n found =
    Alcotest.(check string) expected expected
      (match Area.split (area found) n with Ok _ -> "parts" | Error e -> Fmt.str "%a" Area.pp_error e)
  in
  check "an area is split into 1 to 100 parts, not 0" 0 crown;
  check "an area is split into 1 to 100 parts, not 101" 101 crown;
  let two = Area.union (area (polygon (square 0. 0. 100.))) (area (polygon (square 300. 0. 100.))) in
  check "an area of 2 pieces has no connected parts of equal size: split each of them" 2 two

let splits (corners, n) =
  let whole = area (polygon corners) in
  match Area.split whole n with
  | Ok parts -> are_parts ~neck:0.01 whole n parts
  | Error (Area.Uncut _) -> true
  | Error e -> Alcotest.failf "%a" Area.pp_error e

let case name run = Alcotest.test_case name `Quick run

let () =
  Alcotest.run "parts of areas"
    [ ( "split",
        [ case "areas" parts; case "no parts" no_parts; case "areas that are almost the same" almost_the_same;
          Test_support.Property.case ~count:100 "polygons" ~print:(fun (p, n) -> Fmt.str "%a in %d" pp_corners p n)
            QCheck2.Gen.(pair corners (int_range 1 9)) splits ] ) ]
