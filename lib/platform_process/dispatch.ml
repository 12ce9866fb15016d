open Dolphin_platform_protocol
open Dolphin_semantics
open Dolphin_runtime
module Order = Dolphin_platform_protocol.Order
module Names = Map.Make (String)
module Name_set = Set.Make (String)

(* A task that waits for the end of the request before it, since [asked]. [is_doubtful]: a console before this one may
   have ordered it, though the journal has no note of that. *)
type next = {
  task : Core.platform_task;
  request : string;
  asked : float;
  is_doubtful : bool;
  doubt : Order.doubt option;
}

(* The outstanding orders of one vehicle: a request without an end, and a task that waits for that end. *)
type slot = { errand : Order_state.t; next : next option }

type seen = {
  sighting : Sighting.t;
  since : float;  (* its link is as it is *)
  told : World.vehicle_state option;
}

(* The events to be handed out. The known state of a vehicle is reported when that is done. *)
type news = Changed of Core.vehicle | Told of Platform.event

type output =
  | Send of Order.t
  | Keep of Core.vehicle * Yojson.Safe.t
  | Keep_before of Core.vehicle * Yojson.Safe.t * string
  | Keep_and_tell of Core.vehicle * Yojson.Safe.t * int
  | Remark of Core.vehicle option * string
  | Give_up of string

(* Lines that were refused since the adapter was last informed: how many, why the last one was, and the remark on it. *)
type refused = { count : int; why : string; remark : string }

(* When the adapter was last informed of a line that was refused, and the lines since then. *)
type refusal = { informed : float; waits : refused option }

type ping = { next : float; id : int; unanswered : int }

type t = {
  platform : string;
  identity : number:int -> Core.vehicle -> Core.platform_task -> string;
  adapter : Report.greeting option;  (* of the one that is there *)
  seen : seen Names.t;
  slots : slot Names.t;
  given_up : (Core.vehicle * Order_state.t) list;  (* stops without an answer *)
  bound : Name_set.t;
  timeout : float;
  timeouts : float Names.t;
  telemetry : bool;
  timers : Timers.t;
  ping : ping;
  refusal : refusal;
  news : news list;  (* latest first *)
  ready : news list;  (* before these, earliest first *)
  outputs : output list;  (* of this step, latest first *)
}

let ping_interval = 5.
let most_unanswered = 3
let no_ping = { next = infinity; id = 0; unanswered = 0 }
let refusal_interval = 1.
let no_refusal = { informed = neg_infinity; waits = None }

let create ~platform ~identity =
  { platform; identity; adapter = None; seen = Names.empty; slots = Names.empty; given_up = [];
    bound = Name_set.empty; timeout = 60.; timeouts = Names.empty; telemetry = false; timers = Timers.none;
    ping = no_ping; refusal = no_refusal; news = []; ready = []; outputs = [] }

(* {1 Steps} *)

let output o d = { d with outputs = o :: d.outputs }
let finish d = ({ d with outputs = [] }, List.rev d.outputs)
let send order d = if d.adapter = None then d else output (Send order) d

let keep v kept d = output (Keep (v, Request_note.to_json ~platform:d.platform kept)) d
let remark v text d = output (Remark (v, text)) d

let remark_refused r d =
  let text =
    if r.count = 1 then r.remark else Printf.sprintf "%d more lines are ignored; of the last one: %s" r.count r.remark
  in
  remark None text d

let inform ~now r d =
  remark_refused r (send (Order.Refused r.why) { d with refusal = { informed = now; waits = None } })

(* An adapter that writes thousands of such lines is informed of the first and of the last of each second, and so is
   the user. *)
let refuse ~now ~remark why d =
  let count = match d.refusal.waits with None -> 1 | Some r -> r.count + 1 in
  let refused = { count; why; remark } in
  if now >= d.refusal.informed +. refusal_interval then inform ~now refused d
  else { d with refusal = { d.refusal with waits = Some refused } }

(* The adapter is not informed any more, but the user is. *)
let close_refusals d =
  match d.refusal.waits with
  | None -> d
  | Some r -> remark_refused r { d with refusal = { d.refusal with waits = None } }

