open Dolphin_semantics
module I = Interpreter
module R = Residual

let names : I.names =
  { vehicle_eq = String.equal; store_eq = (fun s s' -> Store.compare s s' = 0) }

(* {1 Tasks} *)

(* A recruit is a pick without a count and a timeout. *)
let of_filter filter : Settings.pick = { filter; count = Exactly 1; timeout = None; otherwise = false }

let on_cut : Core.on_cut -> I.on_cut = function Completes _ -> Completes | Fails site -> Fails site
let to_on_cut : I.on_cut -> Core.on_cut = function Completes -> Completes Fault.unknown_site | Fails site -> Fails site

let duration : Core.duration -> I.duration = function Seconds n -> Seconds n | Given_by d -> Given_by d
let to_duration : I.duration -> Core.duration = function Seconds n -> Seconds n | Given_by d -> Given_by d

let end_deed : Core.ensured -> I.end_deed = function
  | Pair (k, x) -> Posts (k, x)
  | Variable (i, name, x) -> Assigns (i, name, x)
  | Taken -> Gives_back

let to_end_deed : I.end_deed -> Core.ensured = function
  | Posts (k, x) -> Pair (k, x)
  | Assigns (i, name, x) -> Variable (i, name, x)
  | Gives_back -> Taken

let rec task : Core.task -> I.task = function
  | Platform p -> TPlan p
  | Action a -> TAction a
  | Condition g -> TCondition g
  | Sequence (t, t') -> TSequence (task t, task t')
  | Parallel (t, t') -> TParallel (task t, task t')
  | Allocated (t, vs) -> TAllocated (task t, vs)
  | All_of bs -> TAll_of (List.map branch bs)
  | One_of bs -> TOne_of (List.map branch bs)
  | Until (k, g, t) -> TUntil (on_cut k, g, task t)
  | Idle { seconds; site = _ } -> TIdle seconds
  | Confirm { prompt; site } -> TConfirm (prompt, site)
  | During (k, d, t) -> TDuring (on_cut k, duration d, task t)
  | Watch (t, h) -> TWatch (task t, h)
  | Repeat { rounds; until; body; site = _ } -> TRepeat (rounds, until, task body)
  | Made a -> TMade a
  | Recruit { asked; code; site = _ } -> TRecruit (of_filter asked, code)
  | Fresh code -> TFresh code
  | Ensure (ds, t) -> TEnsure (task t, List.map end_deed ds)

and branch { guard; body } = (guard, task body)

let rec to_task : I.task -> Core.task = function
  | TPlan p -> Platform p
  | TAction a -> Action a
  | TCondition g -> Condition g
  | TSequence (t, t') -> Sequence (to_task t, to_task t')
  | TParallel (t, t') -> Parallel (to_task t, to_task t')
  | TAllocated (t, vs) -> Allocated (to_task t, vs)
  | TAll_of bs -> All_of (List.map to_branch bs)
  | TOne_of bs -> One_of (List.map to_branch bs)
  | TUntil (k, g, t) -> Until (to_on_cut k, g, to_task t)
  | TIdle seconds -> Idle { seconds; site = Fault.unknown_site }
  | TConfirm (prompt, site) -> Confirm { prompt; site }
  | TDuring (k, d, t) -> During (to_on_cut k, to_duration d, to_task t)
  | TWatch (t, h) -> Watch (to_task t, h)
  | TRepeat (rounds, until, t) -> Repeat { rounds; until; body = to_task t; site = Fault.unknown_site }
  | TMade a -> Made a
  | TRecruit (asked, code) -> Recruit { asked = asked.filter; code; site = Fault.unknown_site }
  | TFresh code | TKeys (_, code, _) -> Fresh code
  | TEnsure (t, ds) -> Ensure (List.map to_end_deed ds, to_task t)

and to_branch (guard, t) = { guard; body = to_task t }

let rec opened : I.task -> (R.timer list * Core.task) list = function
  | TKeys (ns, _, t) -> (ns, to_task t) :: opened t
  | TSequence (t, t') | TParallel (t, t') -> opened t @ opened t'
  | TAllocated (t, _) | TUntil (_, _, t) | TDuring (_, _, t) | TWatch (t, _) | TRepeat (_, _, t) | TEnsure (t, _) ->
    opened t
  | TAll_of bs | TOne_of bs -> List.concat_map (fun (_, t) -> opened t) bs
  | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ | TMade _ | TRecruit _ | TFresh _ -> []

