open Dolphin_imc

type output = Keep of Durable_note.t | Send of Message.t | Done | Failed of string | Remark of string

let grace = 1.
let late_copies = 10.

type phase =
  | Idle
  | Starting of Attempt.t
  | Running of { attempt : Attempt.t; since : float }
  | Ending of { attempt : Attempt.t; since : float; why : string; deadline : float }
  | Stopping of {
      attempt : Attempt.t;
      took_effect : bool;
      stop : int;
      after : float;
      over : float option;
      first_sent : float;
      last_sent : float;
      aborted : float option;
      warned : bool;
      next : Attempt.order option;
    }

type former = {
  attempt : Attempt.t;
  ended : float;
  watched_until : float;
  given_up : bool;
  unrested_until : float;
}

type t = {
  next_request : int;
  latest : Plan_report.t option;
  mode : (float * Message.Vehicle_state.Op_mode.t) option;
  error : (float * string) option;
  log_errors : Log_errors.t;
  intervention : string option;
  last_stop : int option;
  stop_echo : float;
  former : former option;
  duplicates : Duplicates.t;
  abort_after : float;
  may_run : int option;
  phase : phase;
}

let create ?(abort_after = infinity) ~request () =
  { next_request = request land 0xFFFF; latest = None; mode = None; error = None; log_errors = Log_errors.none;
    intervention = None; last_stop = None; stop_echo = neg_infinity; former = None; duplicates = Duplicates.nothing;
    abort_after; may_run = None; phase = Idle }

let attempt x : (Attempt.t * Attempt.stage) option =
  match x.phase with
  | Idle -> None
  | Starting attempt -> Some (attempt, Starting)
  | Running { attempt; _ } | Ending { attempt; _ } -> Some (attempt, Running)
  | Stopping { attempt; _ } -> Some (attempt, Stopping)

(* {1 What VehicleState shows} *)

let is_at_rest : Message.Vehicle_state.Op_mode.t -> bool = function
  | Maneuver | Calibration -> false
  | Service | Error | External | Boot | Other _ -> true

let maneuvers ~since x = match x.mode with Some (sent, mode) -> sent > since && not (is_at_rest mode) | None -> false
let rests ~since x = match x.mode with Some (sent, mode) -> sent >= since && is_at_rest mode | None -> false

(* {1 From phase to phase} *)

let number x = (x.next_request, { x with next_request = (x.next_request + 1) land 0xFFFF })

let begin_attempt ~now ~clock (order : Attempt.order) x =
  let request, x = number x in
  let attempt = Attempt.make ~now ~clock ~request ~before:x.latest order in
  let duplicates =
    Duplicates.request ~plan:order.plan ~number:request ~after:attempt.after
      ~busy:(Attempt.was_busy_with order.plan attempt)
  in
  ({ x with phase = Starting attempt; intervention = None; duplicates }, [ Send (Attempt.start attempt) ])

let send_again ~now ~clock attempt x =
  let attempt = Attempt.send_again ~now ~clock attempt in
  ({ x with phase = Starting attempt }, [ Send (Attempt.start attempt) ])

let begin_stop ~now ~clock ~took_effect ?next attempt x =
  let stop, x = number x in
  let after = Vehicle_clock.latest clock in
  let phase =
    Stopping
      { attempt; took_effect; stop; after; over = None; first_sent = now; last_sent = now; aborted = None;
        warned = false; next }
  in
  ({ x with phase; last_stop = Some stop }, [ Send (Attempt.stop ~request:stop attempt) ])

let was_taken x =
  match x.phase with
  | Starting a -> a.accepted <> None
  | Running _ | Ending _ -> true
  | Stopping s -> s.took_effect
  | Idle -> false

(* The time for which a vehicle that was not seen to rest is watched. *)
let rest_watch = 600.

(* The attempt is over. The vehicle is watched for late copies of the request, or [watch] from now. *)
let close ?(watch = late_copies) ?ours ~now ~ended (attempt : Attempt.t) x =
  let given_up = watch > late_copies in
  let from = if given_up then now else attempt.last_sent in
  let ours = match ours with Some ours -> ours | None -> was_taken x in
  let unrested_until =
    if not ours then Option.fold x.former ~none:neg_infinity ~some:(fun f -> f.unrested_until)
    else if rests ~since:ended x then neg_infinity
    else now +. rest_watch
  in
  { x with phase = Idle; former = Some { attempt; ended; watched_until = from +. watch; given_up; unrested_until } }

let fail ?watch ?ours ~now ~ended attempt why x = (close ?watch ?ours ~now ~ended attempt x, [ Failed why ])
let succeed ~now ~ended attempt x = (close ~now ~ended attempt x, [ Done ])

(* A stop of an earlier plan that arrived late ended this one. *)
let hit_by_late_stop x ~since = x.stop_echo > since
let late_stop = "a stop of the plan before arrived late"

let start_again ~now ~clock (a : Attempt.t) why x =
  let x, outputs = begin_attempt ~now ~clock a.order x in
  (x, Remark (Printf.sprintf "%s; plan %s is started again" why a.order.plan) :: outputs)

let await_words ~now ~clock attempt ~since why x =
  if hit_by_late_stop x ~since then start_again ~now ~clock attempt late_stop x
  else ({ x with phase = Ending { attempt; since; why; deadline = now +. grace } }, [])

(* The vehicle executes, or has executed, plan [other]. *)
let replaced ~now ~clock ~ended attempt other x =
  match x.former with
  | Some f when f.attempt.order.plan = other && now < f.watched_until ->
    start_again ~now ~clock attempt (Printf.sprintf "the request for plan %s arrived late" other) x
  | Some _ | None -> fail ~ours:false ~now ~ended attempt (Printf.sprintf "replaced by plan %s" other) x

(* Why it failed, in the vehicle's words if there are any. *)
let words x ~since ~why =
  match x.error, x.intervention with
  | Some (at, error), _ when at > since -> error
  | (Some _ | None), Some what -> what
  | (Some _ | None), None -> why