let tell news d = { d with news = news :: d.news }

let timeout_of v d = Option.value (Names.find_opt v d.timeouts) ~default:d.timeout

(* {1 Events} *)

let all_news d = d.ready @ List.rev d.news
let is_change v = function Changed w -> String.equal v w | Told _ -> false

let changed v d =
  if List.exists (is_change v) d.ready || List.exists (is_change v) d.news then d else tell (Changed v) d

(* The known state of a vehicle goes before the end of its task. *)
let end_task v event d = tell (Told event) (changed v d)
let without fits d = { d with ready = List.filter (fun n -> not (fits n)) (all_news d); news = [] }

let is_end_of v = function
  | Told (Platform.Task_done w | Task_failed (w, _)) -> v = w
  | Told (Vehicle _ | Timer _ | Input _ | Quiet) | Changed _ -> false

let rec take d =
  match d.ready, d.news with
  | [], [] -> None
  | [], news -> take { d with ready = List.rev news; news = [] }
  | Told event :: ready, _ -> Some (event, { d with ready })
  | Changed v :: ready, _ -> (
      let d = { d with ready } in
      match Names.find_opt v d.seen with
      | None -> take d
      | Some seen -> (
          match Sighting.state seen.sighting with
          | Some state when seen.told <> Some state ->
            Some (Platform.Vehicle state, { d with seen = Names.add v { seen with told = Some state } d.seen })
          | Some _ | None -> take d))

let rec waiting d =
  match d.ready with
  | [] -> d.news <> [] && waiting { d with ready = List.rev d.news; news = [] }
  | Told _ :: _ -> true
  | Changed v :: ready -> (
      match Names.find_opt v d.seen with
      | Some { sighting; told; _ } when Sighting.state sighting <> None && Sighting.state sighting <> told -> true
      | Some _ | None -> waiting { d with ready })

(* {1 Orders} *)

let start_order v (e : Order_state.t) d =
  Order.Start { request = e.request; vehicle = v; plan = e.body; timeout = timeout_of v d }

let resume_order v (e : Order_state.t) d =
  Order.Resume { request = e.request; vehicle = v; plan = e.body; timeout = timeout_of v d; notes = e.notes;
                 doubt = e.doubt }

let put v slot d = { d with slots = Names.add v slot d.slots }
let with_errand v errand (slot : slot) d = put v { slot with errand } d

let order_start ~now v (slot : slot) d =
  let errand = { slot.errand with stage = Ordered; is_resumed = false; is_on_disk = true; doubt = None; asked = now } in
  send (start_order v errand d) (with_errand v errand slot d)

let order_stop ~now v (slot : slot) d =
  let errand = { slot.errand with wanted = false; stop_sent = Some now } in
  send (Stop { request = errand.request; vehicle = v }) (with_errand v errand slot d)

let asked (e : Order_state.t) = Request_note.Asked { request = e.request; plan = e.plan }

(* The order leaves once the note on it is on the disk. *)
let write_ahead v (slot : slot) d =
  let e = { slot.errand with stage = Unwritten; is_resumed = false } in
  let note = Request_note.to_json ~platform:d.platform (asked e) in
  output (Keep_before (v, note, e.request)) (with_errand v e slot d)

let begin_errand ~now v ~request task d =
  write_ahead v { errand = Order_state.make ~now ~request task; next = None } d

(* The journal has no note of the order: it may be lost, with the end of the journal. So the adapter is asked, which
   orders nothing. *)
let ask_first ~now v ~request ?doubt (task : Core.platform_task) d =
  let errand =
    Order_state.outstanding ~is_on_disk:false ?doubt ~now ~request ~plan:task.name ~body:(Plan_body.to_json task)
      ~wanted:true ~notes:[] ()
  in
  let errand = { errand with is_resumed = true } in
  put v { errand; next = None } d |> keep v (asked errand) |> send (resume_order v errand d)

