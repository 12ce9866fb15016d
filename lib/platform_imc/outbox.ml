open Dolphin_semantics
open Dolphin_runtime
module Names = Map.Make (String)

(* The last report on a vehicle to the program, with its time. *)
type told = { state : World.vehicle_state; at : float }

(* Few events ever wait: a list, first one first. *)
type t = { events : Platform.event list; last : told Names.t }

let telemetry_interval = 0.95
let empty = { events = []; last = Names.empty }
let is_empty b = b.events = []

(* The ends of tasks keep their place behind the news that came before them. *)
let add (event : Platform.event) b =
  match event with
  | Vehicle state ->
    let rec without = function
      | Platform.Vehicle other :: rest when other.id = state.id -> rest
      | (Platform.Vehicle _ as other) :: rest -> other :: without rest
      | rest -> rest
    in
    { b with events = List.rev (event :: without (List.rev b.events)) }
  | Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet -> { b with events = b.events @ [ event ] }

let forget v b = { b with last = Names.remove v b.last }
let told v b = Option.map (fun t -> t.state) (Names.find_opt v b.last)

type periodic = Everything | Moves | Nothing

let move = 5.

let vehicle ~now ~urgent ~periodic (state : World.vehicle_state) b =
  let is_news =
    match Names.find_opt state.id b.last with
    | None -> true
    | Some { state = before; at } ->
      before <> state
      && (before.connected <> state.connected || before.unready <> state.unready
          || before.kind <> state.kind || before.payload <> state.payload || urgent
          || (now -. at >= telemetry_interval
              &&
              match periodic with
              | Everything -> true
              | Moves -> Dolphin_geo.Wgs84.distance before.position state.position > move
              | Nothing -> false))
  in
  if is_news then add (Vehicle state) { b with last = Names.add state.id { state; at = now } b.last } else b

let take b =
  match b.events with
  | [] -> None
  | event :: events -> Some (event, { b with events })

let keep p b = { b with events = List.filter p b.events }

let without_task v =
  keep (function
      | Platform.Task_done w | Task_failed (w, _) -> w <> v
      | Vehicle _ | Timer _ | Input _ | Quiet -> true)

let without_timer timer =
  keep (function
      | Platform.Timer other -> other <> timer
      | Vehicle _ | Task_done _ | Task_failed _ | Input _ | Quiet -> true)
