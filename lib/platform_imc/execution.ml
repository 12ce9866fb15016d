open Dolphin_imc
open Execution_state
module Control = Message.Plan_control
module Control_state = Message.Plan_control_state

type order = Attempt.order = { plan : string; specification : Message.t Message.Plan_specification.t option }

type doubt = Never_sent | Lost_note | Lost_note_of_repetition

type input =
  | Start of order
  | Stop
  | Reply of { sent : float; reply : Message.t Control.t }
  | State of { sent : float; state : Control_state.t }
  | Vehicle of { sent : float; state : Message.Vehicle_state.t }
  | Log of { sent : float; entry : Message.Log_book_entry.t }
  | Abort of string
  | Stopped_by of string
  | Lost of string
  | Adopt of { order : order; stopped : bool; notes : Durable_note.t list; doubt : doubt }
  | Leaves of float
  | Tick

type output = Execution_state.output =
  | Keep of Durable_note.t
  | Send of Message.t
  | Done
  | Failed of string
  | Remark of string

type t = Execution_state.t

let most_copies = 10
let most_copies_while_blocked = 3
let patience = Attempt.patience
let grace = grace
let stop_interval = 0.5
let stop_patience = 60.
let warning = 5.
let abort_interval = 1.

(* The interval of stops that were in vain for [stop_patience]. *)
let late_stop_interval = 5.

(* Longer than it takes from the end of a plan to the VehicleState that follows. *)
let rest_patience = 1.

(* The time in which a plan that we gave up is stopped when the vehicle is heard again. *)
let given_up_watch = 600.

let create = create

