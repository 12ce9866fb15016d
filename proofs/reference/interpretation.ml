open Dolphin_semantics
module I = Interpreter

(* {1 Code} *)

(* Atomic code that evaluates more expressions counts as endless. *)
let most_expressions = 2_000_000

let context program world ~held ~needed (s : Shared.t) mode : Code.context =
  { program; world; allocation = s.allocation; bound = s.bound; held; needed; store = s.store; tuples = s.tuples; mode;
    deeds = [] }

(* The code runs to its end: why it stopped, its deeds, and the state that it leaves. *)
let atomic ~undecided program world ~vehicles ~held ~needed (s : I.shared) mode (code : Core.closure) given =
  let chosen f = lazy (List.filter f vehicles) in
  let context =
    context program world ~held:(chosen held) ~needed:(chosen needed) (Terms.to_shared ~vehicles s) mode in
  match Machine.run ~fuel:most_expressions context (Machine.call code given) with
  | Decided (Exhausted, _, after) ->
    let why = "this code does not come to an end, and code inside of a task is atomic" in
    Some (Machine.Faulted (Fault.make code.lambda.lambda_site why), [], after)
  | Decided (stop, _, after) ->
    let after = { after with store = Reading.keep program after.store } in
    Some (stop, Terms.deeds (List.rev after.deeds), after)
  | Open cases -> undecided (List.map fst cases); None
  | Unclear _ -> None

let nobody _ = false

let run ~undecided program ~vehicles code given world held (s : I.shared) : I.result =
  match atomic ~undecided program world ~vehicles ~held ~needed:nobody s Task_code code given with
  | Some (Finished x, deeds, after) -> Gives (x, after.store, after.tuples, deeds)
  | Some (Faulted fault, deeds, _) when Fault.is_assertion fault -> Asserts (fault, deeds)
  | Some (Faulted fault, deeds, _) -> Faulty (fault, deeds)
  | Some (Halted why, deeds, after) -> Halts (Fault.make Fault.unknown_site why, after.store, after.tuples, deeds)
  | Some ((Exhausted | Did _ | Waits _ | Left_off), _, _) -> invalid_arg "Interpretation.run: atomic code stopped"
  | None -> Unclear

(* The task is the verdict of a handler that may recover. *)
let verdict (handler : Core.closure) x : Code.mode -> I.verdict =
  match x with
  | Core.Task t when Recovery.possible handler.lambda -> fun _ -> Instead (Terms.task t)
  | _ -> (
      function
      | Handler Retried -> Retries
      | Handler Ignored -> Ignores
      | Handler Propagated | Script | Task_code -> Propagates)

let arguments (fault : Fault.t) : Core.value list =
  match fault.cause with
  | Task { vehicle; task } -> [ String fault.message; Vehicles [ vehicle ]; String task ]
  | Code | Assertion | Unknown -> [ String fault.message; Null; Null ]

let run_handler ~undecided program ~vehicles handler fault world held needed (s : I.shared) : I.handled =
  let gone (after : Code.context) = List.filter (fun v -> not (List.mem v after.bound)) s.bound in
  match atomic ~undecided program world ~vehicles ~held ~needed s (Handler Propagated) handler (arguments fault) with
  | Some (Finished x, deeds, after) ->
    Rules (verdict handler x after.mode, after.store, gone after, after.tuples, deeds)
  | Some (Faulted fault, deeds, _) when Fault.is_assertion fault -> Asserts_ (fault, deeds)
  | Some (Faulted fault, deeds, _) -> Breaks (fault, deeds)
  | Some (Halted why, deeds, after) ->
    Halts_ (Fault.make Fault.unknown_site why, after.store, gone after, after.tuples, deeds)
  | Some ((Exhausted | Did _ | Waits _ | Left_off), _, _) -> invalid_arg "Interpretation.run_handler: a handler stopped"
  | None -> Unclear_

let truth x = if Unknown.is x then None else Some (Value.truth x)

let time_of (code : Core.closure) x : (float, Fault.t) Either.t =
  let site = code.lambda.lambda_site and label = code.lambda.label in
  match Value.to_number x with
  | Some n when Time.is_one n -> Left n
  | Some n when n >= 0. -> Right (Fault.make site (Time.none label n))
  | Some _ | None ->
    let why = Printf.sprintf "%s takes a time of 0 seconds or more, this code gives %s" label (Value.to_string x) in
    Right (Fault.make site why)

