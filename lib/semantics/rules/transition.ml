open Core

type event = Local_step.event =
  | Vehicle_done of vehicle
  | Vehicle_failed of vehicle * string
  | Timer_expired of Residual.timer
  | Answered of { text : string; code : closure }
  | Nobody_answers of string
  | Replied of value
  | Host_failed of string
  | Interruption

type t = Conclusion.t = {
  rules : Rule.t list;
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;
  assumed : World.assumption list;
}

type refusal = Not_awaited | Bad_answer of string
type awaited = End_of of vehicle | Expiry_of of Residual.timer | Answer | Reply

(* {1 Of all that is left open} *)

let equal (t : t) (t' : t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next
let with_assumed (assumed, (t : t)) = { t with assumed }

(* What [f] gives, one transition at most, in each world that [world] leaves open. *)
let in_all world f = List.map with_assumed (World.outcomes ~equal world f)

let bindings_in_all world s m pick : t Seq.t =
  if not (World.is_open world) then Pick_rules.bindings world s m pick
  else fun () ->
    let add found (assumed, ts) =
      let fresh = List.filter (fun t -> not (List.exists (equal t) found)) ts in
      found @ List.map (fun t -> with_assumed (assumed, t)) fresh
    in
    let cases = World.cases world (fun world -> List.of_seq (Pick_rules.bindings world s m pick)) in
    List.to_seq (List.fold_left add [] cases) ()

let internal program world ({ control; shared = s } : Configuration.t) : t Seq.t =
  match control with
  | Ended _ -> Seq.empty
  | Script m -> fun () -> List.to_seq (in_all world (fun world -> Some (Script_rules.step program world s m))) ()
  | Waiting (m, Pick pick) -> fun () -> bindings_in_all world s m pick ()
  | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) -> Seq.empty
  | Executing (m, r) ->
    let in_one step world = Option.map (Local_step.conclude m r) (Local_step.internal program world s step) in
    Seq.flat_map (fun step -> List.to_seq (in_all world (in_one step))) (Task_rules.internal_steps r)

(* {1 Events} *)

(* Vehicles and timers are in one place of a residual only: at most one step takes the event. *)
let executing_event program world s m r event =
  let rec first (steps : Task_rules.step Seq.t) =
    match steps () with
    | Seq.Nil -> [ Error Not_awaited ]
    | Seq.Cons (step, rest) -> (
        let taken world = Option.map (Local_step.conclude m r) (Local_step.on_event program world s step event) in
        match in_all world taken with
        | [] -> first rest
        | ts -> List.map Result.ok ts)
  in
  match event with
  | Vehicle_done v | Vehicle_failed (v, _) -> first (Task_rules.steps_of_vehicle v r)
  | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Interruption ->
    first (Task_rules.steps r)

(* Of a configuration that executes nothing, in a world of which enough is known. *)
let whole_event program world ({ control; shared = s } as c : Configuration.t) event =
  match event, control with
  | _, Ended _ -> Error Not_awaited
  | Interruption, (Script _ | Waiting _ | Executing _) ->
    Ok (Conclusion.ending ~timers:(Configuration.timers c) [ Interrupt ] Interrupt s Interrupted)
  | Timer_expired timer, Waiting (m, Pick pick) when timer = Residual.script_timer ->
    Option.to_result ~none:Not_awaited (Pick_rules.timed_out world s m pick)
  | Timer_expired timer, Waiting (m, Pause _) when timer = Residual.script_timer ->
    Ok (Script_rules.go_on Resume Resume Null s m)
  | Answered { text; code }, Waiting (m, Ask _) ->
    Result.map_error (fun why -> Bad_answer why) (Script_rules.answer program world s m ~text code)
  | Nobody_answers why, Waiting (m, Ask prompt) ->
    Ok (Script_rules.fail Answer_err No_answer (Printf.sprintf "no answer to '%s': %s" prompt why) s m)
  | Replied x, Waiting (m, Host_call _) -> Ok (Script_rules.go_on Reply (Reply (Value.to_string x)) x s m)
  | Host_failed why, Waiting (m, Host_call { subject; member; _ }) ->
    let call = Machine.name_of_call ~subject ~member in
    Ok (Script_rules.fail Call_err (No_reply why) (Printf.sprintf "%s: %s" call why) s m)
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _
      | Host_failed _ ),
      (Script _ | Waiting _ | Executing _) ) -> Error Not_awaited

let accept_all program world (c : Configuration.t) event =
  match event, c.control with
  | (Vehicle_done _ | Vehicle_failed _ | Timer_expired _), Executing (m, r) ->
    executing_event program world c.shared m r event
  | _, _ -> (
      let accepted world = Result.to_option (whole_event program world c event) in
      match in_all world accepted with
      | [] -> [ snd (List.hd (World.cases world (fun world -> whole_event program world c event))) ]
      | ts -> List.map Result.ok ts)

(* There is always one, if only a refusal. *)
let accept program world c event = List.hd (accept_all program world c event)

let awaited (c : Configuration.t) =
  match c.control with
  | Script _ | Ended _ | Waiting (_, Execute _) -> []
  | Waiting (_, (Pick _ | Pause _)) -> [ Expiry_of Residual.script_timer ]
  | Waiting (_, Ask _) -> [ Answer ]
  | Waiting (_, Host_call _) -> [ Reply ]
  | Executing (_, r) ->
    let event (Task_rules.Step { offer; _ }) : awaited option =
      match offer with
      | End_of (_, v) -> Some (End_of v)
      | Expiry_of timer -> Some (Expiry_of timer)
      | Start _ | Perform _ | Check _ | Measure _ -> None
    in
    List.of_seq (Seq.filter_map event (Task_rules.steps r))

let depends_on_sensors (program : program) (c : Configuration.t) =
  match c.control with
  | Waiting (_, Pick _) -> true
  | Executing _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Script _ -> program.reads_sensors
  | Ended _ -> false
