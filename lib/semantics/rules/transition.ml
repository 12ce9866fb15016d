open Core

type event = Local_step.event =
  | Vehicle_done of vehicle
  | Vehicle_failed of vehicle * string
  | Timer_expired of Residual.timer
  | Confirmed of Residual.timer * (bool, string) result
  | Recruited of Residual.timer * vehicle
  | Answered of { text : string; code : closure }
  | Nobody_answers of string
  | Replied of value
  | Host_failed of string
  | Input of string * value
  | Interruption

let equal_event = Local_step.equal_event

type t = Conclusion.t = {
  rules : Rule.t list;
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;
  assumed : World.assumption list;
  otherwise : World.assumption list list;
}

type refusal = Not_awaited | Bad_answer of string
type awaited = End_of of vehicle | Expiry_of of Residual.timer | Answer_to of Residual.timer * string
             | Recruit_for of Residual.timer * Vehicle_filter.t | Answer | Reply

(* {1 Rules by control} *)

(* The transitions by each step; in a closed world every decision is made. *)
let steps program world ({ control; shared = s } : Configuration.t) : t Seq.t Decision.t Seq.t =
  match control with
  | Ended _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) -> Seq.empty
  | Script m -> fun () -> Seq.Cons (Decision.map Seq.return (Script_rules.step program world s m), Seq.empty)
  | Waiting (m, Pick pick) -> fun () -> Seq.Cons (Pick_rules.bindings world s m pick, Seq.empty)
  | Executing (m, r) ->
    let conclude = function Some local -> Seq.return (Local_step.conclude m r local) | None -> Seq.empty in
    let of_step step = Decision.map conclude (Local_step.internal program world s step) in
    Seq.map of_step (Task_rules.marked_steps Alone r)

(* Vehicles and timers are in one place of a residual only: at most one step takes the event. *)
let executing_event program world s m r event =
  let rec first (steps : Task_rules.step Seq.t) =
    match steps () with
    | Seq.Nil -> Decision.Decided (Error Not_awaited)
    | Seq.Cons (step, rest) -> (
        match Local_step.on_event program world s step event with
        | Decided None -> first rest
        | (Decided (Some _) | Open _ | Unclear _) as taken ->
          let conclude = function
            | Some local -> Ok (Local_step.conclude ~on:event m r local)
            | None -> Error Not_awaited
          in
          Decision.map conclude taken)
  in
  match event with
  | Vehicle_done v | Vehicle_failed (v, _) -> first (Task_rules.marked_steps (End_on v) r)
  | Timer_expired n | Confirmed (n, _) | Recruited (n, _) -> first (Task_rules.marked_steps (Number n) r)
  | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Input _ | Interruption -> Decided (Error Not_awaited)

let on_event program world ({ control; shared = s } as c : Configuration.t) event =
  match event, control with
  | _, Ended _ -> Decision.Decided (Error Not_awaited)
  | Interruption, (Script m | Waiting (m, _) | Executing (m, _)) -> Decided (Ok (Script_rules.interrupt program c m))
  | Input (k, x), (Script _ | Waiting _ | Executing _) when List.exists (String.equal k) program.inputs ->
    Decided (Ok (Conclusion.make Input (Input (k, Value.canonical x)) control (Shared.post k x s)))
  | (Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _), Executing (m, r) ->
    executing_event program world s m r event
  | Timer_expired timer, Waiting (m, Pick pick) when timer = Residual.script_timer ->
    Decision.map (Option.to_result ~none:Not_awaited) (Pick_rules.timed_out world s m pick)
  | Timer_expired timer, Waiting (m, Pause _) when timer = Residual.script_timer ->
    Decided (Ok (Script_rules.go_on Resume Resume Null s m))
  | Answered { text; code }, Waiting (m, Ask _) ->
    Decision.map (Result.map_error (fun why -> Bad_answer why)) (Script_rules.answer program world s m ~text code)
  | Nobody_answers why, Waiting (m, Ask prompt) ->
    Decided (Ok (Script_rules.fail Answer_err No_answer (Printf.sprintf "no answer to '%s': %s" prompt why) s m))
  | Replied x, Waiting (m, Host_call _) -> Decided (Ok (Script_rules.go_on Reply (Reply (Value.to_string x)) x s m))
  | Host_failed why, Waiting (m, Host_call { subject; member; _ }) ->
    let call = Machine.name_of_call ~subject ~member in
    Decided (Ok (Script_rules.fail Call_err (No_reply why) (Printf.sprintf "%s: %s" call why) s m))
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _
      | Replied _ | Host_failed _ | Input _ ),
      (Script _ | Waiting _ | Executing _) ) -> Decided (Error Not_awaited)

(* {1 In closed worlds} *)

let internal program world c =
  let decided = function Decision.Decided ts -> ts | Open _ | Unclear _ -> Seq.empty in
  Seq.flat_map decided (steps program world c)

let accept program world c event =
  match on_event program world c event with
  | Decided result -> result
  | Open _ | Unclear _ -> Error Not_awaited

(* {1 In open worlds} *)

