open Dolphin_semantics

type what =
  | Saw of World.vehicle_state
  | Noted of Core.vehicle * Yojson.Safe.t
  | Happened of Transition.event
  | Asked of Effect.t list

type moment = { time : float; what : what }

type errand = {
  task : Core.platform_task;
  is_stopped : bool;
  notes : Yojson.Safe.t list;
  before : errand option;
}

type standing = {
  bound : Core.vehicle list;
  errands : (Core.vehicle * errand) list;
  timers : (Residual.timer * float) list;
  timeout : float option;
  timeouts : (Core.vehicle * float) list;
}

let nothing = { bound = []; errands = []; timers = []; timeout = None; timeouts = [] }
let put key x pairs = (key, x) :: List.remove_assoc key pairs

let of_errand v change s =
  match List.assoc_opt v s.errands with
  | Some errand -> { s with errands = put v (change errand) s.errands }
  | None -> s

let set_timer time timer seconds s =
  let others = List.remove_assoc timer s.timers in
  { s with timers = (if seconds = infinity then others else (timer, time +. Float.max 0. seconds) :: others) }

let ask ~announce_period time s : Effect.t -> standing = function
  | Start (v, task) ->
    let before = Option.map (fun errand -> { errand with before = None }) (List.assoc_opt v s.errands) in
    { s with errands = put v { task; is_stopped = false; notes = []; before } s.errands }
  | Stop v -> of_errand v (fun errand -> { errand with is_stopped = true }) s
  | Set_timer (timer, seconds) -> set_timer time timer seconds s
  | Look_for { timeout; _ } ->
    set_timer time Effect.script_timer (Option.value timeout ~default:announce_period) s
  | Cancel_timer timer -> { s with timers = List.remove_assoc timer s.timers }
  | Bind vs -> { s with bound = s.bound @ vs }
  | Release vs -> { s with bound = List.filter (fun v -> not (List.mem v vs)) s.bound }
  | Set_connection_timeout (None, seconds) -> { s with timeout = Some seconds; timeouts = [] }
  | Set_connection_timeout (Some vs, seconds) ->
    { s with timeouts = List.fold_left (fun timeouts v -> put v seconds timeouts) s.timeouts vs }
  | Say _ | Ask _ | Call_host _ | End _ -> s

let standing ~announce_period moments =
  let add s { time; what } =
    match what with
    | Saw _ -> s
    | Noted (v, note) -> of_errand v (fun errand -> { errand with notes = note :: errand.notes }) s
    | Happened (Vehicle_done v | Vehicle_failed (v, _)) -> { s with errands = List.remove_assoc v s.errands }
    | Happened (Timer_expired timer) -> { s with timers = List.remove_assoc timer s.timers }
    | Happened (Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Interruption) -> s
    | Asked effects -> List.fold_left (ask ~announce_period time) s effects
  in
  List.fold_left add nothing moments

let answers moments =
  let add (prompt, found) { what; time = _ } =
    match what with
    | Asked effects ->
      let latest prompt : Effect.t -> _ = function Ask text -> Some text | _ -> prompt in
      (List.fold_left latest prompt effects, found)
    | Happened (Answered text) -> (prompt, Option.fold prompt ~none:found ~some:(fun prompt -> (prompt, text) :: found))
    | Saw _ | Noted _ | Happened _ -> (prompt, found)
  in
  List.rev (snd (List.fold_left add (None, []) moments))

let calls moments =
  let is_reply { what; _ } = match what with Happened (Replied _ | Host_failed _) -> true | _ -> false in
  List.length (List.filter is_reply moments)
