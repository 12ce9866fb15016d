open Dolphin_geo
open Dolphin_maps

let at ?(height = 0.) latitude longitude : Position.t = { latitude; longitude; height }
let case name run = Alcotest.test_case name `Quick run
let check = Alcotest.(check string)

let shown path text =
  match Map_file.read ~path text with
  | Error why -> "wrong: " ^ why
  | Ok { things; notes } ->
    let one (name, thing) =
      match (thing : (Map_file.thing, string) result) with
      | Error why -> Printf.sprintf "%s: flawed: %s" name why
      | Ok (Point p) -> Format.asprintf "%s: %a" name Position.pp p
      | Ok (Line ps) -> Printf.sprintf "%s: line of %d" name (List.length ps)
      | Ok (Area area) -> Printf.sprintf "%s: %.0f m2, %d corners" name (Area.size area) (List.length (Area.corners area))
    in
    String.concat "; " (List.map one things @ List.map (fun note -> "note: " ^ note) notes)

let feature ?(properties = {|{"name":"a"}|}) kind coordinates =
  Printf.sprintf {|{"type":"Feature","properties":%s,"geometry":{"type":"%s","coordinates":%s}}|} properties kind
    coordinates

let collection features =
  Printf.sprintf {|{"type":"FeatureCollection","features":[%s]}|} (String.concat "," features)

let square = "[[0,0],[0.001,0],[0.001,0.001],[0,0.001],[0,0]]"
