open Dolphin_imc
module Control = Message.Plan_control
module Control_state = Message.Plan_control_state

type order = { plan : string; specification : Message.t Message.Plan_specification.t option }
type output = Keep of Durable_note.t | Send of Message.t | Done | Failed of string | Note of string

let grace = 1.
let stop_interval = 0.5
let stop_patience = 60.

(* For so long after it was sent last, a datagram of ours may still arrive. *)
let echo = 10.

(* For so long a plan that we gave up is stopped when the vehicle is heard again. *)
let remembrance = 600.

type sighting = { sent : float; state : Control_state.t }

(* An order as the vehicle was asked. [before] and [after]: what it had said last, and when, by its clock, it had said
   anything last, when the request was first sent. [asked]: what its clock showed at the last copy, at most. *)
type attempt = {
  order : order;
  request : int;
  copies : int;
  last_sent : float;
  asked : float;
  before : sighting option;
  after : float;
  accepted : float option;  (* when the vehicle first answered that it takes the plan *)
  adopted : bool;  (* the request was a console's that has died *)
  initialised : bool;  (* INITIALIZING was seen *)
}

type phase =
  | Idle
  | Starting of attempt
  | Running of { attempt : attempt; since : float }
  | Ending of { attempt : attempt; since : float; why : string; deadline : float }
  (* It failed; the vehicle's words are awaited. *)
  | Stopping of {
      attempt : attempt;
      took_effect : bool;  (* the plan was seen to be taken *)
      stop : int;
      after : float;
      first_sent : float;
      last_sent : float;
      next : order option;
    }

(* The order before, over since [ended] by the vehicle's clock. If it is seen to run again before [watched_until], then
   because of a late copy of our request. *)
type former = {
  attempt : attempt;
  ended : float;
  watched_until : float;
  given_up : bool;  (* it was not heard to be over *)
}

type t = {
  next_request : int;
  seen : sighting option;
  error : (float * string) option;  (* the last error that the vehicle reported, and when *)
  abort : string option;
  last_stop : int option;
  stop_echo : float;  (* when the vehicle last answered a stop of ours *)
  former : former option;
  takes : Duplicates.t;  (* of the last request *)
  phase : phase;
}

let create ~request =
  { next_request = request land 0xFFFF; seen = None; error = None; abort = None; last_stop = None;
    stop_echo = neg_infinity; former = None; takes = Duplicates.nothing; phase = Idle }

let idle x = match x.phase with Idle -> true | Starting _ | Running _ | Ending _ | Stopping _ -> false

let owes x =
  match x.phase with
  | Starting _ | Running _ | Ending _ | Stopping { next = Some _; _ } -> true
  | Idle | Stopping { next = None; _ } -> false

let unsettled x =
  let unheard_since time = match x.seen with Some s -> s.sent <= time | None -> true in
  match x.phase, x.former with
  | Stopping { attempt; next = None; _ }, _ -> Some attempt.order.plan
  | Idle, Some { attempt; ended; given_up = true; _ } when unheard_since ended -> Some attempt.order.plan
  | (Idle | Starting _ | Running _ | Ending _ | Stopping _), _ -> None

let due x =
  match x.phase with
  | Idle | Starting _ | Running _ -> infinity
  | Ending e -> e.deadline
  | Stopping s -> Float.min (s.last_sent +. stop_interval) (s.first_sent +. stop_patience)

(* {1 Sightings} *)

let is (plan : string) (s : sighting) = s.state.plan_id = plan

(* The states in which a plan that runs, or has just been taken, is seen. *)
let busy (s : sighting) =
  match s.state.state with
  | Executing | Initializing -> true
  | Blocked | Ready | Other _ -> false

let succeeded (s : sighting) =
  match s.state.last_outcome with
  | Success -> true
  | None | Failure | Other _ -> false

let failed (s : sighting) =
  match s.state.last_outcome with
  | Failure -> true
  | None | Success | Other _ -> false

(* {1 Requests} *)

let number x = (x.next_request, { x with next_request = (x.next_request + 1) land 0xFFFF })

let request op number (order : order) arg =
  Send
    (Message.Plan_control
       { Control.default with type_ = Request; op; request_id = number; plan_id = order.plan; arg })

let start_message (a : attempt) =
  request Start a.request a.order (Option.map (fun s -> Message.Plan_specification s) a.order.specification)

let begin_attempt ~now ~clock order x =
  let request, x = number x in
  let attempt =
    { order; request; copies = 1; last_sent = now;
      asked = Vehicle_clock.estimate ~now clock;
      before = x.seen;
      after = Vehicle_clock.latest clock;
      accepted = None; adopted = false; initialised = false }
  in
  let busy = match x.seen with Some s -> busy s && is order.plan s | None -> false in
  let takes = Duplicates.request ~plan:order.plan ~number:request ~after:attempt.after ~busy in
  ({ x with phase = Starting attempt; abort = None; takes }, [ start_message attempt ])

let begin_stop ~now ~clock ~took_effect ?next attempt x =
  let stop, x = number x in
  let phase =
    Stopping
      { attempt; took_effect; stop; after = Vehicle_clock.latest clock; first_sent = now; last_sent = now; next }
  in
  ({ x with phase; last_stop = Some stop }, [ request Stop stop attempt.order None ])

let resend ~now ~clock (a : attempt) x =
  let a =
    { a with copies = a.copies + 1; last_sent = now; asked = Vehicle_clock.estimate ~now clock }
  in
  ({ x with phase = Starting a }, [ start_message a ])

(* {1 Verdicts} *)

(* The order is over. *)
let close ?(watch = echo) ~now ~ended (attempt : attempt) x =
  let given_up = watch > echo in
  let from = if given_up then now else attempt.last_sent in
  { x with phase = Idle; former = Some { attempt; ended; watched_until = from +. watch; given_up } }

let fail ?watch ~now ~ended attempt why x = (close ?watch ~now ~ended attempt x, [ Failed why ])
let succeed ~now ~ended attempt x = (close ~now ~ended attempt x, [ Done ])

(* When, by the vehicle's clock, the order took effect, as far as is known. *)
let effect_of (a : attempt) = Option.value a.accepted ~default:a.after

(* A stop of an earlier plan that arrived late ended this one. *)
let hit_by_late_stop x ~since = x.stop_echo > since

let start_again ~now ~clock (a : attempt) why x =
  let x, outputs = begin_attempt ~now ~clock a.order x in
  (x, Note (Printf.sprintf "%s; plan %s is started again" why a.order.plan) :: outputs)

let late_stop = "a stop of the plan before arrived late"

let expect_words ~now ~clock (attempt : attempt) ~since why x =
  if hit_by_late_stop x ~since then start_again ~now ~clock attempt late_stop x
  else ({ x with phase = Ending { attempt; since; why; deadline = now +. grace } }, [])

(* The vehicle executes, or has executed, plan [other]. *)
let replaced ~now ~clock ~ended (attempt : attempt) other x =
  match x.former with
  | Some f when f.attempt.order.plan = other && now < f.watched_until ->
    start_again ~now ~clock attempt (Printf.sprintf "the request for plan %s arrived late" other) x
  | Some _ | None -> fail ~now ~ended attempt (Printf.sprintf "replaced by plan %s" other) x

let words x ~since ~why =
  match x.error, x.abort with
  | Some (at, error), _ when at > since -> error
  | (Some _ | None), Some by -> Printf.sprintf "aborted by %s" by
  | (Some _ | None), None -> why