(* {1 What the vehicle's report means} *)

let unknown plan =
  Printf.sprintf
    "the console died just as it asked for plan %s, which the vehicle had run before: it is unknown whether it has run \
     again"
    plan

(* The request seems to be without effect: if that is sure, it is sent again. *)
let look ~now ~clock (a : Attempt.t) (r : Plan_report.t) x =
  if a.accepted <> None || not (Attempt.is_past ~now r a) then (x, [])
  else
    let is_blocked = r.state.state = Blocked in
    (* It may be that the plan ran and was over between two reports, all signs of it being lost. *)
    let doubtful = Plan_report.names a.order.plan r in
    if a.copies >= most_copies || (is_blocked && a.copies >= most_copies_while_blocked) then
      let why =
        if is_blocked then words x ~since:a.after ~why:Verdict.blocked
        else Printf.sprintf "no answer to %d requests to start the plan" a.copies
      in
      fail ~now ~ended:r.sent a why x
    else if a.adopted && doubtful then fail ~now ~ended:r.sent a (unknown a.order.plan) x
    (* A vehicle that wakes up may send its reports before it reads the request. *)
    else if not (Attempt.was_read r a) then (x, [])
    else
      let x, outputs = send_again ~now ~clock a x in
      let remark = Printf.sprintf "plan %s is requested again; it cannot be excluded that it has run" a.order.plan in
      (x, if doubtful then Remark remark :: outputs else outputs)

(* The consequences of [verdict] on the report [r]; the plan took effect at [since] at the earliest. *)
let conclude ~now ~clock ~since (a : Attempt.t) (r : Plan_report.t) (verdict : Verdict.t) x =
  match verdict with
  | Nothing_new -> (x, [])
  | Initialises -> ({ x with phase = Starting { a with initialised = true } }, [])
  | No_sign -> look ~now ~clock a r x
  | Runs -> ({ x with phase = Running { attempt = a; since = r.sent } }, [])
  | Succeeded -> succeed ~now ~ended:r.sent a x
  | Ended why -> await_words ~now ~clock a ~since why x
  | Replaced other -> replaced ~now ~clock ~ended:r.sent a other x

(* [r] is the latest report. *)
let judge_start ~now ~clock (a : Attempt.t) r x =
  let former_ended, late =
    match x.former with
    | Some f when f.attempt.order.plan = a.order.plan -> (f.ended, None)
    | Some f when now < f.watched_until -> (neg_infinity, Some f.attempt.order.plan)
    | Some _ | None -> (neg_infinity, None)
  in
  conclude ~now ~clock ~since:(Attempt.effect_time a) a r (Verdict.of_start ~now ~former_ended ~late a r) x

let stopped ~now ~clock ~ended attempt next x =
  let x = close ~now ~ended attempt x in
  match next with
  | Some order -> begin_attempt ~now ~clock order x
  | None -> (x, [])

(* The stop is confirmed once the plan engine does not run the plan and VehicleState, sent later, shows rest: an engine
   that has lost the plan is BLOCKED while the maneuver goes on. Of a vehicle that has never sent a VehicleState READY
   has to do. *)
let settle_stop ~now ~clock x =
  match x.phase with
  | Stopping { attempt; over = Some since; next; _ } ->
    let is_blocked = match x.latest with Some r -> r.state.state = Blocked | None -> false in
    let rests = match x.mode with Some _ -> rests ~since x | None -> not is_blocked in
    if rests then
      let ended = match x.mode with Some (sent, _) -> sent | None -> since in
      stopped ~now ~clock ~ended attempt next x
    else (x, [])
  | Stopping { over = None; _ } | Idle | Starting _ | Running _ | Ending _ -> (x, [])

(* The report [r] while a stop waits for its confirmation. *)
let judge_stop ~now ~clock (r : Plan_report.t) x =
  match x.phase with
  | Stopping s when r.sent > s.after -> (
      let own = Plan_report.names s.attempt.order.plan r in
      (* If the request may still be on its way, nothing is over. *)
      let is_final = s.took_effect || Attempt.is_past ~now r s.attempt in
      match r.state.state with
      | Executing when own -> ({ x with phase = Stopping { s with took_effect = true; over = None } }, [])
      | Executing when is_final -> stopped ~now ~clock ~ended:r.sent s.attempt s.next x
      | (Ready | Blocked) when is_final ->
        let over = Option.fold s.over ~none:r.sent ~some:(Float.min r.sent) in
        settle_stop ~now ~clock { x with phase = Stopping { s with over = Some over } }
      | Executing | Ready | Blocked | Initializing | Other _ -> (x, []))
  | Stopping _ | Idle | Starting _ | Running _ | Ending _ -> (x, [])

(* A plan that is over runs again. *)
let judge_idle ~now ~clock (r : Plan_report.t) x =
  match x.former with
  | Some f
    when r.state.state = Executing
      && Plan_report.names f.attempt.order.plan r
      && r.sent > f.ended && now < f.watched_until ->
    let x, outputs = begin_stop ~now ~clock ~took_effect:true f.attempt x in
    (x, Remark (Printf.sprintf "plan %s runs though it was over; it is stopped" f.attempt.order.plan) :: outputs)
  | Some _ | None -> (x, [])

let judge ~now ~clock (r : Plan_report.t) x =
  match x.phase with
  | Idle -> judge_idle ~now ~clock r x
  | Starting a -> judge_start ~now ~clock a r x
  | Running { attempt; since } -> conclude ~now ~clock ~since attempt r (Verdict.of_run ~since attempt r) x
  (* Not ours ended, but another's of that name, and now our request has taken effect. *)
  | Ending { attempt; _ }
    when Attempt.is_open attempt && r.state.state = Executing && Plan_report.names attempt.order.plan r ->
    ({ x with phase = Running { attempt; since = r.sent } }, [])
  | Ending _ -> (x, [])
  | Stopping _ -> judge_stop ~now ~clock r x

(* {1 A vehicle that goes on} *)

let is_blocked x = match x.latest with Some r -> r.state.state = Blocked | None -> false
let is_busy x = match x.latest with Some r -> Plan_report.is_busy r | None -> false

(* The plan failed, and no better reason came. A vehicle that goes on, or may, is ordered to stop. *)
let end_badly ~now ~clock (a : Attempt.t) ~since ~why x =
  let ended = match x.latest with Some r -> r.sent | None -> since in
  let failed = Failed (words x ~since ~why) in
  if maneuvers ~since:ended x || (is_blocked x && not (rests ~since x)) then
    let x, outputs = begin_stop ~now ~clock ~took_effect:true a x in
    (x, failed :: outputs)
  else (close ~now ~ended:(Vehicle_clock.latest clock) a x, [ failed ])

(* VehicleState has come. *)
let judge_mode ~now ~clock x =
  match x.phase, x.former with
  | Stopping _, _ -> settle_stop ~now ~clock x
  | Ending { attempt; since; why; _ }, _ when is_blocked x ->
    let ended = match x.latest with Some r -> r.sent | None -> since in
    if maneuvers ~since:ended x then end_badly ~now ~clock attempt ~since ~why x else (x, [])
  | Idle, Some f when now < f.unrested_until && maneuvers ~since:(f.ended +. rest_patience) x && not (is_busy x) ->
    let x, outputs = begin_stop ~now ~clock ~took_effect:true f.attempt x in
    let plan = f.attempt.order.plan in
    (x, Remark (Printf.sprintf "the vehicle goes on though plan %s was over; it is ordered to stop" plan) :: outputs)
  | (Idle | Starting _ | Running _ | Ending _), _ -> (x, [])

(* The plan before is over for good once the vehicle was seen to rest. *)
let rested x =
  match x.former with
  | Some f when rests ~since:f.ended x -> { x with former = Some { f with unrested_until = neg_infinity } }
  | Some _ | None -> x

(* {1 Inputs} *)

let in_words info = if String.trim info = "" then Verdict.refused else info

let start_reply ~now ~clock ~sent (reply : Message.t Control.t) x =
  match x.phase, reply.type_ with
  | Starting a, (Success | In_progress) when reply.request_id = a.request ->
    let accepted = Option.fold a.accepted ~none:sent ~some:(Float.min sent) in
    let a = { a with accepted = Some accepted; answered = true } in
    let x = { x with phase = Starting a } in
    (match x.latest with Some r -> judge_start ~now ~clock a r x | None -> (x, []))
  | Starting a, Failure when reply.request_id = a.request ->
    (* Unless a copy of the request was refused before another was accepted. *)
    let a = { a with answered = true } in
    if Option.fold a.accepted ~none:true ~some:(fun at -> sent >= at) then
      fail ~now ~ended:sent a (in_words reply.info) x
    else ({ x with phase = Starting a }, [])
  | Running { attempt; since }, (Success | In_progress) when reply.request_id = attempt.request ->
    (* Earlier reports may have been about another's plan of that name. *)
    let since = if attempt.answered then since else Float.max since sent in
    ({ x with phase = Running { attempt = { attempt with answered = true }; since } }, [])
  | Running { attempt = a; since }, Failure when reply.request_id = a.request && sent > since ->
    fail ~now ~ended:sent a (in_words reply.info) x
  | Ending { attempt = a; since; _ }, Failure when reply.request_id = a.request && sent >= since ->
    fail ~now ~ended:sent a (in_words reply.info) x
  | Stopping s, (Success | In_progress) when reply.request_id = s.attempt.request ->
    ({ x with phase = Stopping { s with took_effect = true } }, [])
  | (Idle | Starting _ | Running _ | Ending _ | Stopping _), (Request | Success | Failure | In_progress | Other _) ->
    (x, [])

let stop_reply ~now ~clock ~sent (reply : Message.t Control.t) x =
  match x.phase with
  (* The request that is to be undone by a stop may come after it. *)
  | Stopping s when reply.request_id = s.stop && (s.took_effect || not (Attempt.may_arrive ~now s.attempt)) ->
    let over = Option.fold s.over ~none:sent ~some:(Float.min sent) in
    settle_stop ~now ~clock { x with phase = Stopping { s with over = Some over } }
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
  match x.latest with
  | Some r when sent <= r.sent -> (x, [])
  | Some _ | None ->
    let r = { Plan_report.sent; state } in
    judge ~now ~clock r { x with latest = Some r }

let newer sent = function Some (at, _) -> sent > at | None -> true

let vehicle ~now ~clock ~sent (state : Message.Vehicle_state.t) x =
  let is_error = state.op_mode = Error && state.last_error <> "" && newer sent x.error in
  let x = if is_error then { x with error = Some (sent, state.last_error) } else x in
  if newer sent x.mode then judge_mode ~now ~clock (rested { x with mode = Some (sent, state.op_mode) }) else (x, [])

(* Errors that come with the plan, and are not its end. *)
let log entry x =
  let at_work =
    match x.phase with
    | Running _ | Ending _ | Starting { accepted = Some _; _ } -> true
    | Starting { accepted = None; initialised; _ } -> initialised
    | Idle | Stopping _ -> false
  in
  let told, log_errors = Log_errors.hear ~at_work entry x.log_errors in
  ({ x with log_errors }, List.map (fun text -> Remark text) (Option.to_list told))

let leaves ~at ~clock x =
  match x.phase with
  | Starting a -> { x with phase = Starting (Attempt.leaves ~at ~clock a) }
  | Stopping s -> { x with phase = Stopping { s with attempt = Attempt.leaves ~at ~clock s.attempt } }
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

(* A plan that another console stops before our request was taken is not ours. *)
let stopped_by by x =
  match x.phase with
  | Running _ | Ending _ | Starting { accepted = Some _; _ } -> { x with intervention = Some ("stopped by " ^ by) }
  | Starting { accepted = None; _ } | Idle | Stopping _ -> x

let lost ~now ~clock why x =
  match x.phase with
  | Idle | Stopping { next = None; _ } -> (x, [])
  | Starting attempt | Running { attempt; _ } | Ending { attempt; _ } ->
    fail ~watch:given_up_watch ~now ~ended:(Vehicle_clock.latest clock) attempt why x
  | Stopping s -> ({ x with phase = Stopping { s with next = None } }, [ Failed why ])

(* Nothing was heard that confirms the stop of [attempt], nor that the vehicle goes on. *)
let give_stop_up ~now ~clock (attempt : Attempt.t) next x =
  let x = close ~watch:given_up_watch ~now ~ended:(Vehicle_clock.latest clock) attempt x in
  let remark = Remark (Printf.sprintf "the stop of plan %s was not confirmed" attempt.order.plan) in
  match next with
  | Some order ->
    let x, outputs = begin_attempt ~now ~clock order x in
    (x, remark :: outputs)
  | None -> (x, [ remark ])

let goes_on plan seconds =
  Printf.sprintf "may still run plan %s: it still maneuvers %.0f s after the order to stop" plan seconds

let is_abort_due ~now ~first_sent ~aborted x =
  now >= first_sent +. x.abort_after && Option.fold aborted ~none:true ~some:(fun at -> now >= at +. abort_interval)

let stop_interval_after ~last_sent ~first_sent =
  if last_sent >= first_sent +. stop_patience then late_stop_interval else stop_interval

(* A stop without confirmation, each time that something is to be done about it. *)
let tick_stop ~now ~clock x =
  match x.phase with
  | Stopping ({ attempt; first_sent; after; _ } as s) ->
    let plan = attempt.order.plan and moves = maneuvers ~since:after x in
    if now >= first_sent +. stop_patience && not moves then give_stop_up ~now ~clock attempt s.next x
    else if moves && is_abort_due ~now ~first_sent ~aborted:s.aborted x then
      let told = Printf.sprintf "%s; it is ordered to abort" (goes_on plan (now -. first_sent)) in
      let remark = if s.aborted = None then [ Remark told ] else [] in
      ({ x with phase = Stopping { s with aborted = Some now; warned = true } }, Send Message.Abort :: remark)
    else if moves && now >= first_sent +. warning && not s.warned then
      ({ x with phase = Stopping { s with warned = true } }, [ Remark (goes_on plan (now -. first_sent)) ])
    else if moves && now >= first_sent +. stop_patience && s.next <> None then
      ({ x with phase = Stopping { s with next = None } }, [ Failed (goes_on plan (now -. first_sent)) ])
    else if now >= s.last_sent +. stop_interval_after ~last_sent:s.last_sent ~first_sent then
      ({ x with phase = Stopping { s with last_sent = now } }, [ Send (Attempt.stop ~request:s.stop attempt) ])
    else (x, [])
  | Idle | Starting _ | Running _ | Ending _ -> (x, [])

let tick ~now ~clock x =
  match x.phase with
  | Ending e when now >= e.deadline -> end_badly ~now ~clock e.attempt ~since:e.since ~why:e.why x
  | Stopping _ -> tick_stop ~now ~clock x
  | Idle | Starting _ | Running _ | Ending _ -> (x, [])

(* {1 What a console before this one has begun} *)

(* It maneuvers, and not for a plan. *)
let maneuvers_idly x = maneuvers ~since:neg_infinity x && not (is_busy x)

let unnoted plan =
  Printf.sprintf
    "the vehicle runs a plan %s already, and the journal has no request for it: it is not known whether that is this \
     run's"
    plan

let unnoted_end plan =
  Printf.sprintf
    "the last plan of the vehicle has the name %s, and the journal has no request for it: it is not known whether it \
     has run for this run"
    plan

(* The stop of a plan without a request on record. *)
let stop_unasked ~now ~clock ~took_effect (order : order) x =
  let attempt = Attempt.make ~now ~clock ~request:x.next_request ~before:x.latest order in
  begin_stop ~now ~clock ~took_effect attempt { x with next_request = (x.next_request + 1) land 0xFFFF }

(* No request is on record. The vehicle's plan may be this one all the same, if the end of the journal is lost. *)
let adopt_unasked ~now ~clock (order : order) doubt x =
  let fail_and_stop ~took_effect =
    let x, outputs = stop_unasked ~now ~clock ~took_effect order x in
    (x, Failed (unnoted order.plan) :: outputs)
  in
  match x.phase, x.latest with
  | Stopping _, _ -> start ~now ~clock order x
  | (Idle | Starting _ | Running _ | Ending _), Some r when Plan_report.names order.plan r -> (
      match r.state.state, doubt with
      | Executing, _ -> fail_and_stop ~took_effect:true
      | Blocked, Lost_note when not (rests ~since:neg_infinity x) -> fail_and_stop ~took_effect:true
      | (Ready | Blocked | Initializing | Other _), Lost_note -> (x, [ Failed (unnoted_end order.plan) ])
      | (Ready | Blocked | Initializing | Other _), (Never_sent | Lost_note_of_repetition) ->
        begin_attempt ~now ~clock order x)
  | (Idle | Starting _ | Running _ | Ending _), Some { state = { state = Initializing; _ }; _ }
    when doubt <> Never_sent ->
    fail_and_stop ~took_effect:false
  | (Idle | Starting _ | Running _ | Ending _), (Some _ | None) -> begin_attempt ~now ~clock order x

let adopt ~now ~clock (order : order) ~stopped ~doubt notes x =
  let is_at_work (r : Plan_report.t) = Plan_report.is_busy r && Plan_report.names order.plan r in
  match Durable_note.knowledge ~plan:order.plan notes, x.latest with
  | None, Some r when stopped && doubt <> Never_sent && is_at_work r ->
    stop_unasked ~now ~clock ~took_effect:true order x
  | None, _ -> if stopped then (x, []) else adopt_unasked ~now ~clock order doubt x
  | Some { over = true; _ }, _ when stopped -> (x, [])
  | Some k, Some r when stopped ->
    let attempt = Attempt.adopted ~now ~clock order k in
    (* A plan engine that has lost the plan, while the vehicle goes on, is BLOCKED. *)
    if is_at_work r || (r.state.state = Blocked && not (rests ~since:neg_infinity x)) || maneuvers_idly x then
      begin_stop ~now ~clock ~took_effect:true attempt x
    else
      let ours = not (Plan_report.is_busy r) in
      (close ~ours ~now ~ended:r.sent attempt x, [ Keep (Over { request = k.request }) ])
  | Some k, latest ->
    let attempt = Attempt.adopted ~now ~clock order k in
    let phase = if k.runs then Running { attempt; since = neg_infinity } else Starting attempt in
    let x = { x with phase; intervention = None; next_request = (k.request + 1) land 0xFFFF } in
    (match latest with Some r -> judge ~now ~clock r x | None -> (x, []))

(* {1 What lingers} *)

let idle x = match x.phase with Idle -> true | Starting _ | Running _ | Ending _ | Stopping _ -> false

(* The request of a plan that is over may still take effect: the plan would run, unwanted. *)
let may_still_begin ~now x (f : former) =
  let is_past = match x.latest with Some r -> Attempt.is_past ~now r f.attempt | None -> false in
  Attempt.is_open f.attempt && now < f.attempt.last_sent +. late_copies && not is_past

(* VehicleState reported it after the plan's end. *)
let may_go_on ~now x (f : former) = now < f.unrested_until && maneuvers ~since:f.ended x && not (is_busy x)

(* The plan that the vehicle may still run though it is over for the program. *)
let lingering ~now x =
  let unheard_since time = match x.latest with Some r -> r.sent <= time | None -> true in
  match x.phase, x.former with
  | Stopping { attempt; _ }, _ -> Some attempt
  | Idle, Some f when (f.given_up && unheard_since f.ended) || may_still_begin ~now x f || may_go_on ~now x f ->
    Some f.attempt
  | (Idle | Starting _ | Running _ | Ending _), _ -> None

(* {1 Steps} *)

(* Each report of the vehicle is a sign of how often it took the request, besides its other meaning. *)
let detect_duplicates input x =
  let duplicates =
    match input with
    | Reply { sent; reply } -> Duplicates.reply ~sent reply x.duplicates
    | State { sent; state } -> Duplicates.state ~sent state x.duplicates
    | Log { sent; entry } -> Duplicates.log ~sent entry x.duplicates
    | Start _ | Stop | Vehicle _ | Abort _ | Stopped_by _ | Lost _ | Adopt _ | Leaves _ | Tick -> x.duplicates
  in
  match Duplicates.detected duplicates with
  | None -> ({ x with duplicates }, [])
  | Some (duplicates, plan) ->
    let why = "the request for it came twice, or another console made one" in
    ({ x with duplicates }, [ Remark (Printf.sprintf "plan %s starts again: %s" plan why) ])

let hear ~clock input x =
  match input, x.phase with
  | (State _ | Vehicle _ | Log _ | Reply _), Starting a -> { x with phase = Starting (Attempt.hears ~clock a) }
  | (State _ | Vehicle _ | Log _ | Reply _), (Idle | Running _ | Ending _ | Stopping _) -> x
  | (Start _ | Stop | Abort _ | Stopped_by _ | Lost _ | Adopt _ | Leaves _ | Tick), _ -> x

let handle ~now ~clock input x =
  let x = hear ~clock input x in
  match input with
  | Start order -> start ~now ~clock order x
  | Stop -> stop ~now ~clock x
  | Reply { sent; reply = r } -> reply ~now ~clock ~sent r x
  | State { sent; state = s } -> state ~now ~clock sent s x
  | Vehicle { sent; state } -> vehicle ~now ~clock ~sent state x
  | Log { entry; _ } -> log entry x
  | Abort by -> ({ x with intervention = Some ("aborted by " ^ by) }, [])
  | Stopped_by by -> (stopped_by by x, [])
  | Lost why -> lost ~now ~clock why x
  | Adopt { order; stopped; notes; doubt } -> adopt ~now ~clock order ~stopped ~doubt notes x
  | Leaves at -> (leaves ~at ~clock x, [])
  | Tick -> tick ~now ~clock x

(* The program has the report that the plan is over, or will have it: only the notes on the vehicle show that it may go
   on. *)
let is_over_for_program ~before ~input outputs =
  let has_failed = List.exists (function Failed _ -> true | Keep _ | Send _ | Done | Remark _ -> false) outputs in
  match input, before.phase with
  | Adopt _, _ | _, (Starting _ | Running _ | Ending _ | Stopping _) -> has_failed
  | _, Idle -> true

(* The note to keep about the vehicle beyond the request: that it may still run a plan that the program has ended. *)
let note_lingering ~now ~before ~input outputs x =
  let is_adopted = match input with Adopt _ -> true | _ -> false in
  match x.may_run, lingering ~now x with
  | Some request, Some a when a.request = request -> (x, [])
  | _, Some a when is_over_for_program ~before ~input outputs ->
    ({ x with may_run = Some a.request }, [ Keep (May_run { plan = a.order.plan; request = a.request }) ])
  | None, Some a when is_adopted -> ({ x with may_run = Some a.request }, [])
  | Some request, None when idle x -> ({ x with may_run = None }, [ Keep (Over { request }) ])
  | Some _, (Some _ | None) -> ({ x with may_run = None }, [])
  | None, (Some _ | None) -> (x, [])

(* A stop that was given up is not confirmed. *)
let is_true_of x : Durable_note.t -> bool = function
  | Over { request } -> (
      match x.former with Some f -> not (f.given_up && f.attempt.request = request) | None -> true)
  | Asked _ | Taken _ | Runs _ | May_run _ -> true

let step ~now ~clock input x =
  let x, remarks = detect_duplicates input x in
  let y, outputs = handle ~now ~clock input x in
  (* A request is kept before it is sent. *)
  let notes = List.filter (is_true_of y) (Attempt.notes ~before:(attempt x) ~after:(attempt y)) in
  let y, lingering = note_lingering ~now ~before:x ~input outputs y in
  let is_new note = not (List.mem (Keep note) lingering) in
  (y, remarks @ List.map (fun note -> Keep note) (List.filter is_new notes) @ lingering @ outputs)

(* {1 What stands} *)

let due x =
  match x.phase with
  | Idle | Starting _ | Running _ -> infinity
  | Ending e -> e.deadline
  | Stopping s ->
    let again = s.last_sent +. stop_interval_after ~last_sent:s.last_sent ~first_sent:s.first_sent in
    if not (maneuvers ~since:s.after x) then Float.min again (s.first_sent +. stop_patience)
    else
      let warned = if s.warned then infinity else s.first_sent +. warning in
      let abort = Option.fold s.aborted ~none:neg_infinity ~some:(fun at -> at +. abort_interval) in
      let next = if s.next = None then infinity else s.first_sent +. stop_patience in
      List.fold_left Float.min again [ warned; next; Float.max abort (s.first_sent +. x.abort_after) ]

let owes x =
  match x.phase with
  | Starting _ | Running _ | Ending _ | Stopping { next = Some _; _ } -> true
  | Idle | Stopping { next = None; _ } -> false

let is_settled ~now x =
  match x.phase, x.former with
  | Idle, Some f -> not (may_still_begin ~now x f || may_go_on ~now x f)
  | Idle, None -> true
  | (Starting _ | Running _ | Ending _ | Stopping _), _ -> false

let unsettled ~now x =
  match x.phase with
  | Stopping { next = Some _; _ } -> None
  | Idle | Starting _ | Running _ | Ending _ | Stopping _ ->
    Option.map (fun (a : Attempt.t) -> a.order.plan) (lingering ~now x)

let report x = x.latest

(* {1 Displays} *)

type stage = Attempt.stage = Starting | Running | Stopping
type progress = { plan : string; stage : stage; share : float option; remaining : float option }

let progress x =
  let of_attempt ((a : Attempt.t), stage) =
    match stage, x.latest with
    | Running, Some r when r.state.state = Executing && Plan_report.names a.order.plan r ->
      let share = r.state.plan_progress in
      let known = share >= 0. && share <= 100. in
      { plan = a.order.plan; stage;
        share = (if known then Some (share /. 100.) else None);
        remaining = (if known && r.state.plan_eta >= 0 then Some (float_of_int r.state.plan_eta) else None) }
    | (Starting | Running | Stopping), _ -> { plan = a.order.plan; stage; share = None; remaining = None }
  in
  Option.map of_attempt (attempt x)

let executing x =
  match x.latest with
  | Some { state = { state = Executing; plan_id; _ }; _ } -> Some plan_id
  | Some _ | None -> None
