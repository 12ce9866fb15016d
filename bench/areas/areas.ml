(* Processor time for covering polygons of 1,000 corners, in any bearing, and for reading 10 MB of GeoJSON. *)

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
      | Ok things -> Printf.sprintf "%d areas" (List.length things)
      | Error why -> why)

let () =
  List.iter (fun polygon -> List.iter (cover polygon) [ 20.; 40.; 100. ]) polygons;
  import 10_000_000