(* The vehicle has none of our requests any more; the task waiting for that begins. *)
let free ~now v (slot : slot) d =
  let d = { d with slots = Names.remove v d.slots } in
  match slot.next with
  | None -> d
  | Some { task; request; is_doubtful = true; doubt; asked = _ } -> ask_first ~now v ~request ?doubt task d
  | Some { task; request; is_doubtful = false; doubt = _; asked = _ } -> begin_errand ~now v ~request task d

let durable ~now request d =
  let is_it _ slot = slot.errand.Order_state.request = request && slot.errand.stage = Unwritten in
  let d =
    match Names.choose_opt (Names.filter is_it d.slots) with
    | None -> d
    | Some (v, slot) when d.adapter = None ->
      with_errand v { slot.errand with stage = Unsent; is_on_disk = true } slot d
    | Some (v, slot) -> order_start ~now v slot d
  in
  finish d

(* {1 Reports on requests} *)

let end_errand ~now v (slot : slot) word d =
  let e = slot.errand in
  if not e.wanted then free ~now v slot (keep v (Over e.request) d)
  else
    let over event = end_task v event (free ~now v slot d) in
    match (word : Report.word) with
    | Done -> over (Task_done v)
    | Failed why -> over (Task_failed (v, why))
    | Stopped -> over (Task_failed (v, "the vehicle was stopped, and not by the program"))
    | Absent when e.is_resumed -> if e.is_on_disk then order_start ~now v slot d else write_ahead v slot d
    | Absent -> over (Task_failed (v, "the order to start did not reach the vehicle"))
    | Taken | Progress _ | Unknown _ -> d