(* {1 Residuals} *)

let request ({ allowed; place; depth } : R.request) : I.request = { allowed; place; depth }
let to_request ({ allowed; place; depth } : I.request) : R.request = { allowed; place; depth }

let rec residual : R.t -> I.residual = function
  | Ready (p, v) -> Ready (p, v)
  | Running (p, v) -> Running (p, v)
  | Action a -> Action a
  | Condition g -> Condition g
  | Sequence (r, ts) -> Sequence (residual r, sequence ts)
  | Parallel rs -> Parallel (List.map residual (Branches.to_list rs))
  | All_of (Some r, bs) -> Branch (residual r, List.map residual_branch bs)
  | All_of (None, bs) -> All_of (List.map residual_branch bs)
  | One_of bs -> One_of (List.map residual_branch bs)
  | Until (k, g, r) -> Until (on_cut k, g, residual r)
  | Idle { timer; seconds; site = _ } -> Idle (timer, seconds)
  | Confirm { question; prompt; site } -> Confirm (question, prompt, site)
  | During { on_cut = k; timer; duration = Seconds n; body; started = _ } -> During (on_cut k, timer, n, residual body)
  | During { on_cut = k; timer; duration = Given_by d; body; started = _ } ->
    During_code (on_cut k, timer, d, residual body)
  | Watch (r, { code; anew }) ->
    Watch (residual r, { handles = code; anew = Option.map (fun (t, q) -> (task t, request q)) anew })
  | Repeat { round = Some r; again = { left; until; each; site = _ } } ->
    Repeat (residual r, left, until, residual each)
  | Repeat { round = None; again = { left; until = Some g; each; site = _ } } -> Asked (left, g, residual each)
  | Repeat { round = None; again = { until = None; _ } } -> invalid_arg "a repeat that is to ask has no condition"
  | Made { code; given; request = q } -> Made (code, given, request q)
  | Unallocated { task = t; request = q } -> Unallocated (task t, request q)
  | Hold (vs, r) -> Holding (vs, residual r)
  | Recruit { number; asked; code; place; depth; site = _ } -> Recruit (number, of_filter asked, code, place, depth)
  | Recruited (v, r) -> Recruited (v, residual r)
  | Fresh (ns, r) -> Fresh (ns, residual r)
  | Ensure (ds, r) -> Ensure (residual r, List.map end_deed ds)

and residual_branch { guard; body } = (guard, residual body)

and sequence = function
  | [] -> invalid_arg "a sequence without a part to come"
  | [ t ] -> residual t
  | t :: ts -> Sequence (residual t, sequence ts)

(* In what has begun, timers run: the calculus has no mark for it. *)
let rec to_residual ~begun : I.residual -> R.t =
  let here r = to_residual ~begun r and later r = to_residual ~begun:false r in
  let branch (guard, r) : R.branch = { guard; body = later r } in
  function
  | Ready (p, v) -> Ready (p, v)
  | Running (p, v) -> Running (p, v)
  | Action a -> Action a
  | Condition g -> Condition g
  | Sequence (r, t) -> Sequence (here r, parts later t)
  | Parallel rs -> Parallel (Branches.of_list (List.map here rs))
  | Branch (r, bs) -> All_of (Some (here r), List.map branch bs)
  | All_of bs -> All_of (None, List.map branch bs)
  | One_of bs -> One_of (List.map branch bs)
  | Until (k, g, r) -> Until (to_on_cut k, g, here r)
  | Idle (timer, seconds) -> Idle { timer; seconds; site = Fault.unknown_site }
  | Confirm (question, prompt, site) -> Confirm { question; prompt; site }
  | During (k, timer, n, r) ->
    During { on_cut = to_on_cut k; timer; duration = Seconds n; started = begun; body = here r }
  | During_code (k, timer, d, r) ->
    During { on_cut = to_on_cut k; timer; duration = Given_by d; started = false; body = later r }
  | Watch (r, { handles = code; anew }) ->
    Watch (here r, { code; anew = Option.map (fun (t, q) -> (to_task t, to_request q)) anew })
  | Repeat (r, left, until, each) ->
    Repeat { round = Some (here r); again = { left; until; each = later each; site = Fault.unknown_site } }
  | Asked (left, g, each) ->
    Repeat { round = None; again = { left; until = Some g; each = later each; site = Fault.unknown_site } }
  | Made (code, given, q) -> Made { code; given; request = to_request q }
  | Unallocated (t, q) -> Unallocated { task = to_task t; request = to_request q }
  | Holding (vs, r) -> Hold (vs, here r)
  | Recruit (number, asked, code, place, depth) ->
    Recruit { number; asked = asked.filter; code; place; depth; site = Fault.unknown_site }
  | Recruited (v, r) -> Recruited (v, here r)
  | Fresh (ns, r) -> Fresh (ns, here r)
  | Ensure (r, ds) -> Ensure (List.map to_end_deed ds, here r)

