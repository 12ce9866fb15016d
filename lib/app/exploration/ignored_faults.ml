module Faults = Dolphin_environment.Faults
module Scenario = Dolphin_scenario.Scenario

let sentence limit what (fleet : Fleet_file.t) does =
  let named (v : Scenario.vehicle) = if does v then Some v.id else None in
  match List.filter_map named fleet.scenario.vehicles with
  | _ :: _ as vehicles when not (Faults.is_possible limit) -> [ Printf.sprintf what (String.concat ", " vehicles) ]
  | _ -> []

let is_unsteady (v : Scenario.vehicle) = v.leaves <> None || v.drops <> []

let of_links (faults : Faults.t) fleet =
  sentence faults.loss
    "by the fleet these leave, or lose their links: %s; here they stay, unless --faults has loss" fleet is_unsteady

let sentences (faults : Faults.t) fleet =
  sentence faults.join
    "by the fleet these join late: %s; here they are there from the start, unless --faults has join" fleet
    (fun v -> v.joins > 0.)
  @ of_links faults fleet

let of_assumptions (program : Dolphin_semantics.Core.program) (fleet : Fleet_file.t) =
  let sentence (r : Scenario.recurrence) =
    Format.asprintf "%a: the program reads no sensor, so %s does not matter" Dolphin_syntax.Location.pp r.at r.source in
  if program.reads_sensors || program.reads_now then []
  else List.sort_uniq String.compare (List.map sentence fleet.scenario.recurrences)

let of_time (faults : Faults.t) fleet = if Faults.is_possible faults.join then of_links faults fleet else []
