open Dolphin_imc
module Control = Message.Plan_control
module Control_state = Message.Plan_control_state

type order = { plan : string; specification : Message.t Message.Plan_specification.t option }

type t = {
  order : order;
  request : int;
  copies : int;
  last_sent : float;
  asked : float;
  awake : float option;
  before : Plan_report.t option;
  after : float;
  accepted : float option;
  answered : bool;
  adopted : bool;
  initialised : bool;
}

let patience = 1.
let reading = 0.25

let make ~now ~clock ~request ~before order =
  { order; request; copies = 1; last_sent = now;
    asked = Vehicle_clock.estimate ~now clock;
    awake = None;
    before;
    after = Vehicle_clock.latest clock;
    accepted = None; answered = false; adopted = false; initialised = false }

(* A report of which no more was kept than what is judged by it. *)
let remembered (plan_id, busy) =
  let state : Control_state.State.t = if busy then Executing else Ready in
  { Plan_report.sent = 0.; state = { Control_state.default with state; plan_id } }

let adopted ~now ~clock order (k : Durable_note.knowledge) =
  { order; request = k.request; copies = 1; last_sent = now;
    asked = Vehicle_clock.estimate ~now clock;
    awake = None;
    before = Option.map remembered k.before;
    after = neg_infinity;
    accepted = (if k.taken || k.runs then Some neg_infinity else None);
    answered = k.taken;
    adopted = true; initialised = false }

let send_again ~now ~clock a =
  { a with copies = a.copies + 1; last_sent = now; asked = Vehicle_clock.estimate ~now clock; awake = None }

let leaves ~at ~clock a =
  let asked = if at = infinity then infinity else Vehicle_clock.estimate ~now:at clock in
  { a with last_sent = at; asked; awake = None }

let hears ~clock a =
  let latest = Vehicle_clock.latest clock in
  if a.awake = None && latest >= a.asked +. reading then { a with awake = Some latest } else a

(* {1 Messages} *)

let message op request a arg =
  Message.Plan_control { Control.default with type_ = Request; op; request_id = request; plan_id = a.order.plan; arg }

let start a =
  message Start a.request a (Option.map (fun s -> Message.Plan_specification s) a.order.specification)

let stop ~request a = message Stop request a None

(* {1 What is known} *)

let was_busy_with plan a =
  match a.before with
  | Some r -> Plan_report.is_busy r && Plan_report.names plan r
  | None -> false

let accepted_before (r : Plan_report.t) a =
  match a.accepted with
  | Some at -> r.sent > at
  | None -> false

let effect_time a = Option.value a.accepted ~default:a.after
let may_arrive ~now a = now < a.last_sent +. patience
let is_open a = a.copies > 1 || not a.answered
let was_read (r : Plan_report.t) a = match a.awake with Some at -> r.sent >= at +. reading | None -> false
let is_past ~now (r : Plan_report.t) a = (not (may_arrive ~now a)) && r.sent >= a.asked +. patience

(* {1 What is to be kept} *)

type stage = Starting | Running | Stopping

let notes ~before ~after : Durable_note.t list =
  let is_other a = function Some (b, _) -> a.request <> b.request | None -> true in
  let asked a : Durable_note.t =
    let last (r : Plan_report.t) = (r.state.plan_id, Plan_report.is_busy r) in
    Asked { plan = a.order.plan; request = a.request; before = Option.map last a.before }
  in
  let over : Durable_note.t list =
    match before with
    | Some (a, Stopping) when is_other a after -> [ Over { request = a.request } ]
    | Some (_, (Starting | Running | Stopping)) | None -> []
  in
  let current : Durable_note.t list =
    match before, after with
    | _, Some (a, _) when is_other a before && not a.adopted -> [ asked a ]
    | Some (b, Starting), Some (a, Starting) when b.accepted = None && a.accepted <> None ->
      [ Taken { request = a.request } ]
    | (None | Some (_, Starting)), Some (a, Running) -> [ Runs { request = a.request } ]
    | (Some _ | None), (Some _ | None) -> []
  in
  over @ current
