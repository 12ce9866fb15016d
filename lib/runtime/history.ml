open Dolphin_semantics

type what =
  | Saw of World.vehicle_state
  | Noted of Core.vehicle * Yojson.Safe.t
  | Happened of Transition.event
  | Asked of { number : int; effects : Effect.t list }

type entry = { time : float; what : what }
type t = entry list

let part ~vehicles ~timers history =
  let effect_of : Effect.t -> Effect.t option = function
    | (Start (v, _) | Stop v) as asked -> if vehicles v then Some asked else None
    | (Set_timer _ | Look_for _ | Cancel_timer _) as asked -> if timers then Some asked else None
    | Bind vs -> Some (Bind (List.filter vehicles vs))
    | Release vs -> Some (Release (List.filter vehicles vs))
    | Set_connection_timeout (Some vs, seconds) ->
      Some (Set_connection_timeout (Some (List.filter vehicles vs), seconds))
    | ( Set_connection_timeout (None, _) | Put_question _ | Withdraw_question _ | Say _ | Ask _ | Call_host _
      | End _ ) as asked -> Some asked
  in
  let entry e =
    let keep fits = if fits then Some e else None in
    match e.what with
    | Saw state -> keep (vehicles state.id)
    | Noted (v, _) | Happened (Vehicle_done v | Vehicle_failed (v, _)) -> keep (vehicles v)
    | Happened (Timer_expired _) -> keep timers
    | Happened
        (Confirmed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Input _
        | Interruption) ->
      Some e
    | Asked { number; effects } -> Some { e with what = Asked { number; effects = List.filter_map effect_of effects } }
  in
  List.filter_map entry history

type commanded = {
  task : Core.platform_task;
  number : int;
  is_again : bool;
  is_stopped : bool;
  notes : Yojson.Safe.t list;
  before : commanded option;
}

type outstanding = {
  bound : Core.vehicle list;
  tasks : (Core.vehicle * commanded) list;
  timers : (Residual.timer * float) list;
  timeout : float option;
  timeouts : (Core.vehicle * float) list;
}

let nothing = { bound = []; tasks = []; timers = []; timeout = None; timeouts = [] }
let put key x pairs = (key, x) :: List.remove_assoc key pairs

let with_task v change s =
  match List.assoc_opt v s.tasks with
  | Some c -> { s with tasks = put v (change c) s.tasks }
  | None -> s

let set_timer time timer seconds s =
  let others = List.remove_assoc timer s.timers in
  { s with timers = (if seconds = infinity then others else (timer, time +. Float.max 0. seconds) :: others) }

let ask ~announce_period ~number ~is_again time s : Effect.t -> outstanding = function
  | Start (v, task) ->
    let before = Option.map (fun c -> { c with before = None }) (List.assoc_opt v s.tasks) in
    let is_again = is_again v task in
    { s with tasks = put v { task; number; is_again; is_stopped = false; notes = []; before } s.tasks }
  | Stop v -> with_task v (fun c -> { c with is_stopped = true }) s
  | Set_timer (timer, seconds) -> set_timer time timer seconds s
  | Look_for { timeout; _ } ->
    set_timer time Residual.script_timer (Option.value timeout ~default:announce_period) s
  | Cancel_timer timer -> { s with timers = List.remove_assoc timer s.timers }
  | Bind vs -> { s with bound = s.bound @ vs }
  | Release vs -> { s with bound = List.filter (fun v -> not (List.mem v vs)) s.bound }
  | Set_connection_timeout (None, seconds) -> { s with timeout = Some seconds; timeouts = [] }
  | Set_connection_timeout (Some vs, seconds) ->
    { s with timeouts = List.fold_left (fun timeouts v -> put v seconds timeouts) s.timeouts vs }
  | Put_question _ | Withdraw_question _ | Say _ | Ask _ | Call_host _ | End _ -> s

let outstanding ~announce_period history =
  let begun = Hashtbl.create 16 in
  let is_again v (task : Core.platform_task) =
    let was = Hashtbl.mem begun (v, task.name) in
    Hashtbl.replace begun (v, task.name) ();
    was
  in
  let add s { time; what } =
    match what with
    | Saw _ -> s
    | Noted (v, note) -> with_task v (fun c -> { c with notes = note :: c.notes }) s
    | Happened (Vehicle_done v | Vehicle_failed (v, _)) -> { s with tasks = List.remove_assoc v s.tasks }
    | Happened (Timer_expired timer) -> { s with timers = List.remove_assoc timer s.timers }
    | Happened
        (Confirmed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Input _
        | Interruption) ->
      s
    | Asked { number; effects } -> List.fold_left (ask ~announce_period ~number ~is_again time) s effects
  in
  List.fold_left add nothing history

let answers history =
  let put (latest, standing) : Effect.t -> _ = function
    | Ask prompt -> (Some prompt, standing)
    | Put_question (question, prompt) -> (latest, put question prompt standing)
    | _ -> (latest, standing)
  in
  let add (latest, standing, found) { what; time = _ } =
    match what with
    | Asked { effects; number = _ } ->
      let latest, standing = List.fold_left put (latest, standing) effects in
      (latest, standing, found)
    | Happened (Answered { text; _ }) ->
      (latest, standing, Option.fold latest ~none:found ~some:(fun prompt -> (prompt, text) :: found))
    | Happened (Confirmed (question, Ok yes)) ->
      let text = if yes then "yes" else "no" in
      let prompt = List.assoc_opt question standing in
      (latest, standing, Option.fold prompt ~none:found ~some:(fun prompt -> (prompt, text) :: found))
    | Saw _ | Noted _ | Happened _ -> (latest, standing, found)
  in
  let _, _, found = List.fold_left add (None, [], []) history in
  List.rev found

let replies history =
  let call found : Effect.t -> _ = function
    | Call_host { subject; member; _ } -> (Machine.name_of_call ~subject ~member, None) :: found
    | _ -> found
  in
  let reply x = function (call, _) :: found -> (call, Some x) :: found | [] -> [] in
  let add found { what; time = _ } =
    match what with
    | Asked { effects; number = _ } -> List.fold_left call found effects
    | Happened (Replied x) -> reply (Ok x) found
    | Happened (Host_failed why) -> reply (Error why) found
    | Saw _ | Noted _ | Happened _ -> found
  in
  List.rev (List.fold_left add [] history)
