open Dolphin_imc

let spoken =
  [ "Abort"; "Announce"; "EntityList"; "EntityParameter"; "EntityParameters"; "EstimatedState"; "FuelLevel";
    "Heartbeat"; "LogBookEntry";
    "PathPoint"; "PlanControl"; "PlanControlState"; "PlanManeuver"; "PlanSpecification"; "PlanTransition";
    "SetEntityParameters"; "VehicleState" ]

let maneuvers =
  [ "CompassCalibration"; "FollowPath"; "Goto"; "Launch"; "Loiter"; "PopUp"; "Rows"; "StationKeeping"; "YoYo" ]

let differences d =
  let known name = Definition.find_name d name <> None in
  let difference = Definition.difference d ~than:(Lazy.force Definition.builtin) in
  List.filter_map difference (spoken @ List.filter known maneuvers)

let numbered = List.map (fun (n : Definition.named) -> (n.value, n.name))

let types d =
  match List.assoc_opt "SystemType" (Definition.enumerations d) with
  | Some members -> numbered members
  | None -> []

let modes d =
  match Definition.find_name d "VehicleState" with
  | None -> []
  | Some m -> (
      match List.find_opt (fun (f : Definition.field) -> f.name = "op_mode") m.fields with
      | Some { typ = Number (_, Enumeration names); _ } -> numbered names.members
      | Some _ | None -> [])
