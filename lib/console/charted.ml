open Dolphin_plans
open Dolphin_semantics
module On_map = Dolphin_json.On_map

let most = 100

let rec charted name (x : Core.value) : Yojson.Safe.t list =
  let named members = [ `Assoc (("name", `String name) :: members) ] in
  match x with
  | Position p -> named [ ("position", On_map.pair p) ]
  | Area area -> named (On_map.area area)
  | List xs ->
    let item i = charted (Printf.sprintf "%s[%d]" name i) in
    List.concat (List.init (min most (Vector.length xs)) (fun i -> item i (Vector.get xs i)))
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Map _ | Range _ | Vehicles _ | Task _
  | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> []

let places (program : Core.program) store : Yojson.Safe.t =
  `List (List.concat_map (fun (i, x) -> charted program.global_names.(i) x) (Store.bindings store))

let way world v ({ name; plan; task_site = _ } : Core.platform_task) : Yojson.Safe.t option =
  let of_legs from (legs : Inline_plan.leg list) =
    match List.concat_map (fun (leg : Inline_plan.leg) -> leg.waypoints) legs with
    | [] -> None
    | points -> Some (`Assoc [ ("vehicle", `String v); ("plan", `String name); ("path", On_map.path (from :: points)) ])
  in
  match plan, World.find v world with
  | Some plan, Some { position; _ } -> of_legs position (Inline_plan.path ~from:position ~speed:1. plan)
  | Some _, None | None, _ -> None