(* {1 Tasks that code makes} *)

(* So deep they nest. *)
let deepest = 100

let task_of : Core.value -> I.task option = function
  | Task t -> Some (Terms.task t)
  | Closure c -> Some (TMade c)
  | _ -> None

let takes (code : Core.closure) given = code.lambda.implicit || code.lambda.parameters <= List.length given

let only_computes (code : Core.closure) =
  let { Core.label; lambda_site; _ } = code.lambda in
  Fault.make lambda_site
    (Printf.sprintf "{ %s } makes a task, so it may only compute: it must not post, consume, assign or print" label)

(* The reason is the first that holds. *)
let no_task (code : Core.closure) given depth before x after deeds =
  let { Core.parameters; label; lambda_site; _ } = code.lambda in
  let many n = Printf.sprintf "%d value%s" n (if n = 1 then "" else "s") in
  let fault format = Printf.ksprintf (Fault.make lambda_site) format in
  if not (takes code given) then
    let n = List.length given in
    fault "{ %s } takes %s, and its guard took %s" label (many parameters) (if n = 0 then "none" else many n)
  else if depth >= deepest then
    fault "closures in tasks that closures give nest more than %d deep: write an endless loop as repeat" deepest
  else if deeds <> [] || Store.compare before after <> 0 then only_computes code
  else fault "{ %s }: %s" label (Operators.instead_of "a task" x)

exception Undecided

(* Of the code of a fresh: also where it does not end with a value. *)
let no_opened_task (code : Core.closure) given depth before : I.result -> Fault.t = function
  | Gives (x, after, _, deeds) -> no_task code given depth before x after deeds
  | Faulty (fault, _) | Asserts (fault, _) -> Fault.make fault.site fault.message
  | Halts _ -> only_computes code
  | Unclear -> raise Undecided

let assign_to (i, _, x) store = Store.set i x store
let forget keys n = List.fold_left (fun n i -> Tuples.without (Residual.key i) n) n keys

(* {1 Vehicles} *)

let fit program (pick : Settings.pick) world bound =
  match Fit.vehicles world { (Shared.initial program) with bound } pick.filter with Ok vs -> vs | Error _ -> []

(* The vehicles of platform tasks, from left to right. *)
let rec assigned (r : Residual.t) : Core.vehicle list =
  match r with
  | Ready (_, v) -> [ v ]
  | Repeat { again; _ } -> assigned again.each
  | r -> List.concat_map assigned (Residual.parts r)

let rec from n () = Seq.Cons (n, from (n + 1))

let assign ~undecided world bound allowed t : (int -> Core.vehicle, Fault.t) Either.t =
  let opened = { Allocation.tasks = Terms.opened t; numbers = from 1 } in
  match Allocation.allocate_made world bound opened { allowed; place = 0; depth = 0 } (Terms.to_task t) with
  | Ok (Ok (_, r)) -> Left (Array.get (Array.of_list (assigned r)))
  | Ok (Error fault) -> Right fault
  | Error question -> undecided question; raise Undecided

(* {1 Messages} *)

let not_assured site (guard : Core.closure) =
  Fault.make site (Printf.sprintf "assure: { %s } does not hold" guard.lambda.label)

let not_in_time site n = Fault.make site (Printf.sprintf "not done within %s s" (Value.amount n))
let answered_no site prompt = Fault.make site (Printf.sprintf "'%s' was answered no" prompt)

let not_answered site prompt (why : Fault.t) =
  Fault.make site (Printf.sprintf "no answer to '%s': %s" prompt why.message)

let plan_failed (p : Core.platform_task) vehicle (why : Fault.t) =
  let message = Printf.sprintf "%s failed on %s: %s" p.name vehicle why.message in
  Fault.of_task p.task_site ~vehicle ~task:p.name message

let too_deep (handler : Core.closure) =
  let message = Printf.sprintf "tasks in the place of tasks that failed nest more than %d deep" deepest in
  Fault.make handler.lambda.lambda_site message

let foreign_retry (handler : Core.closure) =
  Fault.make handler.lambda.lambda_site "retry() was called for another handler than that in whose text it stands"

(* {1 The script} *)

let fuel = 10_000

