open Dolphin_results
open Dolphin_runtime
open Dolphin_semantics

type t = { fleet : Fleet.t; early : Platform.event list; news : World.vehicle_state list }

(* While it is made; lists have the latest first. *)
type state = { f : Fleet.t; untold : Platform.event list; unsaid : World.vehicle_state list }

let without v states = List.filter (fun (s : World.vehicle_state) -> s.id <> v) states

let put_aside s : Platform.event -> state = function
  | Vehicle state -> { s with unsaid = state :: without state.id s.unsaid }
  | (Task_done _ | Task_failed _ | Timer _ | Input _) as event -> { s with untold = event :: s.untold }
  | Quiet -> s

(* Whatever happens before [time]. *)
let rec pass time s =
  match Fleet.due s.f with
  | Some due when due < time -> (
      match Fleet.step s.f with
      | Some (event, f) -> pass time (Option.fold event ~none:{ s with f } ~some:(put_aside { s with f }))
      | None -> s)
  | Some _ | None -> s

(* [until ~last fits s] is [s] after the next event that fits, due at [last] at the latest. *)
let rec until ~last fits s =
  match Fleet.due s.f with
  | Some due when due <= last -> (
      match Fleet.step s.f with
      | Some (Some event, f) when fits event -> Some { s with f }
      | Some (event, f) -> until ~last fits (Option.fold event ~none:{ s with f } ~some:(put_aside { s with f }))
      | None -> None)
  | Some _ | None -> None

(* In paced time rounding may let an event come later than it came then. *)
let tolerance = 60.

(* Progress was added by the driver. *)
let see time (state : World.vehicle_state) s =
  let state = { state with progress = [] } in
  let said = { s with unsaid = without state.id s.unsaid } in
  if Fleet.told state.id s.f = Some state then said
  else
    match until ~last:time (function Platform.Vehicle told -> told = state | _ -> false) s with
    | Some s -> { s with unsaid = without state.id s.unsaid }
    | None -> said

let same (event : Transition.event) (told : Platform.event) =
  match event, told with
  | Vehicle_done v, Task_done w -> v = w
  | Vehicle_failed (v, why), Task_failed (w, why') -> v = w && why = why'
  | Timer_expired timer, Timer timer' -> timer = timer'
  | Input (k, x), Input (k', x') -> k = k' && Value.compare x x' = 0
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _
      | Replied _ | Host_failed _ | Input _ | Interruption ),
      (Vehicle _ | Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet) ) -> false

let happen time (event : Transition.event) s =
  let rec less_first = function
    | told :: others when same event told -> others
    | told :: others -> told :: less_first others
    | [] -> []
  in
  let told ~last =
    if List.exists (same event) s.untold then Some { s with untold = less_first s.untold }
    else until ~last (same event) s
  in
  let comes what =
    match told ~last:(time +. tolerance) with
    | Some s -> Ok s
    | None -> Error (Printf.sprintf "%s at %g s did not happen with this fleet and this seed" what time)
  in
  match event with
  | Vehicle_done v | Vehicle_failed (v, _) -> comes ("the end of a task of " ^ v)
  | Timer_expired _ -> comes "the end of a timer"
  | Input _ -> Ok (Option.value (told ~last:time) ~default:s)  (* of the fleet, or else from elsewhere *)
  | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Interruption -> Ok s

let command ~announce_period s : Effect.t -> state = function
  | Start (v, task) -> { s with f = Fleet.start v task s.f }
  | Stop v ->
    let others = function
      | Platform.Task_done w | Task_failed (w, _) -> v <> w
      | Vehicle _ | Timer _ | Input _ | Quiet -> true
    in
    { s with f = Fleet.stop v s.f; untold = List.filter others s.untold }
  | Set_timer (timer, seconds) -> { s with f = Fleet.set_timer timer seconds s.f }
  | Look_for { timeout; _ } ->
    { s with f = Fleet.set_timer Residual.script_timer (Option.value timeout ~default:announce_period) s.f }
  | Cancel_timer timer ->
    let others = function
      | Platform.Timer timer' -> timer <> timer'
      | Vehicle _ | Task_done _ | Task_failed _ | Input _ | Quiet -> true
    in
    { s with f = Fleet.cancel_timer timer s.f; untold = List.filter others s.untold }
  | Bind vs -> { s with f = Fleet.bind vs s.f }
  | Release vs -> { s with f = Fleet.release vs s.f }
  | Set_connection_timeout (vs, seconds) -> { s with f = Fleet.set_connection_timeout vs seconds s.f }
  | Put_question _ | Withdraw_question _ | Say _ | Ask _ | Call_host _ | End _ -> s

let moment ~announce_period s { History.time; what } =
  match what with
  | Saw state -> Ok (see time state s)
  | Noted _ -> Ok s
  | Happened event -> Result.map (fun s -> { s with f = Fleet.advance s.f time }) (happen time event s)
  | Asked { effects; number = _ } ->
    let s = pass time s in
    Ok (List.fold_left (command ~announce_period) { s with f = Fleet.advance s.f time } effects)

let make ~seed ~announce_period scenario history =
  let start = { f = Fleet.telemetry Awaited (Fleet.create ~seed scenario); untold = []; unsaid = [] } in
  let finish s = { fleet = s.f; early = List.rev s.untold; news = List.rev s.unsaid } in
  Result.map finish (Results.fold (moment ~announce_period) start history)