and parts later : I.residual -> R.t list = function
  | Sequence (r, t) -> later r :: parts later t
  | r -> [ later r ]

(* {1 Shared parts} *)

let shared (s : Shared.t) : I.shared =
  { variables = s.store; allocation = (fun v -> Vehicle_map.find_opt v s.allocation); bound = s.bound;
    space = s.tuples }

let to_shared ~vehicles (s : I.shared) : Shared.t =
  let add a v = match s.allocation v with Some p -> Vehicle_map.add v p a | None -> a in
  { store = s.variables; allocation = List.fold_left add Vehicle_map.empty vehicles; bound = s.bound;
    tuples = s.space }

(* {1 Deeds and picks} *)

let deed : Code.deed -> I.deed = function
  | Posted ks -> Posted ks
  | Consumed ks -> Consumed ks
  | Said text -> Said (String text)
  | Released vs -> Released vs
  | Set_connection_timeout (vs, n) -> Timeout_set (vs, n)

let text : Core.value -> string = function String text -> text | x -> Value.to_string x

let to_deed : I.deed -> Code.deed = function
  | Posted ks -> Posted ks
  | Consumed ks -> Consumed ks
  | Said x -> Said (text x)
  | Released vs -> Released vs
  | Timeout_set (vs, n) -> Set_connection_timeout (vs, n)

let deeds = List.map deed
let to_deeds = List.map to_deed

let of_pick (pick : Settings.pick) : I.pick =
  let count = match pick.count with Exactly n -> Some n | All -> None in
  { asked = pick; count; otherwise = pick.otherwise }

(* {1 Configurations} *)

let waiting : Code.request -> I.waiting = function
  | Pick pick -> For_pick (of_pick pick)
  | Ask prompt -> For_answer prompt
  | Pause n -> For_pause n
  | Host_call _ as call -> For_reply call
  | Execute _ -> invalid_arg "a script that waits to execute a task"

let to_waiting : I.waiting -> Code.request = function
  | For_pick pick -> Pick pick.asked
  | For_answer prompt -> Ask prompt
  | For_pause n -> Pause n
  | For_reply call -> call

let ending : Configuration.ending -> I.ending = function
  | Completed -> Completed
  | Halted text -> Halted (Fault.make Fault.unknown_site text)
  | Failed fault -> Failed fault
  | Interrupted -> Interrupted

let to_ending : I.ending -> Configuration.ending = function
  | Completed -> Completed
  | Halted m -> Halted m.message
  | Failed m -> Failed m
  | Interrupted -> Interrupted

let control : Configuration.control -> I.control = function
  | Script m -> Script m
  | Waiting (m, q) -> Wait (m, waiting q)
  | Executing (m, r) -> Exec (m, residual r)
  | Ended e -> End (ending e)

let to_control : I.control -> Configuration.control = function
  | Script m -> Script m
  | Wait (m, q) -> Waiting (m, to_waiting q)
  | Exec (m, r) -> Executing (m, to_residual ~begun:true r)
  | End e -> Ended (to_ending e)

let configuration (c : Configuration.t) : I.configuration =
  { control_of = control c.control; shared_of = shared c.shared }

