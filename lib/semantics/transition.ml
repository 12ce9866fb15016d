open Core
module Vehicle_map = Configuration.Vehicle_map

type event =
  | Vehicle_done of vehicle
  | Vehicle_failed of vehicle * string
  | Timer_expired of Residual.timer
  | Answered of string
  | Nobody_answers of string
  | Replied of value
  | Host_failed of string
  | Interruption

type t = { rules : Rule.t list; label : Label.t; next : Configuration.t; effects : Effect.t list }
type refusal = Not_awaited | Bad_answer of string

(* The script runs so many expressions in one silent transition, then lets others see it; atomic code may take so
   many before it counts as endless. *)
let script_fuel = 100_000
let atomic_fuel = 2_000_000

let context program world (c : Configuration.t) mode : Machine.context =
  { program; world; bound = c.bound; store = c.store; tuples = c.tuples; mode; deeds = [] }

(* {1 Ends} *)

let timers_of = function
  | Configuration.Executing (_, r) -> Residual.timers r
  | Waiting (_, (Pick _ | Pause _)) -> [ Effect.script_timer ]
  | Waiting (_, (Ask _ | Execute _ | Host_call _)) | Script _ | Ended _ -> []

(* Everything stops, all of B is released; timers that the effects [before] cancel already are left alone. *)
let ended (c : Configuration.t) ending before =
  let cancelled = List.map (fun timer -> Effect.Cancel_timer timer) (timers_of c.control) in
  let cancelled = List.filter (fun cancel -> not (List.mem cancel before)) cancelled in
  let stopped = List.map (fun (v, _) -> Effect.Stop v) (Vehicle_map.bindings c.allocation) in
  let released = if c.bound = [] then [] else [ Effect.Release c.bound ] in
  let next = { c with control = Ended ending; allocation = Vehicle_map.empty; bound = [] } in
  (next, cancelled @ stopped @ released @ [ Effect.End ending ])

let ending_transition c rules label ending before =
  let next, effects = ended c ending before in
  { rules; label; next; effects = before @ effects }

(* {1 Deeds of code} *)

let release vs (c : Configuration.t) =
  { c with
    bound = List.filter (fun v -> not (List.mem v vs)) c.bound;
    allocation = Vehicle_map.filter (fun v _ -> not (List.mem v vs)) c.allocation }

let effect_of_deed : Machine.deed -> Effect.t option = function
  | Posted _ | Consumed _ -> None
  | Said text -> Some (Say text)
  | Released vs -> Some (Release vs)
  | Set_connection_timeout (vs, seconds) -> Some (Set_connection_timeout (vs, seconds))

let after (context : Machine.context) (c : Configuration.t) =
  { c with store = context.store; tuples = context.tuples }

let deeds (context : Machine.context) = List.rev context.deeds
let effects_of deeds = List.filter_map effect_of_deed deeds

let rule_of_deed : Machine.deed -> Rule.t = function
  | Posted _ -> Post
  | Consumed _ -> Consume
  | Said _ -> Message
  | Released _ -> Release
  | Set_connection_timeout _ -> Set_timeout

(* {1 The script} *)

let describe_call subject member =
  match subject with None -> member | Some subject -> Printf.sprintf "%s.%s" subject member

let waiting c m (request : Machine.request) rule label effects =
  { rules = [ rule ]; label; next = { c with Configuration.control = Waiting (m, request) }; effects }

let timers_started = List.map (fun (timer, seconds) -> Effect.Set_timer (timer, seconds))

let start_execution world (c : Configuration.t) m t =
  match Allocation.allocate world c.bound t with
  | Error fault ->
    ending_transition c [ Rule.Alloc_err ] (Label.Cannot_execute fault.message) (Failed fault) []
  | Ok r ->
    let r, timers = Residual.activate r in
    let next = { c with control = Executing (m, r) } in
    { rules = [ Rule.Execute ]; label = Label.Execute; next; effects = timers_started timers }