let ( let* ) = Result.bind
let equal (t : t) (t' : t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next
let with_assumed (assumed, (t : t)) = { t with assumed }

(* Without duplicates. If all cases have one transition, it assumes nothing. *)
let different d =
  let with_all (assumed, (t : t)) = { t with assumed = List.hd assumed; otherwise = List.tl assumed } in
  Result.map (List.map with_all) (Decision.outcomes ~equal d)

module Seen = Hashtbl.Make (struct
    type nonrec t = t

    let equal = equal
    let hash (t : t) = Configuration.hash t.next
  end)

let distinct transition ts () =
  let seen = Seen.create 16 in
  let is_new x =
    let t = transition x in
    let is_new = not (Seen.mem seen t) in
    if is_new then Seen.add seen t ();
    is_new
  in
  Seq.filter is_new ts ()

(* The choices of a pick, of which each case may have several. A pick asks the world for places only, and these are
   always known or listed: no case is unclear. *)
let choices d =
  let of_case (assumed, ts) =
    match ts with Ok ts -> Seq.map (fun t -> with_assumed (assumed, t)) ts | Error (_ : Fault.t) -> Seq.empty
  in
  distinct Fun.id (Seq.flat_map of_case (Decision.leaves d))

let first ts = match ts () with Seq.Nil -> None | Seq.Cons (t, _) -> Some t

let internal_listed program world (c : Configuration.t) =
  if not (World.is_open world) then (internal program world c, None)
  else
    match c.control with
    | Waiting _ -> (Seq.flat_map choices (steps program world c), None)
    | Script _ | Executing _ | Ended _ ->
      let add (found, unclear) d =
        match different (Decision.map first d), unclear with
        | Ok ts, _ -> (List.rev_append ts found, unclear)
        | Error fault, None -> (found, Some fault)
        | Error _, Some _ -> (found, unclear)
      in
      let found, unclear = Seq.fold_left add ([], None) (steps program world c) in
      (List.to_seq (List.rev found), unclear)

let internal_all program world c =
  match internal_listed program world c with
  | ts, None -> Ok ts
  | _, Some fault -> Error fault

let accept_all program world c event =
  match on_event program world c event with
  | Decided result -> Ok [ result ]
  | (Open _ | Unclear _) as d -> (
      let* accepted = different (Decision.map Result.to_option d) in
      match accepted with
      | [] -> Result.map (fun cases -> [ snd (List.hd cases) ]) (Decision.cases d)
      | ts -> Ok (List.map Result.ok ts))

(* {1 Interruptions} *)

let on_interrupt = Script_rules.on_interrupt

let is_leaving (c : Configuration.t) =
  match c.control with
  | Script m | Waiting (m, _) | Executing (m, _) -> Machine.is_leaving m
  | Ended _ -> false

(* {1 What is awaited} *)

let events (c : Configuration.t) : awaited Seq.t =
  match c.control with
  | Script _ | Ended _ | Waiting (_, Execute _) -> Seq.empty
  | Waiting (_, (Pick _ | Pause _)) -> Seq.return (Expiry_of Residual.script_timer)
  | Waiting (_, Ask _) -> Seq.return Answer
  | Waiting (_, Host_call _) -> Seq.return Reply
  | Executing (_, r) ->
    let event (Task_rules.Step { offer; _ }) : awaited option =
      match offer with
      | End_of (_, v) -> Some (End_of v)
      | Expiry_of timer -> Some (Expiry_of timer)
      | Answer_to (question, prompt) -> Some (Answer_to (question, prompt))
      | Recruit_for (number, asked) -> Some (Recruit_for (number, asked))
      | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _
      | Allocate _ -> None
    in
    Seq.filter_map event (Task_rules.steps r)

let awaited c = List.of_seq (events c)
let awaits_event c = match events c () with Seq.Nil -> false | Cons _ -> true

let recruitable program world (c : Configuration.t) : event Seq.t =
  match c.control with
  | Executing (_, r) when program.recruits ->
    let of_step (Task_rules.Step { offer; _ }) =
      match offer with
      | Recruit_for (number, asked) ->
        List.to_seq (List.map (fun v -> Recruited (number, v)) (Fit.wherever world c.shared asked))
      | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _
      | Allocate _ | End_of _ | Expiry_of _ | Answer_to _ -> Seq.empty
    in
    Seq.flat_map of_step (Task_rules.marked_steps Recruits r)
  | Executing _ | Script _ | Waiting _ | Ended _ -> Seq.empty

let recruited program world c =
  let accepted event = Option.map (fun t -> (event, t)) (Result.to_option (accept program world c event)) in
  match Seq.filter_map accepted (recruitable program world c) () with Seq.Nil -> None | Cons (first, _) -> Some first

let unknown program world (c : Configuration.t) =
  let of_guard (guard : closure) =
    match Run_code.atomic program world c.shared guard with
    | Decided { outcome = Gives (Unknown u, _, _); _ } -> Some (Fault.unknown guard.lambda.lambda_site u)
    | Decided { outcome = Faulty (fault, _); _ } when Fault.is_unknown fault -> Some fault
    | Decided { outcome = Gives _ | Faulty _ | Halts _; _ } | Open _ | Unclear _ -> None
  in
  let of_step (Task_rules.Step { offer; _ }) =
    match offer with
    | Check guard -> of_guard guard
    | Guard_values guard -> of_guard guard
    | Guard_false guard -> of_guard guard
    | Guard_either guard -> of_guard guard
    | Start _ | Perform _ | Measure _ | Make _ | Allocate _ | End_of _ | Expiry_of _ | Answer_to _
    | Recruit_for _ -> None
  in
  match c.control with
  | Executing (_, r) when program.reads_sensors -> List.of_seq (Seq.filter_map of_step (Task_rules.steps r))
  | Executing _ | Script _ | Waiting _ | Ended _ -> []

let depends_on_sensors (program : program) (c : Configuration.t) =
  match c.control with
  | Waiting (_, Pick _) -> true
  | Executing (_, r) -> program.reads_sensors || (program.recruits && Residual.awaits Recruits r)
  | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Script _ -> program.reads_sensors
  | Ended _ -> false
