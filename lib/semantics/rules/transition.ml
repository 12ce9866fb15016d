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

type t = {
  rules : Rule.t list;
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;
  assumed : World.assumption list;
}

type refusal = Not_awaited | Bad_answer of string

(* The script runs so many expressions in one silent transition, then lets others see it; atomic code may take so
   many before it counts as endless. *)
let script_fuel = 10_000
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
  { rules; label; next; effects = before @ effects; assumed = [] }

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

(* A step is over: what sensors show is from now on what they have shown. *)
let keep program world (c : Configuration.t) =
  if World.is_open world then { c with store = Reading.keep program c.store } else c

let keep_in_machine world m = if World.is_open world then Machine.keep_readings m else m

let deeds (context : Machine.context) = List.rev context.deeds
let effects_of deeds = List.filter_map effect_of_deed deeds

let rule_of_deed : Machine.deed -> Rule.t = function
  | Posted _ -> Post
  | Consumed _ -> Consume
  | Said _ -> Message
  | Released _ -> Release
  | Set_connection_timeout _ -> Set_timeout

(* {1 The script} *)

let waiting c m (request : Machine.request) rule label effects =
  { rules = [ rule ]; label; next = { c with Configuration.control = Waiting (m, request) }; effects; assumed = [] }

let timers_started = List.map (fun (timer, seconds) -> Effect.Set_timer (timer, seconds))

let start_execution world (c : Configuration.t) m t =
  match Allocation.allocate world c.bound t with
  | Error fault ->
    let fault = if fault.site = Fault.unknown_site then { fault with site = Machine.site m } else fault in
    ending_transition c [ Rule.Alloc_err ] (Label.Cannot_execute fault.message) (Failed fault) []
  | Ok r ->
    let r, timers = Residual.activate r in
    let next = { c with control = Executing (m, r) } in
    { rules = [ Rule.Execute ]; label = Label.Execute; next; effects = timers_started timers; assumed = [] }

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
    waiting c m request Rule.Call (Label.Call (Machine.name_of_call ~subject ~member)) [ effect ]

let run_script program world (c : Configuration.t) m =
  let stop, m, context = Machine.run ~fuel:script_fuel (context program world c Script) m in
  let m = keep_in_machine world m in
  let c = keep program world (after context c) in
  let going rules label effects = { rules; label; next = { c with control = Script m }; effects; assumed = [] } in
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
  let is_near (s : World.vehicle_state) area = Dolphin_geo.Area.contains area (World.place world s) in
  let fits (s : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } s
    && (not (List.mem s.id c.bound))
    && Option.fold ~none:true ~some:(is_near s) pick.filter.region
  in
  List.map (fun (s : World.vehicle_state) -> s.id) (List.filter fits (World.vehicles world))

(* All lists of [n] elements of [xs] in their order, the first ones first. *)
let choices n xs : 'a list Seq.t =
  let rec from n xs length () =
    match xs with
    | _ when n = 0 -> Seq.return [] ()
    | x :: rest when n <= length ->
      let chosen = Seq.map (fun chosen -> x :: chosen) (from (n - 1) rest (length - 1)) in
      Seq.append chosen (from n rest (length - 1)) ()
    | _ -> Seq.Nil
  in
  from n xs (List.length xs)

let bind (c : Configuration.t) m effects vs =
  let next = { c with control = Script (Machine.give (Vehicles vs) m); bound = c.bound @ vs } in
  { rules = [ Rule.Pick_bind ]; label = Label.Bind vs; next; effects = effects @ [ Effect.Bind vs ]; assumed = [] }

(* The ways to meet a [pick] now. One that takes all there are waits for its whole time-out. *)
let bindings world (c : Configuration.t) m (pick : Settings.pick) =
  match pick.count with
  | All -> Seq.empty
  | Exactly n ->
    Seq.map (bind c m [ Effect.Cancel_timer Effect.script_timer ]) (choices n (candidates world c pick))

