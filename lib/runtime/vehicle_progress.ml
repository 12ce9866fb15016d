open Dolphin_plans
open Dolphin_semantics

let is_asked_for (program : Core.program) =
  let exception Found in
  let look (e : Core.expression) =
    match e.node with
    | Apply (Builtin (Sensor_of Progress), _) | Apply (Method ("rest", _), _) -> raise Found
    | _ -> ()
  in
  match Code_walk.iter look (Code_walk.pieces program) with () -> false | exception Found -> true

(* Of its latest plan [begun] is the share that was done before this part of it began. *)
type vehicle = {
  whole : string;
  begun : float;
  way : Progress.t option;
  under_way : bool;
  earlier : (string * float) list;  (* of other plans, the latest first *)
}

type t = vehicle Vehicle_map.t

let none = Vehicle_map.empty

(* The plans of a vehicle whose progress is kept. *)
let most_plans = 8

(* A metre in 100 km, a second in a day: journals are shorter, and a resumed run sees the same. *)
let rounded share = Float.round (share *. 1e5) /. 1e5

let progress v =
  let of_part = Option.fold v.way ~none:0. ~some:Progress.share in
  (v.whole, rounded (v.begun +. ((1. -. v.begun) *. of_part))) :: v.earlier

let start (s : World.vehicle_state) (p : Core.platform_task) x =
  let speed = Option.value s.cruise ~default:nan in
  let whole, begun = Option.fold p.plan ~none:("", None) ~some:Inline_plan.begun in
  let way = Option.bind p.plan (Progress.start ~speed) in
  let before = match Vehicle_map.find_opt s.id x with Some v -> progress v | None -> s.progress in
  let others = List.filter (fun (plan, _) -> not (String.equal plan whole)) before in
  let earlier = List.filteri (fun i _ -> i < most_plans - 1) others in
  Vehicle_map.add s.id { whole; begun = Option.value begun ~default:0.; way; under_way = true; earlier } x

let change v f x = match Vehicle_map.find_opt v x with Some vehicle -> Vehicle_map.add v (f vehicle) x | None -> x
let stop v = change v (fun vehicle -> { vehicle with under_way = false })
let finish v = change v (fun vehicle -> { vehicle with begun = 1.; under_way = false })

let see ~at (s : World.vehicle_state) x =
  match Vehicle_map.find_opt s.id x with
  | None -> (x, s)
  | Some vehicle ->
    (* Without a link its place is an earlier one. *)
    let vehicle =
      if vehicle.under_way && s.connected then
        { vehicle with way = Option.map (Progress.observe ~at s.position) vehicle.way }
      else vehicle
    in
    (Vehicle_map.add s.id vehicle x, { s with progress = progress vehicle })

(* The rest of a task under way begins where its vehicle was seen last. *)
let resume ~at world tasks =
  let was x (s : World.vehicle_state) =
    match s.progress with
    | [] -> x
    | (whole, begun) :: earlier -> Vehicle_map.add s.id { whole; begun; way = None; under_way = false; earlier } x
  in
  let add v (p : Core.platform_task) x =
    match World.find v world with
    | None -> x
    | Some s -> (
        match Rest.of_vehicle world p s with
        | Ok (Task (Platform rest)) -> fst (see ~at s (start s rest x))
        | Ok _ | Error _ -> start s p x)
  in
  Vehicle_map.fold add tasks (List.fold_left was none (World.vehicles world))