(* The task has failed, and the vehicle's behaviour is uncertain. *)
let fail_uncertain ~now v (slot : slot) why d =
  let e = slot.errand in
  let d = end_task v (Task_failed (v, why)) d in
  if Order_state.is_sent e then
    keep v (Unsettled { request = e.request; plan = e.body }) d |> order_stop ~now v { slot with next = None }
  else { d with slots = Names.remove v d.slots }

let of_request request d =
  Names.choose_opt (Names.filter (fun _ (slot : slot) -> slot.errand.request = request) d.slots)

let word ~now request (word : Report.word) d =
  match of_request request d with
  | None ->
    let is_it (_, (e : Order_state.t)) = e.request = request in
    if Report.is_end word then
      let d = List.fold_left (fun d (v, _) -> keep v (Over request) d) d (List.filter is_it d.given_up) in
      { d with given_up = List.filter (fun g -> not (is_it g)) d.given_up }
    else d
  | Some (v, slot) -> (
      let e = slot.errand in
      match word with
      | Taken -> with_errand v { e with stage = Taken } slot d
      | Progress { share; remaining } -> with_errand v { e with stage = Taken; share; remaining } slot d
      | Unknown why when e.wanted -> fail_uncertain ~now v slot why d
      | Unknown _ -> d
      | Done | Failed _ | Stopped | Absent -> end_errand ~now v slot word d)

(* {1 Reports on vehicles} *)

let relink ~now v (seen : seen) sighting d =
  let since = if Sighting.link sighting = Sighting.link seen.sighting then seen.since else now in
  { d with seen = Names.add v { seen with sighting; since } d.seen }

(* Changes of position and battery are reported while telemetry is wanted; all others at once. *)
let is_telemetry before after =
  match before, Sighting.state after with
  | Some (told : World.vehicle_state), Some state ->
    { state with position = told.position; battery = told.battery; speed = told.speed; readings = told.readings }
    = told
  | None, _ | _, None -> false

let sight ~now (s : Report.sight) d =
  let v = s.vehicle in
  let known = Names.find_opt v d.seen in
  match Sighting.add s (Option.map (fun seen -> seen.sighting) known) with
  | Error why -> refuse ~now ~remark:(why ^ ": it is ignored") why d
  | Ok sighting ->
    let before = Option.value known ~default:{ sighting; since = now; told = None } in
    let d = relink ~now v before sighting d in
    if is_telemetry before.told sighting && not d.telemetry then d else changed v d

let unlink ~now v d =
  match Names.find_opt v d.seen with
  | None -> d
  | Some seen -> changed v (relink ~now v seen (Sighting.without_link seen.sighting) d)

let note request note id d =
  match of_request request d with
  | None -> Option.fold id ~none:d ~some:(fun id -> send (Kept id) d)
  | Some (v, slot) ->
    let json = Request_note.to_json ~platform:d.platform (Note { request; note }) in
    let d = with_errand v { slot.errand with notes = note :: slot.errand.notes } slot d in
    output (match id with None -> Keep (v, json) | Some id -> Keep_and_tell (v, json, id)) d

let report ~now (r : Report.t) d =
  let d = { d with ping = { d.ping with unanswered = 0 } } in
  finish
    (match r with
     | Vehicle s -> sight ~now s d
     | Gone v -> unlink ~now v d
     | Request (request, said) -> word ~now request said d
     | Note n -> note n.request n.note n.id d
     | Log { vehicle; text } -> remark vehicle text d
     | Trouble why -> remark None ("the adapter cannot go on: " ^ why) d
     | Hello _ | Pong _ | Checked _ | Quiet -> d)

let refused ~now why d =
  finish (refuse ~now ~remark:(Printf.sprintf "a line of the adapter %s; it is ignored" why) why d)

let last_refusals d = finish (close_refusals d)

(* {1 Adapters come and go} *)

let repeat_orders ~now v (slot : slot) d =
  match slot.errand.stage with
  | Unwritten -> d
  | Unsent -> order_start ~now v slot d
  | Ordered | Taken ->
    let errand = { slot.errand with stage = Ordered; is_resumed = true; asked = now } in
    let d = send (resume_order v errand d) (with_errand v errand slot d) in
    if errand.wanted then d
    else
      (* A stop that no adapter has heard of counts from now on. *)
      let stop_sent = Option.value errand.stop_sent ~default:now in
      with_errand v { errand with stop_sent = Some stop_sent } slot d
      |> send (Stop { request = errand.request; vehicle = v })

let repeat_stop d (v, (e : Order_state.t)) =
  send (Stop { request = e.request; vehicle = v }) (send (resume_order v e d) d)

let born ~now greeting d =
  let ping = { no_ping with next = now +. ping_interval } in
  let d = { d with adapter = Some greeting; ping; refusal = no_refusal } in
  let d = send (Timeout (None, d.timeout)) d in
  let d = Names.fold (fun v seconds d -> send (Timeout (Some [ v ], seconds)) d) d.timeouts d in
  let d = if d.telemetry then send (Telemetry true) d else d in
  let d = if Name_set.is_empty d.bound then d else send (Hold (Name_set.elements d.bound)) d in
  let d = List.fold_left repeat_stop d d.given_up in
  finish (Names.fold (repeat_orders ~now) d.slots d)

let died ~now d =
  let d = Names.fold (fun v _ d -> unlink ~now v d) d.seen { d with adapter = None; ping = no_ping } in
  finish (close_refusals d)

(* {1 Time} *)

(* Since when the vehicle has a link, if it has one, and since when it has none. *)
let link v d =
  match Names.find_opt v d.seen with
  | Some seen when Sighting.link seen.sighting -> (Some seen.since, infinity)
  | Some seen -> (None, seen.since)
  | None -> (None, neg_infinity)

let patience d = match d.adapter with Some greeting -> greeting.patience | None -> infinity

let due_of v (slot : slot) d =
  let link, lost = link v d in
  let of_next =
    match slot.next, link with
    | Some { asked; _ }, None -> Float.max lost asked +. timeout_of v d
    | Some _, Some _ | None, _ -> infinity
  in
  let of_errand = Order_state.due ~link ~lost ~timeout:(timeout_of v d) ~patience:(patience d) slot.errand in
  Float.min of_next of_errand

let refusal_due d = if d.refusal.waits = None then infinity else d.refusal.informed +. refusal_interval

let due d =
  Names.fold (fun v slot first -> Float.min first (due_of v slot d)) d.slots
    (Float.min (refusal_due d) (Float.min d.ping.next (Timers.first d.timers)))

let seconds x = if x = 1. then "1 second" else Printf.sprintf "%g seconds" x

let give_up_stop ~now v (slot : slot) d =
  let e = slot.errand in
  let text =
    Printf.sprintf "may still run plan %s: the stop has had no answer for %s" e.plan (seconds Order_state.stop_patience)
  in
  free ~now v slot (remark (Some v) text { d with given_up = (v, e) :: d.given_up })

let check_slot ~now v (slot : slot) d =
  if due_of v slot d > now then d
  else
    let has_link = fst (link v d) <> None in
    let no_word = "no word from the vehicle for " ^ seconds (timeout_of v d) in
    match slot.next with
    | Some _ when not has_link && not slot.errand.wanted ->
      end_task v (Task_failed (v, no_word)) (put v { slot with next = None } d)
    | Some _ | None ->
      if not slot.errand.wanted then give_up_stop ~now v slot d
      else if has_link then
        fail_uncertain ~now v slot ("no answer to the order to start for " ^ seconds (patience d)) d
      else fail_uncertain ~now v slot no_word d

let ping ~now d =
  if d.ping.next > now then d
  else if d.ping.unanswered >= most_unanswered then
    output
      (Give_up
         (Printf.sprintf "it has sent nothing for %s" (seconds (ping_interval *. float_of_int most_unanswered))))
      { d with ping = no_ping }
  else
    let id = d.ping.id + 1 in
    send (Ping id) { d with ping = { next = now +. ping_interval; id; unanswered = d.ping.unanswered + 1 } }

let tick ~now d =
  let expired, timers = Timers.expired ~now d.timers in
  let d = List.fold_left (fun d timer -> tell (Told (Timer timer)) d) { d with timers } expired in
  let d = match d.refusal.waits with Some r when refusal_due d <= now -> inform ~now r d | Some _ | None -> d in
  finish (ping ~now (Names.fold (check_slot ~now) d.slots d))

(* {1 Commands} *)

let start ~now ~number v task d =
  let request = d.identity ~number v task in
  let next = Some { task; request; asked = now; is_doubtful = false; doubt = None } in
  finish
    (match Names.find_opt v d.slots with
     | None -> begin_errand ~now v ~request task d
     | Some slot when not slot.errand.wanted -> put v { slot with next } d
     | Some slot -> order_stop ~now v { slot with next } d)

let stop_one ~now v d =
  let d = without (is_end_of v) d in
  match Names.find_opt v d.slots with
  | None -> d
  | Some slot when not slot.errand.wanted -> put v { slot with next = None } d
  | Some slot when Order_state.is_sent slot.errand -> order_stop ~now v slot d
  | Some slot -> keep v (Over slot.errand.request) { d with slots = Names.remove v d.slots }

let stop ~now v d = finish (stop_one ~now v d)
let stop_all ~now d = finish (Names.fold (fun v _ d -> stop_one ~now v d) d.slots d)

let bind vehicles d =
  let d = { d with bound = Name_set.union d.bound (Name_set.of_list vehicles) } in
  finish (if vehicles = [] then d else send (Hold vehicles) d)

let release vehicles d =
  let d = { d with bound = Name_set.diff d.bound (Name_set.of_list vehicles) } in
  finish (if vehicles = [] then d else send (Release vehicles) d)

let with_timeout vehicles seconds d =
  match vehicles with
  | None -> { d with timeout = seconds; timeouts = Names.empty }
  | Some vs -> { d with timeouts = List.fold_left (fun xs v -> Names.add v seconds xs) d.timeouts vs }

let set_connection_timeout vehicles seconds d =
  finish (send (Timeout (vehicles, seconds)) (with_timeout vehicles seconds d))

let telemetry on d =
  let d = send (Telemetry on) { d with telemetry = on } in
  finish (if on then Names.fold (fun v _ d -> changed v d) d.seen d else d)

let set_timer ~now timer seconds d =
  let is_it = function Told (Platform.Timer other) -> timer = other | Told _ | Changed _ -> false in
  { (without is_it d) with timers = Timers.set timer (now +. seconds) d.timers }

let cancel_timer timer d =
  let is_it = function Told (Platform.Timer other) -> timer = other | Told _ | Changed _ -> false in
  { (without is_it d) with timers = Timers.cancel timer d.timers }

(* {1 Resumption} *)

(* The question to the vehicle: the request before was to be stopped, and this one was to start. A start without a note
   may have been ordered all the same: the end of the journal may be lost. Its request has the same identity again. *)
let resume_task ~now d (v, (c : History.commanded)) =
  (* If the vehicle has run a plan of that name for the run before, its state shows nothing about this one. *)
  let doubt lost = if c.is_again then None else Some lost in
  let outstanding ~wanted (c : History.commanded) notes =
    let to_errand (request, notes) =
      let doubt = if notes = [] then doubt Order.Lost_notes else None in
      Order_state.outstanding ?doubt ~now ~request ~plan:c.task.name ~body:(Plan_body.to_json c.task) ~wanted ~notes ()
    in
    Option.map to_errand (Request_note.latest ~platform:d.platform notes)
  in
  let is_over json = match Request_note.latest ~platform:d.platform [ json ] with None -> true | Some _ -> false in
  match outstanding ~wanted:(not c.is_stopped) c c.notes with
  | Some errand -> put v { errand; next = None } d
  | None when c.is_stopped -> d
  | None -> (
      let before (b : History.commanded) =
        outstanding ~wanted:false b (List.filter is_over c.notes @ b.notes) in
      let request = d.identity ~number:c.number v c.task and doubt = doubt Order.Lost_order in
      match Option.bind c.before before with
      | Some errand ->
        put v { errand; next = Some { task = c.task; request; asked = now; is_doubtful = true; doubt } } d
      | None -> ask_first ~now v ~request ?doubt c.task d)

let resume_unsettled ~now d (v, request, body) =
  let plan = match body with `Assoc (("name", `String name) :: _) -> name | _ -> "?" in
  let errand = Order_state.outstanding ~now ~request ~plan ~body ~wanted:false ~notes:[] () in
  match Names.find_opt v d.slots with
  | None -> put v { errand; next = None } d
  | Some slot when slot.errand.request = request -> d
  | Some _ -> { d with given_up = (v, errand) :: d.given_up }

