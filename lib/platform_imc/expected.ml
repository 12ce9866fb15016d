open Dolphin_semantics
open Knowledge

let expect name wish s = { s with expected = Names.add name wish s.expected }

(* An order of the console that died, or one that came before the vehicle was heard. *)
let order_of (task : Core.platform_task) : Execution.order =
  { plan = task.name; specification = Option.map Plan_message.of_plan task.plan }

let deadline ~now name s = now +. timeout_of name s

(* What is known to be over, or was never asked for, need not be halted. *)
let halt name begun s =
  match Durable_note.knowledge ~plan:begun.order.plan begun.memos with
  | None | Some { over = true; _ } -> expect name Nothing s
  | Some _ -> expect name (Halt begun) s

let resume ~now (outstanding : Dolphin_runtime.History.outstanding) s =
  let timeouts = List.fold_left (fun map (v, seconds) -> Names.add v seconds map) s.timeouts outstanding.timeouts in
  let s = { s with timeouts; timeout = Option.value outstanding.timeout ~default:s.timeout } in
  let s = List.fold_left (fun s v -> expect v Nothing { s with bound = Names.add v () s.bound }) s outstanding.bound in
  let begun (errand : Dolphin_runtime.History.commanded) =
    { order = order_of errand.task; memos = List.filter_map Durable_note.of_json errand.notes }
  in
  (* The end of the errand before may have been noted during this one. *)
  let before (errand : Dolphin_runtime.History.commanded) =
    let is_over = function Durable_note.Over _ -> true | Asked _ | Taken _ | Runs _ -> false in
    let with_ends b = { b with memos = List.filter is_over (begun errand).memos @ b.memos } in
    Option.map with_ends (Option.map begun errand.before)
  in
  let wish (v, (errand : Dolphin_runtime.History.commanded)) s =
    if errand.is_stopped then halt v (begun errand) s
    else expect v (Run { begun = begun errand; before = before errand; deadline = deadline ~now v s }) s
  in
  let s = List.fold_left (fun s errand -> wish errand s) s outstanding.tasks in
  { s with timers = Timers.of_list outstanding.timers }

let adopt ~now ~stopped { order; memos } = command ~now (Adopt { order; stopped; memos })

(* What was wished of [n] is done once it has said what it runs. *)
let receive ~now (n : Node.t) s =
  match Names.find_opt n.name s.expected with
  | Some wish when Execution.is_heard n.execution -> (
      let s = { s with expected = Names.remove n.name s.expected } in
      match wish with
      | Nothing -> (s, [])
      | Halt begun -> adopt ~now ~stopped:true begun n s
      | Run { begun; before = Some before; _ } when begun.memos = [] ->
        let s, sent = adopt ~now ~stopped:true before n s in
        let s, more = command ~now (Start begun.order) (Nodes.find n.id s.nodes) s in
        (s, sent @ more)
      | Run { begun; _ } -> adopt ~now ~stopped:false begun n s)
  | Some _ | None -> (s, [])

let plural seconds = if seconds = 1. then "1 second" else Printf.sprintf "%.0f seconds" seconds

let give_up ~now s =
  let give_up_one name wish s =
    match wish with
    | Run { begun; deadline; _ } when deadline <= now ->
      let why = Printf.sprintf "no word from the vehicle for %s" (plural (timeout_of name s)) in
      halt name begun (push (Task_failed (name, why)) s)
    | Run _ | Nothing | Halt _ -> s
  in
  Names.fold give_up_one s.expected s

let due s =
  let earlier _ wish time = match wish with Run { deadline; _ } -> Float.min deadline time | Nothing | Halt _ -> time in
  Names.fold earlier s.expected infinity

let owes_stop s = Names.exists (fun _ wish -> match wish with Halt _ -> true | Nothing | Run _ -> false) s.expected