let wait world c m (request : Machine.request) =
  match request with
  | Execute t -> start_execution world c m t
  | Pick pick ->
    waiting c m request Rule.Pick (Label.Pick (Format.asprintf "%a" Settings.pp_pick pick)) [ Look_for pick ]
  | Ask prompt -> waiting c m request Rule.Ask (Label.Ask prompt) [ Ask prompt ]
  | Pause seconds ->
    waiting c m request Rule.Pause (Label.Pause seconds) [ Set_timer (Effect.script_timer, seconds) ]
  | Host_call { subject; member; arguments } ->
    let effect = Effect.Call_host { subject; member; arguments } in
    waiting c m request Rule.Call (Label.Call (describe_call subject member)) [ effect ]

let run_script program world (c : Configuration.t) m =
  let stop, m, context = Machine.run ~fuel:script_fuel (context program world c Script) m in
  let c = after context c in
  let going rules label effects = { rules; label; next = { c with control = Script m }; effects } in
  match stop with
  | Exhausted -> going [ Rule.Script ] Label.Silent []
  | Did -> (
      match context.deeds with
      | [] -> invalid_arg "Transition.run_script: no deed"
      | deed :: _ ->
        let effects = effects_of [ deed ] in
        let step = going [ rule_of_deed deed ] (Label.Did deed) effects in
        (match deed with
         | Released vs -> { step with next = release vs step.next }
         | Posted _ | Consumed _ | Said _ | Set_connection_timeout _ -> step))
  | Waits request -> wait world c m request
  | Finished _ -> ending_transition c [ Rule.End ] Label.End Completed []
  | Halted message -> ending_transition c [ Rule.Halt ] (Label.Halt message) (Halted message) []
  | Faulted fault -> ending_transition c [ Rule.Fault ] (Label.Fault fault.message) (Failed fault) []

(* {1 Picking vehicles} *)

let candidates world (c : Configuration.t) (pick : Settings.pick) =
  let fits (s : World.vehicle_state) = Settings.accepts pick.filter s && not (List.mem s.id c.bound) in
  List.map (fun (s : World.vehicle_state) -> s.id) (List.filter fits (World.vehicles world))

(* All lists of [n] elements of [xs] in their order, the first ones first. *)
let rec choices n xs : 'a list Seq.t =
  match n, xs with
  | 0, _ -> Seq.return []
  | _, [] -> Seq.empty
  | n, x :: rest ->
    fun () -> Seq.append (Seq.map (fun chosen -> x :: chosen) (choices (n - 1) rest)) (choices n rest) ()

let bind (c : Configuration.t) m effects vs =
  let next = { c with control = Script (Machine.give (Vehicles vs) m); bound = c.bound @ vs } in
  { rules = [ Rule.Pick_bind ]; label = Label.Bind vs; next; effects = effects @ [ Effect.Bind vs ] }

(* The ways to meet a [pick] now. One that takes all there are waits for its whole time-out. *)
let bindings world (c : Configuration.t) m (pick : Settings.pick) =
  match pick.count with
  | All -> Seq.empty
  | Exactly n ->
    Seq.map (bind c m [ Effect.Cancel_timer Effect.script_timer ]) (choices n (candidates world c pick))

let why_not world (c : Configuration.t) (pick : Settings.pick) (s : World.vehicle_state) =
  let f = pick.filter in
  let region_missed = match f.region with Some a -> not (Dolphin_geo.Area.contains a s.position) | None -> false in
  let reason =
    if List.mem s.id c.bound then "is already bound"
    else if not s.connected then "is not connected"
    else if Option.fold ~none:false ~some:(fun id -> id <> s.id) f.id then "has another id"
    else if Option.fold ~none:false ~some:(fun kind -> kind <> s.kind) f.kind then "is a " ^ s.kind
    else if not (World.carries f.payload s) then
      "lacks " ^ String.concat ", " (List.filter (fun d -> not (World.carries [ d ] s)) f.payload)
    else if region_missed then Format.asprintf "is at %a, outside of the region" Dolphin_geo.Position.pp s.position
    else "fits"
  in
  ignore world;
  Printf.sprintf "%s %s" s.id reason