let resume ~now ~announce_period history d =
  let o = History.outstanding ~announce_period history in
  let d =
    { d with
      bound = Name_set.of_list o.bound;
      timeout = Option.value o.timeout ~default:d.timeout;
      timeouts = Names.of_seq (List.to_seq o.timeouts);
      timers = Timers.of_list o.timers }
  in
  let d = List.fold_left (resume_task ~now) d o.tasks in
  List.fold_left (resume_unsettled ~now) d (Request_note.unsettled ~platform:d.platform history)


(* {1 Displays} *)

let quiet d = Names.is_empty d.slots

let unsettled d =
  let plan (v, (e : Order_state.t)) = (v, e.plan) in
  let errands = List.map (fun (v, (slot : slot)) -> (v, slot.errand)) (Names.bindings d.slots) in
  let sent = List.filter (fun (_, e) -> Order_state.is_sent e) errands in
  List.sort_uniq compare (List.map plan (sent @ d.given_up))

type vehicle = {
  state : World.vehicle_state;
  is_placed : bool;
  battery : float option;
  speed : float option;
  plan : string option;
  share : float option;
  remaining : float option;
}

let vehicles d =
  let shown (v, seen) =
    let s = seen.sighting in
    let errand = Option.map (fun (slot : slot) -> slot.errand) (Names.find_opt v d.slots) in
    let of_errand f = Option.bind errand f in
    { state = Sighting.describe s; is_placed = Sighting.is_placed s; battery = Sighting.battery s;
      speed = Sighting.speed s;
      plan = of_errand (fun (e : Order_state.t) -> Some e.plan);
      share = of_errand (fun (e : Order_state.t) -> e.share);
      remaining = of_errand (fun (e : Order_state.t) -> e.remaining) }
  in
  List.map shown (Names.bindings d.seen)