let why_not world (c : Configuration.t) (pick : Settings.pick) (s : World.vehicle_state) =
  let f = pick.filter in
  let place = lazy (World.place world s) in
  let is_missed area = not (Dolphin_geo.Area.contains area (Lazy.force place)) in
  let region_missed = lazy (Option.fold ~none:false ~some:is_missed f.region) in
  let reason =
    if List.mem s.id c.bound then "is already bound"
    else if not s.connected then "is not connected"
    else if Option.fold ~none:false ~some:(fun id -> id <> s.id) f.id then "has another id"
    else if Option.fold ~none:false ~some:(fun kind -> kind <> s.kind) f.kind then "is a " ^ s.kind
    else if not (World.carries f.payload s) then
      "lacks " ^ String.concat ", " (List.filter (fun d -> not (World.carries [ d ] s)) f.payload)
    else if Lazy.force region_missed then
      Format.asprintf "is at %a, outside of the region" Dolphin_geo.Position.pp (Lazy.force place)
    else "fits"
  in
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

(* The vehicles that stop, and the effects in their order. *)
let undo (change : Residual.change) =
  let of_undoing : Residual.undoing -> vehicle list * Effect.t list = function
    | Cancel timer -> ([], [ Cancel_timer timer ])
    | Cut cut ->
      let cancelled = List.map (fun timer -> Effect.Cancel_timer timer) (List.concat_map Residual.timers cut) in
      let stopped = List.concat_map Residual.running cut in
      (stopped, cancelled @ List.map (fun v -> Effect.Stop v) stopped)
  in
  let stopped, effects = List.split (List.map of_undoing change.undone) in
  (List.concat stopped, List.concat effects)

type outcome = Goes_on of Residual.t | Over | Ends of Configuration.ending

type local = {
  after : Configuration.t;
  outcome : outcome;
  derivation : Rule.t list;
  named : Label.t;
  asked : Effect.t list;
}

(* [settle c change] carries a change of the residual over to the rest of the configuration, handlers of errors
   included. [asked] are the effects of the step itself. *)
let rec settle program world (c : Configuration.t) named derivation asked (change : Residual.change) =
  let stopped, undone = undo change in
  let derivation = derivation @ change.rules in
  let allocation = List.fold_left (fun a v -> Vehicle_map.remove v a) c.allocation stopped in
  let settled = { c with allocation } in
  let asked = asked @ undone @ timers_started change.timers in
  match change.outcome with
  | Next r -> { after = settled; outcome = Goes_on r; derivation; named; asked }
  | Finished -> { after = settled; outcome = Over; derivation; named; asked }
  | Failed fault -> { after = settled; outcome = Ends (Failed fault); derivation; named; asked }
  | Handling { handler; fault; ignored; propagated } -> (
      let mode = Machine.Handler Propagated in
      let result, context = run_code program world settled mode handler [ String fault.message ] in
      let settled = after context settled in
      let asked = asked @ effects_of (deeds context) in
      match result, context.mode with
      | Halted_with message, _ ->
        let derivation = derivation @ [ Rule.Watch_halt ] in
        { after = settled; outcome = Ends (Halted message); derivation; named; asked }
      | Broke fault, _ when Fault.is_assertion fault ->
        let derivation = derivation @ [ Rule.Assert_err ] in
        { after = settled; outcome = Ends (Failed fault); derivation; named; asked }
      | Broke fault, _ -> settle program world settled named derivation asked (propagated fault)
      | Value_of _, Handler Ignored -> settle program world settled named derivation asked (ignored ())
      | Value_of _, (Handler Propagated | Script | Task_code) ->
        settle program world settled named derivation asked (propagated fault))

let equal_outcome a b =
  match a, b with
  | Goes_on r, Goes_on r' -> Residual.equal r r'
  | Over, Over -> true
  | Ends e, Ends e' -> Configuration.compare_ending e e' = 0
  | (Goes_on _ | Over | Ends _), _ -> false

let equal_local a b =
  Label.equal a.named b.named && equal_outcome a.outcome b.outcome && Configuration.equal a.after b.after

let conclude (c : Configuration.t) m { after; outcome; derivation; named; asked } =
  match outcome with
  | Goes_on r ->
    let next = { after with control = Executing (m, r) } in
    { rules = derivation; label = named; next; effects = asked; assumed = [] }
  | Over ->
    let next = { after with control = Script (Machine.give Null m) } in
    { rules = derivation @ [ Rule.Execute_done ]; label = named; next; effects = asked; assumed = [] }
  | Ends (Failed fault as ending) when not (Fault.is_assertion fault) ->
    (* The failure has cut off all that ran. *)
    ending_transition { after with control = Script m } (derivation @ [ Rule.Execute_err ]) named ending asked
  | Ends ((Completed | Halted _ | Failed _ | Interrupted) as ending) ->
    ending_transition { after with control = c.control } derivation named ending asked