let no_vehicles world (c : Configuration.t) m pick =
  let there =
    match World.vehicles world with
    | [] -> "no vehicle was heard of"
    | states ->
      let shown = List.filteri (fun i _ -> i < 8) states in
      let more = List.length states - List.length shown in
      String.concat "; " (List.map (why_not world c pick) shown)
      ^ if more > 0 then Printf.sprintf "; and %d more" more else ""
  in
  let message = Format.asprintf "could not pick %a: %s" Settings.pp_pick pick there in
  ending_transition
    { c with control = Script m }
    [ Rule.Pick_err ] (Label.No_vehicles message)
    (Failed (Fault.make (Machine.site m) message))
    []

(* A [pick] that can be met is met, however late: its time is up for those only that cannot. *)
let pick_timed_out world c m (pick : Settings.pick) =
  match pick.count, candidates world c pick with
  | All, (_ :: _ as vs) -> Ok (bind c m [] vs)
  | All, [] -> Ok (no_vehicles world c m pick)
  | Exactly n, vs -> if List.length vs >= n then Error Not_awaited else Ok (no_vehicles world c m pick)

(* {1 Steps of the executing task} *)

type code_result = Value_of of value | Broke of Fault.t | Halted_with of string

let run_code program world c mode closure arguments =
  let start = context program world c mode in
  let stop, _, context = Machine.run ~fuel:atomic_fuel start (Machine.call closure arguments) in
  match stop with
  | Finished x -> (Value_of x, context)
  | Halted message -> (Halted_with message, context)
  | Faulted fault -> (Broke fault, start)
  | Exhausted ->
    let message = "this code does not come to an end, and code inside of a task is atomic" in
    (Broke (Fault.make closure.lambda.lambda_site message), start)
  | Did | Waits _ -> invalid_arg "Transition.run_code: atomic code stopped"

let active_changes (change : Residual.change) =
  let cut = change.abandoned in
  let cancelled = change.cancelled @ List.concat_map Residual.timers cut in
  (cancelled, List.concat_map Residual.running cut)

(* [settle c m change] carries a change of the residual over to the configuration, handlers of errors included.
   [effects] are those of the step itself. *)
let rec settle program world (c : Configuration.t) m label rules effects (change : Residual.change) =
  let cancelled, stopped = active_changes change in
  let rules = rules @ change.rules in
  let allocation = List.fold_left (fun a v -> Vehicle_map.remove v a) c.allocation stopped in
  let settled = { c with allocation } in
  let effects =
    effects
    @ List.map (fun timer -> Effect.Cancel_timer timer) cancelled
    @ List.map (fun v -> Effect.Stop v) stopped
    @ timers_started change.timers
  in
  match change.outcome with
  | Next r -> { rules; label; next = { settled with control = Executing (m, r) }; effects }
  | Finished ->
    let next = { settled with control = Script (Machine.give Null m) } in
    { rules = rules @ [ Rule.Execute_done ]; label; next; effects }
  | Failed fault ->
    ending_transition { settled with control = Script m } (rules @ [ Rule.Execute_err ]) label (Failed fault) effects
  | Handling { handler; fault; ignored; propagated } -> (
      let mode = Machine.Handler Propagated in
      let result, context = run_code program world settled mode handler [ String fault.message ] in
      let settled = after context settled in
      let effects = effects @ effects_of (deeds context) in
      match result, context.mode with
      | Halted_with message, _ ->
        ending_transition
          { settled with control = c.control }
          (rules @ [ Rule.Watch_halt ])
          label (Halted message) effects
      | Broke fault, _ -> settle program world settled m label rules effects (propagated fault)
      | Value_of _, Handler Ignored -> settle program world settled m label rules effects (ignored ())
      | Value_of _, (Handler Propagated | Script | Task_code) ->
        settle program world settled m label rules effects (propagated fault))

