open Dolphin_imc
module Control = Message.Plan_control
module Control_state = Message.Plan_control_state

type fate = Succeeds of float | Fails of float | Is_refused of string | Is_lost of float * float
type execution = { plan : string; request : int; copy : int; mutable succeeded : bool }

type t = {
  fate : string -> fate;
  mutable state : Control_state.t;
  mutable running : (execution * float * fate) option;  (* until when *)
  mutable lost_until : float;  (* it maneuvers on without a plan *)
  mutable executions : execution list;
  mutable next_state : float;
  mutable next_mode : float;
}

let create ~fate ~before =
  { fate; state = before; running = None; lost_until = neg_infinity; executions = []; next_state = 0.; next_mode = 0. }

let state v = v.state
let executions v = v.executions
let said v = Message.Plan_control_state v.state

let reply (request : Message.t Control.t) type_ info =
  Message.Plan_control { request with type_; info; arg = None }

let mode v =
  let op_mode : Message.Vehicle_state.Op_mode.t =
    match v.state.state with
    | Executing -> Maneuver
    | Blocked -> if v.lost_until > neg_infinity then Maneuver else Error
    | Ready | Initializing | Other _ -> Service
  in
  Message.Vehicle_state { Message.Vehicle_state.default with op_mode }

let log text =
  Message.Log_book_entry { Message.Log_book_entry.default with type_ = Info; context = "Plan.Engine"; text }

let set v state = v.state <- state; said v

let request ~now ~copy (r : Message.t Control.t) v =
  match r.op with
  | Start when v.lost_until > neg_infinity -> [ reply r Failure "vehicle is blocked" ]
  | Start -> (
      v.running <- None;
      let request = log (Printf.sprintf "request -- Start Plan (%s)" r.plan_id) in
      let initialising = set v { v.state with state = Initializing } in
      let begins = log ("plan initializing: " ^ r.plan_id) in
      let answer words = log (Printf.sprintf "reply -- Start Plan (%s) -- %s" r.plan_id words) in
      match v.fate r.plan_id with
      | Is_refused why ->
        let refused = reply r Failure why in
        let ready = set v { v.state with state = Ready; last_outcome = Failure } in
        [ request; initialising; begins; refused; answer why; ready ]
      | (Succeeds after | Fails after | Is_lost (after, _)) as fate ->
        let e = { plan = r.plan_id; request = r.request_id; copy; succeeded = false } in
        v.executions <- e :: v.executions;
        v.running <- Some (e, now +. after, fate);
        let loaded = reply r Success "plan loaded" in
        let executing = set v { v.state with state = Executing; plan_id = r.plan_id } in
        let words = "1: executing maneuver" in
        [ request; initialising; begins; loaded; executing; reply r Success words; answer words; mode v ])
  | Stop ->
    if v.state.state = Executing then begin
      v.running <- None;
      let ok = reply r Success "OK" in
      [ ok; set v { v.state with state = Ready; last_outcome = Failure }; mode v ]
    end
    else [ reply r Failure "no plan is running, request ignored" ]
  | Load | Get | Other _ -> []

let finish ~now v =
  match v.running with
  | Some (_, until, Is_lost (_, lasts)) when now >= until ->
    v.running <- None;
    v.lost_until <- until +. lasts;
    [ set v { v.state with state = Blocked; last_outcome = Failure }; mode v ]
  | Some (e, until, fate) when now >= until ->
    let succeeds = match fate with Succeeds _ -> true | Fails _ | Is_refused _ | Is_lost _ -> false in
    v.running <- None;
    e.succeeded <- succeeds;
    let request = { Control.default with op = Start; request_id = e.request; plan_id = e.plan } in
    let verdict =
      if succeeds then reply request Success "plan completed" else reply request Failure "depth beyond limits"
    in
    [ verdict; set v { v.state with state = Ready; last_outcome = (if succeeds then Success else Failure) }; mode v ]
  | None when v.lost_until > neg_infinity && now >= v.lost_until ->
    v.lost_until <- neg_infinity;
    [ mode { v with state = { v.state with state = Ready } }; set v { v.state with state = Ready } ]
  | Some _ | None -> []

let abort v =
  v.running <- None;
  v.lost_until <- neg_infinity;
  let blocked = set v { v.state with state = Blocked; last_outcome = Failure } in
  let error = mode v in
  [ error; blocked; set v { v.state with state = Ready }; mode v ]

let maneuvers v = v.running <> None || v.lost_until > neg_infinity

let tick ~now v =
  let finished = finish ~now v in
  let periodic next interval message set =
    if now < next then []
    else begin
      set (now +. interval);
      [ message () ]
    end
  in
  let states = periodic v.next_state 0.33 (fun () -> said v) (fun t -> v.next_state <- t) in
  let modes = periodic v.next_mode 0.5 (fun () -> mode v) (fun t -> v.next_mode <- t) in
  finished @ states @ modes