let check_label (change : Residual.change) deeds =
  match change.rules with Rule.Until_cut :: _ -> Label.Cut deeds | _ -> Label.Check deeds

let kept program world = Option.map (fun local -> { local with after = keep program world local.after })

(* What one local step does that needs no event, if it is enabled. *)
let local_internal program world (c : Configuration.t) (step : Residual.step) =
  kept program world @@
  let coded closure continue =
    let result, context = run_code program world c Task_code closure [] in
    let d = deeds context in
    match result with
    | Broke fault when Fault.is_assertion fault ->
      let outcome = Ends (Failed fault) and named = Label.Broken fault.message in
      Some { after = c; outcome; derivation = [ Rule.Assert_err ]; named; asked = [] }
    | Broke fault ->
      Some (settle program world c (Label.Broken fault.message) [] [] (step.continue (Broke fault)))
    | Halted_with message ->
      let outcome = Ends (Halted message) in
      let derivation = [ Rule.Halt ] and named = Label.Halt message in
      Some { after = after context c; outcome; derivation; named; asked = effects_of d }
    | Value_of x -> continue x (after context c) d
  in
  match step.offer with
  | End_of _ | Expiry_of _ -> None
  | Start (p, v) ->
    let c = { c with allocation = Vehicle_map.add v p c.allocation } in
    Some (settle program world c (Label.Start (v, p.name)) [] [ Start (v, p) ] (step.continue Went))
  | Perform closure ->
    coded closure (fun _ c d -> Some (settle program world c (Label.Act d) [] (effects_of d) (step.continue Went)))
  | Check closure ->
    coded closure (fun x c d ->
        if Value.truth (Reading.settled closure.lambda.lambda_site x) then
          let change = step.continue Went in
          Some (settle program world c (check_label change d) [] (effects_of d) change)
        else None)
  | Measure closure ->
    coded closure (fun x after d ->
        match Value.to_number (Reading.settled closure.lambda.lambda_site x) with
        | Some seconds when seconds >= 0. && seconds < infinity ->
          let label = Label.Set_time seconds in
          Some (settle program world after label [] (effects_of d) (step.continue (Gave seconds)))
        | Some _ | None ->
          let message = "during takes a time of 0 seconds or more, this code gives " ^ Value.to_string x in
          let fault = Fault.make closure.lambda.lambda_site message in
          Some (settle program world c (Label.Broken message) [] [] (step.continue (Broke fault))))

(* What one local step does on the event that it awaits. *)
let local_event program world (c : Configuration.t) (step : Residual.step) event =
  kept program world @@
  let ended v named reply =
    let c = { c with allocation = Vehicle_map.remove v c.allocation } in
    Some (settle program world c named [] [] (step.continue reply))
  in
  match event, step.offer with
  | Vehicle_done v, End_of (p, v') when v = v' -> ended v (Label.Done (v, p.name)) Went
  | Vehicle_failed (v, why), End_of (p, v') when v = v' ->
    let fault = Fault.make p.task_site (Printf.sprintf "%s failed on %s: %s" p.name v why) in
    ended v (Label.Fail (v, p.name, why)) (Broke fault)
  | Timer_expired timer, Expiry_of timer' when timer = timer' ->
    Some (settle program world c Label.Time_out [] [] (step.continue Went))
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _
      | Host_failed _ | Interruption ),
      (Start _ | Perform _ | Check _ | Measure _ | End_of _ | Expiry_of _) ) -> None

(* {1 Of all that is left open} *)