let asks : Code.request -> I.request_of_script = function
  | Pick pick -> Pick (Terms.of_pick pick)
  | Ask prompt -> Ask prompt
  | Pause n -> Pause n
  | Execute t -> Execute (Terms.task t)
  | Host_call _ as call -> Call call

let stop : Machine.stop -> I.stop = function
  | Exhausted -> Exhausted
  | Finished _ -> Finished
  | Left_off -> Left_off
  | Did deed -> ( match Terms.deeds [ deed ] with [ deed ] -> Did deed | _ -> invalid_arg "one deed")
  | Waits q -> Asks (asks q)
  | Halted why -> Halts_script (Fault.make Fault.unknown_site why)
  | Faulted fault -> Faults fault

let run_script ~undecided program m world (s : I.shared) =
  let nobody = lazy [] in
  let context = context program world ~held:nobody ~needed:nobody (Terms.to_shared ~vehicles:[] s) Script in
  match Machine.run ~fuel context m with
  | Decided (why, m, context) -> ((stop why, Machine.keep_readings m), Reading.keep program context.store)
  | Open cases -> undecided (List.map fst cases); raise Undecided
  | Unclear _ -> raise Undecided

let post pairs n = List.fold_left (fun n (k, x) -> Tuples.post k (Value.canonical x) n) n pairs

let take pairs n =
  List.fold_left (fun n (k, x) -> Option.bind n (fun n -> Tuples.consume k (Value.canonical x) n)) (Some n) pairs

let answer_of ~undecided program answer text world (s : I.shared) =
  let value code =
    match atomic ~undecided program world ~vehicles:[] ~held:nobody ~needed:nobody s Task_code code [] with
    | Some (Finished x, [], after) when Store.compare after.store s.variables = 0 -> Some x
    | Some _ | None -> None
  in
  Option.bind (answer text) value

(* The text of PICK-ERR and PICK-ELSE, of which there is one only. *)
let no_pick program machine (pick : I.pick) world s =
  match machine with
  | None -> Fault.make Fault.unknown_site "no script picks"
  | Some m -> (
      let c : Configuration.t = { control = Waiting (m, Pick pick.asked); shared = Terms.to_shared ~vehicles:[] s } in
      match Transition.accept program world c (Timer_expired Residual.script_timer) with
      | Ok { label = No_vehicles message; _ } -> Fault.make (Machine.site m) message
      | Ok _ | Error _ -> invalid_arg "Interpretation.no_pick: the pick can be met")

let code ?(undecided = ignore) (program : Core.program) ~vehicles ~machine ~answer : I.code0 =
  let site = Option.fold ~none:Fault.unknown_site ~some:Machine.site machine in
  let no_text prompt (why : Fault.t) = Fault.make site (Printf.sprintf "no answer to '%s': %s" prompt why.message) in
  let no_reply call (why : Fault.t) =
    match (call : Code.request) with
    | Host_call { subject; member; arguments = _ } ->
      Fault.make site (Printf.sprintf "%s: %s" (Machine.name_of_call ~subject ~member) why.message)
    | Pick _ | Ask _ | Pause _ | Execute _ -> why
  in
  let forget_all tuples = (Shared.without_fresh { (Shared.initial program) with tuples }).tuples in
  let interrupted lambda vs = Machine.call { lambda; captured = [||] } [ Core.Vehicles vs ] in
  { may_ensure = (fun _ -> true); run = run ~undecided program ~vehicles;
    run_handler = run_handler ~undecided program ~vehicles; truth; is_unknown = Fault.is_unknown; time_of; task_of;
    takes; parameters = (fun c -> c.lambda.parameters); may_recover = (fun c -> Recovery.possible c.lambda);
    vehicle_value = (fun v -> Vehicles [ v ]); key_value = (fun i -> String (Residual.key i)); forget; forget_all;
    assign_to; fit = fit program; assign = assign ~undecided; not_assured; not_in_time; answered_no; not_answered;
    plan_failed; no_task; no_opened_task; too_deep; foreign_retry; run_script = run_script ~undecided program;
    give = Machine.give;
    null = Null; vehicles_value = (fun vs -> Vehicles vs); post; take;
    answer_of = answer_of ~undecided program answer; no_pick = no_pick program machine; no_text; no_reply;
    declares = (fun k -> List.mem k program.inputs); on_interrupt = Option.map interrupted program.on_interrupt;
    leaving = Machine.is_leaving }