let check_label (change : Residual.change) deeds =
  match change.rules with Rule.Until_cut :: _ -> Label.Cut deeds | _ -> Label.Check deeds

(* The transition of one local step that needs no event, if it is enabled. *)
let internal_step program world (c : Configuration.t) m (step : Residual.step) =
  let coded closure continue =
    let result, context = run_code program world c Task_code closure [] in
    let d = deeds context in
    match result with
    | Broke fault ->
      Some (settle program world c m (Label.Broken fault.message) [] [] (step.continue (Broke fault)))
    | Halted_with message ->
      let c = after context c in
      Some (ending_transition c [ Rule.Halt ] (Label.Halt message) (Halted message) (effects_of d))
    | Value_of x -> continue x (after context c) d
  in
  match step.offer with
  | End_of _ | Expiry_of _ -> None
  | Start (p, v) ->
    let c = { c with allocation = Vehicle_map.add v p c.allocation } in
    Some (settle program world c m (Label.Start (v, p.name)) [] [ Start (v, p) ] (step.continue Went))
  | Perform closure ->
    coded closure (fun _ c d -> Some (settle program world c m (Label.Act d) [] (effects_of d) (step.continue Went)))
  | Check closure ->
    coded closure (fun x c d ->
        if Value.truth x then
          let change = step.continue Went in
          Some (settle program world c m (check_label change d) [] (effects_of d) change)
        else None)
  | Measure closure ->
    coded closure (fun x after d ->
        match Value.to_number x with
        | Some seconds when seconds >= 0. && seconds < infinity ->
          let label = Label.Set_time seconds in
          Some (settle program world after m label [] (effects_of d) (step.continue (Gave seconds)))
        | Some _ | None ->
          let message = "during takes a time of 0 seconds or more, this code gives " ^ Value.to_string x in
          let fault = Fault.make closure.lambda.lambda_site message in
          Some (settle program world c m (Label.Broken message) [] [] (step.continue (Broke fault))))

let internal program world (c : Configuration.t) : t Seq.t =
  match c.control with
  | Ended _ -> Seq.empty
  | Script m -> fun () -> Seq.Cons (run_script program world c m, Seq.empty)
  | Waiting (m, Pick pick) -> fun () -> bindings world c m pick ()
  | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) -> Seq.empty
  | Executing (m, r) -> Seq.filter_map (internal_step program world c m) (Residual.steps r)

(* {1 Events} *)

let rec find_step p (steps : Residual.step Seq.t) =
  match steps () with
  | Seq.Nil -> None
  | Seq.Cons (step, rest) -> if p step.Residual.offer then Some step else find_step p rest