let equal (t : t) (t' : t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next
let with_assumed (assumed, (t : t)) = { t with assumed }

(* What [f] gives, one transition at most, in each world that [world] leaves open. *)
let in_all world f = List.map with_assumed (World.outcomes ~equal world f)

let bindings_in_all world c m pick : t Seq.t =
  if not (World.is_open world) then bindings world c m pick
  else fun () ->
    let add found (assumed, ts) =
      let fresh = List.filter (fun t -> not (List.exists (equal t) found)) ts in
      found @ List.map (fun t -> with_assumed (assumed, t)) fresh
    in
    let cases = World.cases world (fun world -> List.of_seq (bindings world c m pick)) in
    List.to_seq (List.fold_left add [] cases) ()

let internal program world (c : Configuration.t) : t Seq.t =
  match c.control with
  | Ended _ -> Seq.empty
  | Script m -> fun () -> List.to_seq (in_all world (fun world -> Some (run_script program world c m))) ()
  | Waiting (m, Pick pick) -> fun () -> bindings_in_all world c m pick ()
  | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) -> Seq.empty
  | Executing (m, r) ->
    let in_one s world = Option.map (conclude c m) (local_internal program world c s) in
    Seq.flat_map (fun s -> List.to_seq (in_all world (in_one s))) (Residual.internal_steps r)

(* {1 Events} *)

(* Vehicles and timers are in one place of a residual only: at most one step takes the event. *)
let executing_event program world c m r event =
  let rec first (steps : Residual.step Seq.t) =
    match steps () with
    | Seq.Nil -> [ Error Not_awaited ]
    | Seq.Cons (step, rest) -> (
        match in_all world (fun world -> Option.map (conclude c m) (local_event program world c step event)) with
        | [] -> first rest
        | ts -> List.map Result.ok ts)
  in
  match event with
  | Vehicle_done v | Vehicle_failed (v, _) -> first (Residual.steps_of_vehicle v r)
  | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Interruption ->
    first (Residual.steps r)

let resume (c : Configuration.t) m rule label =
  let next = { c with control = Script m } in
  { rules = [ rule ]; label; next; effects = []; assumed = [] }

let failed (c : Configuration.t) m rule label message =
  let fault = Fault.make (Machine.site m) message in
  Ok (ending_transition { c with control = Script m } [ rule ] label (Failed fault) [])

let answered program world (c : Configuration.t) m text =
  match Elaborate.answer program text with
  | Error why -> Error (Bad_answer why)
  | Ok closure -> (
      match run_code program world c Task_code closure [] with
      | Value_of x, { deeds = []; store; _ } when Store.compare store c.store = 0 ->
        Ok (resume c (keep_in_machine world (Machine.give x m)) Rule.Answer (Label.Answer text))
      | Value_of _, _ -> Error (Bad_answer "an answer may only compute a value")
      | Broke fault, _ -> Error (Bad_answer fault.message)
      | Halted_with _, _ -> Error (Bad_answer "an answer may only compute a value"))

(* Of a configuration that executes nothing, in a world of which enough is known. *)
let whole_event program world (c : Configuration.t) event =
  match event, c.control with
  | _, Ended _ -> Error Not_awaited
  | Interruption, (Script _ | Waiting _ | Executing _) ->
    Ok (ending_transition c [ Rule.Interrupt ] Label.Interrupt Interrupted [])
  | Timer_expired timer, Waiting (m, Pick pick) when timer = Effect.script_timer ->
    pick_timed_out world c m pick
  | Timer_expired timer, Waiting (m, Pause _) when timer = Effect.script_timer ->
    Ok (resume c (Machine.give Null m) Rule.Resume Label.Resume)
  | Answered text, Waiting (m, Ask _) -> answered program world c m text
  | Nobody_answers why, Waiting (m, Ask prompt) ->
    failed c m Rule.Answer_err Label.No_answer (Printf.sprintf "no answer to '%s': %s" prompt why)
  | Replied x, Waiting (m, Host_call _) ->
    Ok (resume c (Machine.give x m) Rule.Reply (Label.Reply (Value.to_string x)))
  | Host_failed why, Waiting (m, Host_call { subject; member; _ }) ->
    let call = Machine.name_of_call ~subject ~member in
    failed c m Rule.Call_err (Label.No_reply why) (Printf.sprintf "%s: %s" call why)
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Answered _ | Nobody_answers _ | Replied _
      | Host_failed _ ),
      (Script _ | Waiting _ | Executing _) ) -> Error Not_awaited

let accept_all program world (c : Configuration.t) event =
  match event, c.control with
  | (Vehicle_done _ | Vehicle_failed _ | Timer_expired _), Executing (m, r) ->
    executing_event program world c m r event
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
  | Waiting (_, Pick _) -> true
  | Executing _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Script _ -> program.reads_sensors
  | Ended _ -> false
