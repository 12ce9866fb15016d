(* Processor time for covering polygons of 1,000 corners, in any bearing, for reading 10 MB of GeoJSON, and for fences:
   1,000 plans of 100 segments against 100 polygons, and how near 100 such plans come to each other. *)

open Dolphin_geo

let timed what f =
  let before = Sys.time () in
  let found = f () in
  Printf.printf "%-28s %.3f s  %s\n%!" what (Sys.time () -. before) found

(* {1 Coverage} *)

let corners = 1_000

(* Corner [i] is [far i degrees] from the middle, in metres. *)
let around far =
  let corner i =
    let degrees = 360. *. float_of_int i /. float_of_int corners in
    Wgs84.move Place.apdl ~bearing:degrees (far i degrees)
  in
  List.init corners corner

let waves ~count ~high degrees = 1_000. +. (high *. sin (Angle.radians (degrees *. count)))

let polygons =
  let any = Random.State.make [| 7 |] in
  [ ("smooth", around (fun _ degrees -> waves ~count:5. ~high:300. degrees));
    ("wavy", around (fun _ degrees -> waves ~count:20. ~high:500. degrees));
    ("rough", around (fun _ _ -> 1_000. +. Random.State.float any 200.));
    ("spiky", around (fun i _ -> if i mod 2 = 0 then 1_000. else 600. +. Random.State.float any 300.)) ]

let cover (name, corners) spacing =
  let settings = { Coverage.spacing; bearing = None; overlap = 0.; turn = 0. } in
  let found () =
    match Area.polygon corners with
    | Error e -> Fmt.str "%a" Area.pp_error e
    | Ok area -> (
        match Coverage.points settings area with
        | Ok points -> Printf.sprintf "%d points" (List.length points)
        | Error e -> Fmt.str "%a" Coverage.pp_error e)
  in
  timed (Printf.sprintf "%s, every %g m" name spacing) found

(* {1 Fences} *)

(* Rows north of a place; areas of 12 corners beside them, of which none is entered, and others around all of them,
   which none leaves. *)
let rows n =
  let from = Wgs84.displace Place.apdl ~north:(float_of_int (n * 10)) ~east:0. in
  let corner i = Wgs84.displace from ~north:(float_of_int (i * 3)) ~east:(if i mod 2 = 0 then 0. else 400.) in
  let corners = Array.init 101 corner in
  List.init 100 (fun i -> { Fence.from = corners.(i); towards = corners.(i + 1); radius = 0. })

let around_all =
  let centre = Wgs84.displace Place.apdl ~north:5_000. ~east:200. in
  let bay i =
    let corner k = Wgs84.move centre ~bearing:(float_of_int k *. 30.) (float_of_int (7_000 + (i * 10))) in
    { Fence.side = Inside; area = Result.get_ok (Area.polygon (List.init 12 corner)); margin = 20. }
  in
  List.init 50 bay

let rocks =
  let rock i =
    let centre = Wgs84.displace Place.apdl ~north:(float_of_int (i * 200)) ~east:(-200.) in
    let corner k = Wgs84.move centre ~bearing:(float_of_int k *. 30.) (if k mod 2 = 0 then 40. else 60.) in
    { Fence.side = Outside; area = Result.get_ok (Area.polygon (List.init 12 corner)); margin = 20. }
  in
  List.init 50 rock

let fences () =
  let plans = List.init 1_000 rows in
  timed "1,000 plans, 100 polygons" (fun () ->
      let fences = Fence.make (rocks @ around_all) in
      let broken = List.filter (fun plan -> Fence.breach fences plan <> None) plans in
      Printf.sprintf "%d break one" (List.length broken));
  let few = List.init 100 (fun i -> rows (i * 40)) in
  timed "4,950 pairs of plans" (fun () ->
      let rec near = function
        | [] -> 0
        | plan :: others ->
          let is_near other = Fence.nearest ~within:50. plan other <> None in
          List.length (List.filter is_near others) + near others
      in
      Printf.sprintf "%d come near" (near few))

(* {1 Maps} *)

let geojson bytes =
  let text = Buffer.create bytes in
  Buffer.add_string text {|{"type":"FeatureCollection","features":[|};
  let rec add i =
    if Buffer.length text < bytes then begin
      if i > 0 then Buffer.add_char text ',';
      let x = -8.7 +. (float_of_int (i mod 100) /. 1e3) and y = 41. +. (float_of_int (i / 100) /. 1e3) in
      let corner (dx, dy) = Printf.sprintf "[%.6f,%.6f]" (x +. (dx /. 1e3)) (y +. (dy /. 1e3)) in
      let rim = List.map corner [ (0., 0.); (0.9, 0.); (0.9, 0.9); (0., 0.9); (0., 0.) ] in
      Printf.bprintf text
        {|{"type":"Feature","properties":{"name":"cell %d"},"geometry":{"type":"Polygon","coordinates":[[%s]]}}|} i
        (String.concat "," rim);
      add (i + 1)
    end
  in
  add 0;
  Buffer.add_string text "]}";
  Buffer.contents text

let import bytes =
  let text = geojson bytes in
  timed (Printf.sprintf "%d MB of GeoJSON" (bytes / 1_000_000)) (fun () ->
      match Dolphin_maps.Map_file.read ~path:"cells.geojson" text with
      | Ok map -> Printf.sprintf "%d areas" (List.length map.things)
      | Error why -> why)

let () =
  fences ();
  List.iter (fun polygon -> List.iter (cover polygon) [ 20.; 40.; 100. ]) polygons;
  import 10_000_000
