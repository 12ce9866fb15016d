open Dolphin_imc
open Phase
module Control = Message.Plan_control
module Control_state = Message.Plan_control_state

type order = Phase.order
type t = Phase.t

type input =
  | Start of order
  | Stop
  | Reply of { sent : float; reply : Message.t Message.Plan_control.t }
  | State of { sent : float; state : Message.Plan_control_state.t }
  | Vehicle of { sent : float; state : Message.Vehicle_state.t }
  | Log of { sent : float; entry : Message.Log_book_entry.t }
  | Abort of string
  | Lost of string
  | Adopt of { order : order; stopped : bool; memos : Durable_note.t list }
  | Leaves of float
  | Tick

type output = Phase.output

let most_copies = 10
let most_copies_while_blocked = 3
let patience = 1.
let grace = Phase.grace
let stop_interval = Phase.stop_interval
let stop_patience = Phase.stop_patience
let create = Phase.create
let due = Phase.due
let idle = Phase.idle
let owes = Phase.owes
let unsettled = Phase.unsettled

(* {1 What the vehicle's state means} *)

let ended_badly = "the plan ended without success, and the vehicle gave no reason"
let refused = "the plan was refused, and the vehicle gave no reason"
let blocked = "the vehicle is blocked: it cannot run plans now"
let forgotten = "the vehicle knows of no plan any more: it was restarted"

let unknown plan =
  Printf.sprintf
    "the console died just as it asked for plan %s, which the vehicle had run before: nobody knows whether it has run \
     again"
    plan

(* The request seems to be without effect: if that is sure, it is sent again. *)
let look ~now ~clock (a : attempt) (s : sighting) x =
  if a.accepted <> None || now < a.last_sent +. patience || s.sent < a.asked +. patience then (x, [])
  else
    let is_blocked = s.state.state = Blocked in
    (* It may be that the plan ran and was over between two states, all signs of it being lost. *)
    let doubtful = is a.order.plan s in
    if a.copies >= most_copies || (is_blocked && a.copies >= most_copies_while_blocked) then
      let why =
        if is_blocked then words x ~since:a.after ~why:blocked
        else Printf.sprintf "no answer to %d requests to start the plan" a.copies
      in
      fail ~now ~ended:s.sent a why x
    else if a.adopted && doubtful then fail ~now ~ended:s.sent a (unknown a.order.plan) x
    else
      let x, outputs = resend ~now ~clock a x in
      let note = Printf.sprintf "plan %s is requested again; it cannot be excluded that it has run" a.order.plan in
      (x, if doubtful then Note note :: outputs else outputs)

let accepted_before (a : attempt) (s : sighting) =
  match a.accepted with
  | Some at -> s.sent > at
  | None -> false

(* [s] is the last that the vehicle said. *)
let judge_start ~now ~clock (a : attempt) (s : sighting) x =
  let own = is a.order.plan s and accepted = accepted_before a s in
  let was_busy_with plan = match a.before with Some b -> busy b && is plan b | None -> false in
  if s.sent <= a.after then (x, [])
  else
    match s.state.state with
    | Initializing -> ({ x with phase = Starting { a with initialised = true } }, [])
    | Executing when own ->
      if was_busy_with a.order.plan && not (accepted || a.initialised) then look ~now ~clock a s x
      else ({ x with phase = Running { attempt = a; since = s.sent } }, [])
    | Executing ->
      let other = s.state.plan_id in
      if (not accepted) && (a.before = None || was_busy_with other) then look ~now ~clock a s x
      else replaced ~now ~clock ~ended:s.sent a other x
    | Ready when own ->
      (* Unless the plan that had its name there was ours, and over after that was said. *)
      let over = match x.former with Some f when f.attempt.order.plan = a.order.plan -> f.ended | _ -> neg_infinity in
      let had_another = match a.before with Some b -> b.sent > over && not (is a.order.plan b) | None -> false in
      if not (accepted || a.initialised || had_another) then look ~now ~clock a s x
      else if succeeded s then succeed ~now ~ended:s.sent a x
      else expect_words ~now ~clock a ~since:(effect_of a) (if accepted then ended_badly else refused) x
    | Ready when accepted || (a.initialised && failed s) -> expect_words ~now ~clock a ~since:(effect_of a) refused x
    | Blocked when accepted -> expect_words ~now ~clock a ~since:(effect_of a) blocked x
    | Ready | Blocked -> look ~now ~clock a s x
    | Other _ -> (x, [])

let judge_run ~now ~clock (a : attempt) ~since (s : sighting) x =
  let own = is a.order.plan s in
  if s.sent <= since then (x, [])
  else
    match s.state.state with
    | Executing when own -> (x, [])
    | Ready when own ->
      if succeeded s then succeed ~now ~ended:s.sent a x else expect_words ~now ~clock a ~since ended_badly x
    | Ready when s.state.plan_id = "" -> expect_words ~now ~clock a ~since forgotten x
    | Executing | Ready -> replaced ~now ~clock ~ended:s.sent a s.state.plan_id x
    | Blocked -> expect_words ~now ~clock a ~since blocked x
    | Initializing | Other _ -> (x, [])

let stopped ~now ~clock ~ended attempt next x =
  let x = close ~now ~ended attempt x in
  match next with
  | Some order -> begin_attempt ~now ~clock order x
  | None -> (x, [])

(* Whether [s] shows that the plan of [a] does not run and, if the request may still be on its way, will not. *)
let confirms_stop ~now (a : attempt) ~took_effect ~after (s : sighting) =
  let over =
    match s.state.state with
    | Ready | Blocked -> true
    | Executing -> not (is a.order.plan s)
    | Initializing | Other _ -> false
  in
  over && s.sent > after
  && (took_effect || (now >= a.last_sent +. patience && s.sent >= a.asked +. patience))

let judge ~now ~clock (s : sighting) x =
  match x.phase with
  | Idle -> (
      match x.former with
      | Some f
        when s.state.state = Executing && is f.attempt.order.plan s && s.sent > f.ended && now < f.watched_until ->
        let x, outputs = begin_stop ~now ~clock ~took_effect:true f.attempt x in
        (x, Note (Printf.sprintf "plan %s runs though it was over; it is stopped" f.attempt.order.plan) :: outputs)
      | Some _ | None -> (x, []))
  | Starting a -> judge_start ~now ~clock a s x
  | Running { attempt; since } -> judge_run ~now ~clock attempt ~since s x
  | Ending _ -> (x, [])
  | Stopping p ->
    let took_effect = p.took_effect || (is p.attempt.order.plan s && s.state.state = Executing && s.sent > p.after) in
    if confirms_stop ~now p.attempt ~took_effect ~after:p.after s then
      stopped ~now ~clock ~ended:s.sent p.attempt p.next x
    else ({ x with phase = Stopping { p with took_effect } }, [])

(* {1 Inputs} *)

let in_words info = if String.trim info = "" then refused else info

let start_reply ~now ~clock ~sent (reply : Message.t Control.t) x =
  match x.phase, reply.type_ with
  | Starting a, (Success | In_progress) when reply.request_id = a.request ->
    let accepted = Option.fold a.accepted ~none:sent ~some:(Float.min sent) in
    let a = { a with accepted = Some accepted } in
    let x = { x with phase = Starting a } in
    (match x.seen with Some s -> judge_start ~now ~clock a s x | None -> (x, []))
  | Starting a, Failure when reply.request_id = a.request ->
    (* Unless a copy of the request was refused before another was accepted. *)
    if Option.fold a.accepted ~none:true ~some:(fun at -> sent >= at) then
      fail ~now ~ended:sent a (in_words reply.info) x
    else (x, [])
  | Running { attempt = a; since }, Failure when reply.request_id = a.request && sent > since ->
    fail ~now ~ended:sent a (in_words reply.info) x
  | Ending { attempt = a; since; _ }, Failure when reply.request_id = a.request && sent >= since ->
    fail ~now ~ended:sent a (in_words reply.info) x
  | Stopping s, (Success | In_progress) when reply.request_id = s.attempt.request ->
    ({ x with phase = Stopping { s with took_effect = true } }, [])
  | (Idle | Starting _ | Running _ | Ending _ | Stopping _), (Request | Success | Failure | In_progress | Other _) ->
    (x, [])

(* The request that is to be undone by a stop may come after it. *)
let may_arrive ~now (a : attempt) ~took_effect = (not took_effect) && now < a.last_sent +. patience

let stop_reply ~now ~clock ~sent (reply : Message.t Control.t) x =
  match x.phase with
  | Stopping s when reply.request_id = s.stop && not (may_arrive ~now s.attempt ~took_effect:s.took_effect) ->
    stopped ~now ~clock ~ended:sent s.attempt s.next x
  | Idle | Starting _ | Running _ | Ending _ | Stopping _ -> (
      if x.last_stop <> Some reply.request_id then (x, [])
      else
        let x = { x with stop_echo = Float.max sent x.stop_echo } in
        match x.phase with
        | Ending e when hit_by_late_stop x ~since:e.since -> start_again ~now ~clock e.attempt late_stop x
        | Idle | Starting _ | Running _ | Ending _ | Stopping _ -> (x, []))

let reply ~now ~clock ~sent (r : Message.t Control.t) x =
  match r.op, r.type_ with
  | Start, _ -> start_reply ~now ~clock ~sent r x
  | Stop, (Success | Failure) -> stop_reply ~now ~clock ~sent r x
  | Stop, (Request | In_progress | Other _) | (Load | Get | Other _), _ -> (x, [])

let state ~now ~clock sent state x =
  match x.seen with
  | Some s when sent <= s.sent -> (x, [])
  | Some _ | None ->
    let s = { sent; state } in
    judge ~now ~clock s { x with seen = Some s }

let vehicle ~sent (state : Message.Vehicle_state.t) x =
  let newer = match x.error with Some (at, _) -> sent > at | None -> true in
  if state.op_mode = Error && state.last_error <> "" && newer then
    ({ x with error = Some (sent, state.last_error) }, [])
  else (x, [])

let leaves ~at ~clock x =
  let postpone (a : attempt) =
    { a with last_sent = at; asked = (if at = infinity then infinity else Vehicle_clock.estimate ~now:at clock) }
  in
  match x.phase with
  | Starting a -> { x with phase = Starting (postpone a) }
  | Stopping s -> { x with phase = Stopping { s with attempt = postpone s.attempt } }
  | Idle | Running _ | Ending _ -> x

let stop ~now ~clock x =
  match x.phase with
  | Idle -> (x, [])
  | Starting a -> begin_stop ~now ~clock ~took_effect:(a.accepted <> None) a x
  | Running { attempt; _ } -> begin_stop ~now ~clock ~took_effect:true attempt x
  | Ending { attempt; _ } -> (close ~now ~ended:(Vehicle_clock.latest clock) attempt x, [])
  | Stopping s -> ({ x with phase = Stopping { s with next = None } }, [])

let start ~now ~clock order x =
  match x.phase with
  | Idle | Starting _ | Running _ | Ending _ -> begin_attempt ~now ~clock order x
  | Stopping s -> ({ x with phase = Stopping { s with next = Some order } }, [])

let lost ~now ~clock why x =
  match x.phase with
  | Idle | Stopping { next = None; _ } -> (x, [])
  | Starting attempt | Running { attempt; _ } | Ending { attempt; _ } ->
    fail ~watch:remembrance ~now ~ended:(Vehicle_clock.latest clock) attempt why x
  | Stopping s -> ({ x with phase = Stopping { s with next = None } }, [ Failed why ])

(* {1 What a console before this one has begun} *)

(* A sighting of which no more is kept than what was judged by it. *)
let remembered (plan_id, busy) =
  let state : Control_state.State.t = if busy then Executing else Ready in
  { sent = 0.; state = { Control_state.default with state; plan_id } }

(* Whatever the vehicle says now, it says after all that the other console did. *)
let adopted_attempt ~now ~clock order (k : Durable_note.knowledge) =
  { order; request = k.request; copies = 1; last_sent = now;
    asked = Vehicle_clock.estimate ~now clock;
    before = Option.map remembered k.before;
    after = neg_infinity;
    accepted = (if k.taken || k.runs then Some neg_infinity else None);
    adopted = true; initialised = false }

let is_at_work plan (s : sighting) = busy s && is plan s

let adopt ~now ~clock (order : order) ~stopped memos x =
  match Durable_note.knowledge ~plan:order.plan memos, x.seen with
  | None, _ -> if stopped then (x, []) else begin_attempt ~now ~clock order x
  | Some { over = true; _ }, _ when stopped -> (x, [])
  | Some k, Some s when stopped ->
    let attempt = adopted_attempt ~now ~clock order k in
    if is_at_work order.plan s then begin_stop ~now ~clock ~took_effect:true attempt x
    else (close ~now ~ended:s.sent attempt x, [ Keep (Over { request = k.request }) ])
  | Some k, seen ->
    let attempt = adopted_attempt ~now ~clock order k in
    let phase = if k.runs then Running { attempt; since = neg_infinity } else Starting attempt in
    let x = { x with phase; abort = None; next_request = (k.request + 1) land 0xFFFF } in
    (match seen with Some s -> judge ~now ~clock s x | None -> (x, []))

(* What is to be kept of a step from [x] to [y]. A request is kept before it is sent. *)
let memos x y =
  let attempt z : (attempt * [ `Starting | `Running | `Stopping ]) option =
    match z.phase with
    | Idle -> None
    | Starting attempt -> Some (attempt, `Starting)
    | Running { attempt; _ } | Ending { attempt; _ } -> Some (attempt, `Running)
    | Stopping { attempt; _ } -> Some (attempt, `Stopping)
  in
  let is_other (a : attempt) = function Some ((b : attempt), _) -> a.request <> b.request | None -> true in
  let asked (a : attempt) : Durable_note.t =
    Asked
      { plan = a.order.plan; request = a.request;
        before = Option.map (fun (s : sighting) -> (s.state.plan_id, busy s)) a.before }
  in
  let over : Durable_note.t list =
    match attempt x, attempt y with
    | Some (a, `Stopping), after when is_other a after -> [ Over { request = a.request } ]
    | _, _ -> []
  in
  let rest : Durable_note.t list =
    match attempt x, attempt y with
    | before, Some (a, _) when is_other a before && not a.adopted -> [ asked a ]
    | Some (b, `Starting), Some (a, `Starting) when b.accepted = None && a.accepted <> None ->
      [ Taken { request = a.request } ]
    | (None | Some (_, `Starting)), Some (a, `Running) -> [ Runs { request = a.request } ]
    | (Some _ | None), (Some _ | None) -> []
  in
  List.map (fun m -> Keep m) (over @ rest)

let tick ~now ~clock x =
  match x.phase with
  | Ending e when now >= e.deadline ->
    fail ~now ~ended:(Vehicle_clock.latest clock) e.attempt (words x ~since:e.since ~why:e.why) x
  | Stopping s when now >= s.first_sent +. stop_patience ->
    let x = close ~watch:remembrance ~now ~ended:(Vehicle_clock.latest clock) s.attempt x in
    let note = Note (Printf.sprintf "the stop of plan %s was not confirmed" s.attempt.order.plan) in
    (match s.next with
     | Some order ->
       let x, outputs = begin_attempt ~now ~clock order x in
       (x, note :: outputs)
     | None -> (x, [ note ]))
  | Stopping s when now >= s.last_sent +. stop_interval ->
    ({ x with phase = Stopping { s with last_sent = now } }, [ request Stop s.stop s.attempt.order None ])
  | Idle | Starting _ | Running _ | Ending _ | Stopping _ -> (x, [])

(* What the vehicle says is a sign of how often it took the request, whatever else it means. *)
let count input x =
  let takes =
    match input with
    | Reply { sent; reply } -> Duplicates.reply ~sent reply x.takes
    | State { sent; state } -> Duplicates.state ~sent state x.takes
    | Log { sent; entry } -> Duplicates.log ~sent entry x.takes
    | Start _ | Stop | Vehicle _ | Abort _ | Lost _ | Adopt _ | Leaves _ | Tick -> x.takes
  in
  match Duplicates.twice takes with
  | None -> ({ x with takes }, [])
  | Some (takes, plan) ->
    let why = "the request for it came twice, or another console made one" in
    ({ x with takes }, [ Note (Printf.sprintf "plan %s begins anew: %s" plan why) ])

let obey ~now ~clock input x =
  match input with
  | Start order -> start ~now ~clock order x
  | Stop -> stop ~now ~clock x
  | Reply { sent; reply = r } -> reply ~now ~clock ~sent r x
  | State { sent; state = s } -> state ~now ~clock sent s x
  | Vehicle { sent; state } -> vehicle ~sent state x
  | Log _ -> (x, [])
  | Abort by -> ({ x with abort = Some by }, [])
  | Lost why -> lost ~now ~clock why x
  | Adopt { order; stopped; memos } -> adopt ~now ~clock order ~stopped memos x
  | Leaves at -> (leaves ~at ~clock x, [])
  | Tick -> tick ~now ~clock x

let step ~now ~clock input x =
  let x, notes = count input x in
  let y, outputs = obey ~now ~clock input x in
  (y, notes @ memos x y @ outputs)

(* {1 Displays} *)

type stage = Starting | Running | Stopping
type progress = { plan : string; stage : stage; share : float option; remaining : float option }

let progress x =
  let plain (a : attempt) stage = Some { plan = a.order.plan; stage; share = None; remaining = None } in
  match x.phase, x.seen with
  | Idle, _ -> None
  | Starting a, _ -> plain a Starting
  | (Running { attempt; _ } | Ending { attempt; _ }), Some s
    when s.state.state = Executing && is attempt.order.plan s ->
    let share = s.state.plan_progress in
    let known = share >= 0. && share <= 100. in
    Some
      { plan = attempt.order.plan; stage = Running;
        share = (if known then Some (share /. 100.) else None);
        remaining = (if known && s.state.plan_eta >= 0 then Some (float_of_int s.state.plan_eta) else None) }
  | (Running { attempt; _ } | Ending { attempt; _ }), _ -> plain attempt Running
  | Stopping { attempt; _ }, _ -> plain attempt Stopping

let executing x =
  match x.seen with
  | Some { state = { state = Executing; plan_id; _ }; _ } -> Some plan_id
  | Some _ | None -> None

let is_heard x = x.seen <> None

let readiness x =
  match x.seen with
  | None | Some { state = { state = Initializing | Other _; _ }; _ } -> None
  | Some { sent; state = { state = Ready; _ } } -> Some (sent, true)
  | Some { sent; state = { state = Executing | Blocked; _ } } -> Some (sent, false)
