open Dolphin_app
open Dolphin_json
open Field
open Exchange
module Request = Dolphin_http.Request
module Scenario = Dolphin_scenario.Scenario

let position (p : Dolphin_geo.Position.t) : members =
  [ ("latitude", Canonical.number p.latitude); ("longitude", Canonical.number p.longitude) ]

let vehicle (v : Scenario.vehicle) : json =
  `Assoc ([ ("vehicle", `String v.id); ("type", `String v.kind); ("payload", texts v.payload);
            ("battery", Canonical.number v.battery) ] @ position v.position)

let plan (p : Scenario.plan) : json =
  `Assoc (("plan", `String p.name) :: Option.fold p.place ~none:[] ~some:position)

let parameter_of (p : Dolphin_syntax.Parameters.t) : json =
  let why = Option.fold p.description ~none:[] ~some:(fun text -> [ ("description", `String text) ]) in
  `Assoc
    ([ ("name", `String p.name); ("as", `String (Format.asprintf "%a" Dolphin_syntax.Parameters.pp p)) ] @ why)

(* The inputs of the fleet, each key with its values as people type them. *)
let suggested (s : Scenario.t) (program : Dolphin_semantics.Core.program) : json =
  let of_key key =
    let typed x =
      let text = Format.asprintf "%a" Dolphin_semantics.Value.pp x in
      match Typed_input.read (key ^ ": " ^ text) with
      | Ok [ (k, y) ] when k = key && Dolphin_semantics.Value.compare x y = 0 -> Some text
      | Ok _ | Error _ -> None
    in
    let values (i : Scenario.input) = if i.key = key then List.concat i.rounds else [] in
    match List.sort_uniq compare (List.filter_map typed (List.concat_map values s.inputs)) with
    | [] -> None
    | found -> Some (key, texts found)
  in
  `Assoc (List.filter_map of_key program.inputs)

let get (w : Workspace.t) r =
  let* path = parameter r "program" in
  let* program = Workspace.program w path in
  let* fleet = Workspace.fleet w ~program:program.path (Request.parameter r "fleet") in
  let fleet_path = Option.bind fleet.path (Folder.inside w.folder) in
  let fences = Dolphin_plans.Fences.list program.program.fences @ fleet.scenario.fences in
  Ok
    (`Assoc
       [ ("inputs", texts program.program.inputs);
         ("suggested", suggested fleet.scenario program.program);
         ("parameters", `List (List.map parameter_of program.parameters));
         ("fleet", of_option (fun path -> `String path) fleet_path);
         ("vehicles", `List (List.map vehicle fleet.scenario.vehicles));
         ("fences", `List (List.map (Codec.write On_map.fence) fences));
         ("plans", `List (List.map plan fleet.scenario.plans)) ])