let vehicle_ended program world (c : Configuration.t) m r v label (reply : Residual.reply) =
  let ends = function Residual.End_of (_, v') -> v = v' | _ -> false in
  match find_step ends (Residual.steps r) with
  | None -> Error Not_awaited
  | Some step ->
    let name = match step.offer with End_of (p, _) -> p.name | _ -> "" in
    let reply : Residual.reply =
      match step.offer, reply with
      | End_of (p, _), Broke fault -> Broke { fault with site = p.task_site }
      | _, reply -> reply
    in
    let c = { c with allocation = Vehicle_map.remove v c.allocation } in
    Ok (settle program world c m (label name) [] [] (step.continue reply))

let timer_expired program world c m r timer =
  match find_step (fun offer -> offer = Residual.Expiry_of timer) (Residual.steps r) with
  | None -> Error Not_awaited
  | Some step -> Ok (settle program world c m Label.Time_out [] [] (step.continue Went))

let resume (c : Configuration.t) m x rule label =
  { rules = [ rule ]; label; next = { c with control = Script (Machine.give x m) }; effects = [] }

let failed (c : Configuration.t) m rule label message =
  let fault = Fault.make (Machine.site m) message in
  Ok (ending_transition { c with control = Script m } [ rule ] label (Failed fault) [])

let answered program world (c : Configuration.t) m text =
  match Elaborate.answer program text with
  | Error why -> Error (Bad_answer why)
  | Ok closure -> (
      match run_code program world c Task_code closure [] with
      | Value_of x, { deeds = []; store; _ } when Store.compare store c.store = 0 -> Ok (resume c m x Rule.Answer (Label.Answer text))
      | Value_of _, _ -> Error (Bad_answer "an answer may only compute a value")
      | Broke fault, _ -> Error (Bad_answer fault.message)
      | Halted_with _, _ -> Error (Bad_answer "an answer may only compute a value"))

let accept program world (c : Configuration.t) event =
  match event, c.control with
  | _, Ended _ -> Error Not_awaited
  | Interruption, (Script _ | Waiting _ | Executing _) ->
    Ok (ending_transition c [ Rule.Interrupt ] Label.Interrupt Interrupted [])
  | Vehicle_done v, Executing (m, r) ->
    vehicle_ended program world c m r v (fun name -> Label.Done (v, name)) Went
  | Vehicle_failed (v, why), Executing (m, r) ->
    let told name = Printf.sprintf "%s failed on %s: %s" name v why in
    let label name = Label.Fail (v, name, why) in
    let name = match Vehicle_map.find_opt v c.allocation with Some p -> p.name | None -> "" in
    vehicle_ended program world c m r v label (Broke (Fault.make Fault.unknown_site (told name)))
  | Timer_expired timer, Executing (m, r) -> timer_expired program world c m r timer
  | Timer_expired timer, Waiting (m, Pick pick) when timer = Effect.script_timer ->
    pick_timed_out world c m pick
  | Timer_expired timer, Waiting (m, Pause _) when timer = Effect.script_timer ->
    Ok (resume c m Null Rule.Resume Label.Resume)
  | Answered text, Waiting (m, Ask _) -> answered program world c m text
  | Nobody_answers why, Waiting (m, Ask prompt) ->
    failed c m Rule.Answer_err Label.No_answer (Printf.sprintf "no answer to '%s': %s" prompt why)
  | Replied x, Waiting (m, Host_call _) ->
    Ok (resume c m x Rule.Reply (Label.Reply (Value.to_string x)))
  | Host_failed why, Waiting (m, Host_call { subject; member; _ }) ->
    failed c m Rule.Call_err (Label.No_reply why) (Printf.sprintf "%s: %s" (describe_call subject member) why)
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _
      | Host_failed _ ),
      (Script _ | Waiting _ | Executing _) ) -> Error Not_awaited

let awaited (c : Configuration.t) =
  match c.control with
  | Script _ | Ended _ | Waiting (_, Execute _) -> []
  | Waiting (_, (Pick _ | Pause _)) -> [ Timer_expired Effect.script_timer ]
  | Waiting (_, Ask _) -> [ Answered "" ]
  | Waiting (_, Host_call _) -> [ Replied Null ]
  | Executing (_, r) ->
    let event (step : Residual.step) =
      match step.offer with
      | End_of (_, v) -> Some (Vehicle_done v)
      | Expiry_of timer -> Some (Timer_expired timer)
      | Start _ | Perform _ | Check _ | Measure _ -> None
    in
    List.of_seq (Seq.filter_map event (Residual.steps r))

let depends_on_sensors (program : program) (c : Configuration.t) =
  match c.control with
  | Executing (_, r) -> program.reads_sensors && Residual.waits_on_sensors r
  | Waiting (_, Pick _) -> true
  | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Script _ | Ended _ -> false
