open Dolphin_plans
open Core
module Wgs84 = Dolphin_geo.Wgs84

type quantity = Length | Duration | Energy

let quantity = function
  | "length" | "getLength" -> Some Length
  | "duration" -> Some Duration
  | "energy" -> Some Energy
  | _ -> None

let length (p : platform_task) =
  match p.plan with
  | None -> Error (Printf.sprintf "the way of plan '%s' is not described here: only its vehicle knows it" p.name)
  | Some plan -> (
      match Inline_plan.start plan with
      | Some (place, _) -> Ok (Number (Inline_plan.extent ~from:place ~speed:1. plan).metres)
      | None when Inline_plan.is_fixed plan -> Ok (Number 0.)
      | None ->
        let why = Printf.sprintf "the way of plan '%s' depends on its start" p.name in
        Error (why ^ ": write length(v), with its vehicle"))

(* A number that is not certain is one that depends on a value that the vehicle has not reported. *)
let known sensor (s : World.vehicle_state) x =
  if Float.is_nan x then Unknown { sensor; of_vehicle = s.id } else Number x

let told = Option.value ~default:nan

(* The cost of a second. *)
let drain (s : World.vehicle_state) = told s.drain /. 3600.

let measure quantity (s : World.vehicle_state) ~metres ~seconds =
  match quantity with
  | Length -> metres
  | Duration -> seconds
  | Energy -> seconds *. drain s

let sensor (p : platform_task) = function
  | Length -> p.name ^ ".length"
  | Duration -> p.name ^ ".duration"
  | Energy -> p.name ^ ".energy"

let from_here quantity (p : platform_task) plan (s : World.vehicle_state) here =
  let { Inline_plan.metres; moving; staying } = Inline_plan.extent ~from:here ~speed:(told s.cruise) plan in
  if staying = infinity && quantity <> Length then Number infinity
  else known (sensor p quantity) s (measure quantity s ~metres ~seconds:(moving +. staying))

let spell x = Format.asprintf "%a" Value.pp x

(* From anywhere: the way to the first place, and the rest from there on. Its text describes its computation, so that
   readings with the same text are the same. *)
let reading quantity (p : platform_task) plan (s : World.vehicle_state) =
  let named = sensor p quantity in
  let reading text = Reading { quantity = Amount; text } in
  match Inline_plan.start plan with
  | None when Inline_plan.is_fixed plan -> from_here quantity p plan s s.position
  | None ->
    (* Plans of one name may differ. *)
    reading (Printf.sprintf "%s(%s) of %s" named s.id (Inline_plan.digest plan))
  | Some (place, speed) -> (
      let speed = if Float.is_nan speed then told s.cruise else speed in
      let one_metre = measure quantity s ~metres:1. ~seconds:(1. /. speed) in
      match from_here quantity p plan s place with
      | Number rest when rest < infinity && not (Float.is_nan one_metre) ->
        let from_there = Printf.sprintf "position(%s).distance(%s)" s.id (spell (Position place)) in
        reading (Printf.sprintf "%s * %s + %s" from_there (spell (Number one_metre)) (spell (Number rest)))
      | Number rest when rest < infinity -> known named s nan
      | endless_or_unknown -> endless_or_unknown)

let of_plan world (p : platform_task) quantity s =
  match p.plan, World.position world s with
  | None, _ -> Ok (Unknown { sensor = sensor p quantity; of_vehicle = s.id })
  | Some plan, Shows here -> Ok (from_here quantity p plan s here)
  | Some _, One_of places -> Error (World.places s places)
  | Some plan, Anything -> Ok (reading quantity p plan s)

let eta world (s : World.vehicle_state) place =
  let speed = told s.cruise in
  match World.position world s with
  | _ when Float.is_nan speed -> Ok (known "eta" s speed)
  | Shows here -> Ok (Number (Wgs84.distance here place /. speed))
  | One_of places -> Error (World.places s places)
  | Anything ->
    let text = Printf.sprintf "position(%s).distance(%s) / %s" s.id (spell (Position place)) (spell (Number speed)) in
    Ok (Reading { quantity = Amount; text })
