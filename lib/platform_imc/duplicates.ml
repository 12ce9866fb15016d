open Dolphin_imc

type t = {
  plan : string;
  number : int;
  after : float;
  busy : bool;
  begun : bool;  (* the vehicle has begun the plan at least once *)
  signs : (string * float list) list;  (* the signs that come once for each start, with their times *)
  beginning : float;  (* the last time of a report that the plan begins *)
  initializing : float;  (* the last time of a report that some plan does *)
  first_executing : float;
  last_executing : float;
  told : int;  (* the number of starts known already; the first is as it should be *)
}

let request ~plan ~number ~after ~busy =
  { plan; number; after; busy; begun = false; signs = []; beginning = neg_infinity;
    initializing = neg_infinity; first_executing = infinity; last_executing = neg_infinity; told = 1 }

let nothing = request ~plan:"" ~number:(-1) ~after:infinity ~busy:false

(* {1 Signs} *)

(* Reports of a vehicle with more different signs at each start, or more starts, are not believed in full. *)
let most_signs = 16

let once ~sent sign x =
  let stamps = Option.value (List.assoc_opt sign x.signs) ~default:[] in
  let others = List.remove_assoc sign x.signs in
  if List.mem sent stamps || List.length stamps >= most_signs || List.length others >= most_signs then x
  else { x with signs = (sign, sent :: stamps) :: others }

let begins ~sent x = { x with beginning = Float.max sent x.beginning }

let executes ~sent x =
  { x with
    begun = true;
    first_executing = (if x.busy then infinity else Float.min sent x.first_executing);
    last_executing = Float.max sent x.last_executing }

let starts_with prefix text =
  let n = String.length prefix in
  String.length text >= n && String.sub text 0 n = prefix

let ends_with suffix text =
  let n = String.length suffix and length = String.length text in
  length >= n && String.sub text (length - n) n = suffix

(* {1 The vehicle's reports} *)

let loaded = "plan loaded"
let executing = ": executing maneuver"

let reply ~sent (r : Message.t Message.Plan_control.t) x =
  match r.op, r.type_ with
  | Start, (Success | In_progress) when r.request_id = x.number && sent > x.after ->
    let x = once ~sent ("reply " ^ r.info) { x with begun = true } in
    if r.info = loaded then begins ~sent x else if ends_with executing r.info then executes ~sent x else x
  | (Start | Stop | Load | Get | Other _), (Request | Success | Failure | In_progress | Other _) -> x

let state ~sent (s : Message.Plan_control_state.t) x =
  if sent <= x.after then x
  else
    match s.state, s.last_outcome with
    | Initializing, _ -> { x with initializing = Float.max sent x.initializing }
    | Executing, _ when s.plan_id = x.plan -> executes ~sent x
    | Ready, Success when s.plan_id = x.plan -> { x with last_executing = Float.max sent x.last_executing }
    | (Executing | Ready | Blocked | Other _), (None | Success | Failure | Other _) -> x

let log ~sent (entry : Message.Log_book_entry.t) x =
  let text = entry.text in
  if sent <= x.after then x
  else if text = Printf.sprintf "request -- Start Plan (%s)" x.plan || text = "plan initializing: " ^ x.plan then
    begins ~sent (once ~sent text x)
  else if starts_with (Printf.sprintf "reply -- Start Plan (%s) -- " x.plan) text && ends_with executing text then
    once ~sent text x
  else x

(* {1 Detection} *)

(* Another plan's request leads to the same reports at first: until the vehicle executes this one again. *)
let resumed x = x.first_executing < x.initializing && x.initializing < x.last_executing

let starts x =
  let again = if x.beginning > x.first_executing || resumed x then 2 else 1 in
  List.fold_left (fun most (_, stamps) -> max most (List.length stamps)) again x.signs

let detected x =
  let starts = starts x in
  if x.begun && starts > x.told then Some ({ x with told = starts }, x.plan) else None