let event : Transition.event -> I.event =
  let because why = Fault.make Fault.unknown_site why in
  function
  | Vehicle_done v -> Done v
  | Vehicle_failed (v, why) -> Failure (v, because why)
  | Timer_expired i -> Expired i
  | Confirmed (i, Ok yes) -> Answered (i, yes)
  | Confirmed (i, Error why) -> Nobody_answers (i, because why)
  | Recruited (i, v) -> Comes (i, v)
  | Answered { text; code = _ } -> Text text
  | Nobody_answers why -> No_text (because why)
  | Replied x -> Replied x
  | Host_failed why -> Host_failed (because why)
  | Input (k, x) -> Input (k, Value.canonical x)
  | Interruption -> Interruption

(* {1 Labels and effects} *)

let name_of_call : Code.request -> string = function
  | Host_call { subject; member; arguments = _ } -> Machine.name_of_call ~subject ~member
  | Pick _ | Ask _ | Pause _ | Execute _ -> invalid_arg "not a call of the host"

let label : I.label -> Label.t = function
  | LStart (v, p) -> Start (v, p.name)
  | LDone (v, p) -> Done (v, p.name)
  | LFail (v, p, m) -> Fail (v, p.name, m.message)
  | LCheck ds -> Check (to_deeds ds)
  | LAct ds -> Act (to_deeds ds)
  | LCut ds -> Cut (to_deeds ds)
  | LTimeout -> Time_out
  | LSet_time n -> Set_time n
  | LMake -> Make
  | LAllocate vs -> Allocate vs
  | LCannot_execute m -> Cannot_execute m.message
  | LBroken m -> Broken m.message
  | LRecruit v -> Recruit v
  | LAnswered yes -> Answer (if yes then "yes" else "no")
  | LNo_answer -> No_answer
  | LDid d -> Did (to_deed d)
  | LScript -> Silent
  | LPick pick -> Pick (Format.asprintf "%a" Settings.pp_pick pick.asked)
  | LBind vs -> Bind vs
  | LNo_vehicles m -> No_vehicles m.message
  | LAsk prompt -> Ask prompt
  | LAnswer text -> Answer text
  | LPause n -> Pause n
  | LResume -> Resume
  | LCall call -> Call (name_of_call call)
  | LReply x -> Reply (Value.to_string x)
  | LNo_reply m -> No_reply m.message
  | LExecute -> Execute
  | LEnd -> End
  | LHalt m -> Halt m.message
  | LFault m -> Fault m.message
  | LInput (k, x) -> Input (k, x)
  | LInterrupt -> Interrupt

let request_of_effect : I.effect_ -> Effect.t = function
  | Start (p, v) -> Start (v, p)
  | Stop v -> Stop v
  | Set_timer (i, n) -> Set_timer (i, n)
  | Cancel_timer i -> Cancel_timer i
  | Put_question (i, prompt) -> Put_question (i, prompt)
  | Withdraw_question i -> Withdraw_question i
  | Look_for pick -> Look_for pick.asked
  | Bind vs -> Bind vs
  | Release vs -> Release vs
  | Set_connection_timeout (vs, n) -> Set_connection_timeout (vs, n)
  | Say x -> Say (text x)
  | Ask_ prompt -> Ask prompt
  | Call_ (Host_call { subject; member; arguments }) -> Call_host { subject; member; arguments }
  | Call_ (Pick _ | Ask _ | Pause _ | Execute _) -> invalid_arg "not a call of the host"
  | End_ e -> End (to_ending e)

let rule name =
  match Rule.of_name name with Some rule -> rule | None -> invalid_arg (Printf.sprintf "no rule has the name %S" name)

let running : I.control -> Core.vehicle list = function
  | Exec (_, r) -> List.map fst (I.running names r)
  | Script _ | Wait _ | End _ -> []

let to_configuration ~vehicles (c : I.configuration) : Configuration.t =
  let vehicles = vehicles @ c.shared_of.bound @ running c.control_of in
  { control = to_control c.control_of; shared = to_shared ~vehicles c.shared_of }

let transition ~vehicles (I.To (l, c, effects), rules) : Transition.t =
  { rules = List.map rule rules; label = label l; next = to_configuration ~vehicles c;
    effects = List.map request_of_effect effects; assumed = []; otherwise = [] }
