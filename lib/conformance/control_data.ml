open Dolphin_semantics
open Core
open Data
open Value_data

(* {1 Residuals} *)

let of_vehicles = of_list (fun v : json -> `String v)

let of_made (r : Residual.request) : json =
  `List [ of_option of_vehicles r.allowed; `Int r.place; `Int r.depth ]

let made : json -> Residual.request = function
  | `List [ allowed; place; depth ] ->
    { allowed = option (list text) allowed; place = whole place; depth = whole depth }
  | json -> wrong "what a task that is made may be given" json

let rec of_residual budget (r : Residual.t) : json =
  part budget @@ fun () ->
  let part = of_residual budget and code = of_closure budget in
  let branch (b : Residual.branch) : json = `List [ code b.guard; part b.body ] in
  match r with
  | Ready (p, v) -> tagged "ready" [ of_platform_task budget p; `String v ]
  | Running (p, v) -> tagged "running" [ of_platform_task budget p; `String v ]
  | Action c -> tagged "action" [ code c ]
  | Condition c -> tagged "condition" [ code c ]
  | Sequence (a, rest) -> tagged "sequence" (part a :: List.map part rest)
  | Parallel bs -> tagged "parallel" (List.map part (Branches.to_list bs))
  | All_of (a, bs) -> tagged "allOf" (of_option part a :: List.map branch bs)
  | One_of bs -> tagged "oneOf" (List.map branch bs)
  | Until (Completes _, c, a) -> tagged "until" [ code c; part a ]
  | Until (Fails site, c, a) -> tagged "assure" [ `Int site; code c; part a ]
  | Idle { timer; seconds; site = _ } -> tagged "idle" [ `Int timer; of_float seconds ]
  | Confirm { question; prompt; site } -> tagged "confirm" [ `Int site; `Int question; `String prompt ]
  | During { on_cut; timer; duration; started; body } ->
    let parts = [ `Int timer; of_duration budget duration; `Bool started; part body ] in
    (match on_cut with Completes _ -> tagged "during" parts | Fails site -> tagged "within" (`Int site :: parts))
  | Watch (a, { code = c; anew = None }) -> tagged "watch" [ part a; code c ]
  | Watch (a, { code = c; anew = Some (t, request) }) ->
    tagged "watch" [ part a; code c; of_task budget t; of_made request ]
  | Repeat { round; again = { left; until; each; site } } ->
    let left = of_option (fun n : json -> `Int n) left in
    tagged "repeat" [ `Int site; of_option part round; left; of_option code until; part each ]
  | Made { code = c; given; request } -> tagged "made" [ code c; of_list (of_value budget) given; of_made request ]
  | Unallocated { task; request } -> tagged "unallocated" [ of_task budget task; of_made request ]
  | Hold (vs, a) -> tagged "hold" [ of_vehicles vs; part a ]
  | Recruit { number; asked; code = c; place; depth; site } ->
    tagged "recruit" [ `Int site; `Int number; of_filter budget asked; code c; `Int place; `Int depth ]
  | Recruited (v, a) -> tagged "recruited" [ `String v; part a ]
  | Fresh (ns, a) -> tagged "fresh" [ of_list (fun n -> `Int n) ns; part a ]
  | Ensure (ds, a) -> tagged "ensure" [ of_list (of_ensured budget) ds; part a ]

let rec residual nodes (json : json) : Residual.t =
  let part = residual nodes and code = closure nodes in
  let branch json : Residual.branch =
    let guard, body = pair code part json in
    { guard; body }
  in
  let during on_cut timer d started body : Residual.t =
    During { on_cut; timer = whole timer; duration = duration nodes d; started = truth started; body = part body }
  in
  match json with
  | `List [ `String "ready"; p; v ] -> Ready (platform_task nodes p, text v)
  | `List [ `String "running"; p; v ] -> Running (platform_task nodes p, text v)
  | `List [ `String "action"; c ] -> Action (code c)
  | `List [ `String "condition"; c ] -> Condition (code c)
  | `List (`String "sequence" :: a :: (_ :: _ as rest)) -> Sequence (part a, List.map part rest)
  | `List (`String "parallel" :: (_ :: _ :: _ as rs)) -> Parallel (Branches.of_list (List.map part rs))
  | `List (`String "allOf" :: a :: (_ :: _ as bs)) -> All_of (option part a, List.map branch bs)
  | `List (`String "oneOf" :: (_ :: _ as bs)) -> One_of (List.map branch bs)
  | `List [ `String "until"; c; a ] -> Until (Completes Fault.unknown_site, code c, part a)
  | `List [ `String "assure"; site; c; a ] -> Until (Fails (whole site), code c, part a)
  | `List [ `String "idle"; timer; seconds ] ->
    Idle { timer = whole timer; seconds = float seconds; site = Fault.unknown_site }
  | `List [ `String "confirm"; site; question; prompt ] ->
    Confirm { question = whole question; prompt = text prompt; site = whole site }
  | `List [ `String "during"; timer; d; started; body ] ->
    during (Completes Fault.unknown_site) timer d started body
  | `List [ `String "within"; site; timer; d; started; body ] -> during (Fails (whole site)) timer d started body
  | `List [ `String "watch"; a; c ] -> Watch (part a, { code = code c; anew = None })
  | `List [ `String "watch"; a; c; t; request ] ->
    Watch (part a, { code = code c; anew = Some (task nodes t, made request) })
  | `List [ `String "repeat"; site; round; left; until; each ] ->
    let again : Residual.again =
      { left = option whole left; until = option code until; each = part each; site = whole site }
    in
    Repeat { round = option part round; again }
  | `List [ `String "made"; c; given; request ] ->
    Made { code = code c; given = list (value nodes) given; request = made request }
  | `List [ `String "unallocated"; t; request ] -> Unallocated { task = task nodes t; request = made request }
  | `List [ `String "hold"; vs; a ] -> Hold (list text vs, part a)
  | `List [ `String "recruit"; site; number; asked; c; place; depth ] ->
    Recruit { number = whole number; asked = filter nodes asked; code = code c; place = whole place;
              depth = whole depth; site = whole site }
  | `List [ `String "recruited"; v; a ] -> Recruited (text v, part a)
  | `List [ `String "fresh"; ns; a ] -> Fresh (list whole ns, part a)
  | `List [ `String "ensure"; ds; a ] -> Ensure (list (ensured nodes) ds, part a)
  | json -> wrong "a residual" json

(* {1 Machines} *)

let iterations : (Code.iteration * string) list =
  [ (Each, "each"); (Collect, "collect"); (Find_all, "findAll"); (Find, "find"); (Any, "any"); (Every, "every");
    (Count, "count"); (Sum, "sum"); (Inject, "inject"); (Sort, "sort"); (Greatest, "greatest"); (Least, "least") ]

let site_of (e : expression) : json = `Int e.site

let expression nodes json =
  match Nodes.expression nodes (whole json) with
  | Some e -> e
  | None -> wrong "the number of an expression of this program" json

let of_values budget xs : json = of_list (of_value budget) (Array.to_list xs)
let values nodes json = Array.of_list (list (value nodes) json)

let of_items budget : Machine.items -> json = function
  | Items (xs, i) -> `List [ of_values budget xs; `Int i ]
  | Counting (i, last) -> tagged "counting" [ `Int i; `Int last ]

let items nodes : json -> Machine.items = function
  | `List [ `String "counting"; i; last ] -> Counting (whole i, whole last)
  | json ->
    let xs, i = pair (values nodes) whole json in
    if i < -1 then wrong "a place in a list" json else Items (xs, i)

let of_frame budget (frame : Machine.frame) : json =
  part budget @@ fun () ->
  let each = of_value budget in
  match frame with
  | Arguments { operation = _; at; evaluated; remaining } ->
    tagged "arguments" [ `Int at; of_list each evaluated; of_list site_of remaining ]
  | Assign_local slot -> tagged "local" [ `Int slot ]
  | Assign_global i -> tagged "global" [ `Int i ]
  | Choose (yes, no) -> tagged "choose" [ site_of yes; site_of no ]
  | Rest es -> tagged "rest" (List.map site_of es)
  | Loop_test (test, body) -> tagged "test" [ site_of test; site_of body ]
  | Loop_body (test, body) -> tagged "body" [ site_of test; site_of body ]
  | Next_item (slot, items, body) -> tagged "next" [ `Int slot; of_items budget items; site_of body ]
  | Leave locals -> tagged "leave" [ of_values budget locals ]
  | Iterate i ->
    tagged "iterate"
      [ `String (List.assoc i.iteration iterations); of_closure budget i.closure; each i.subject;
        of_values budget i.items; `Int i.index; of_list each i.gathered; `Int i.at ]

let iteration json =
  let name = text json in
  match List.find_opt (fun (_, name') -> String.equal name name') iterations with
  | Some (iteration, _) -> iteration
  | None -> wrong "a way to go through items" json

(* The expression at that site determines the use of its arguments. *)
let arguments nodes at evaluated remaining : Machine.frame =
  match expression nodes at with
  | { node = Apply (operation, _); site; _ } ->
    Arguments { operation; at = site; evaluated = list (value nodes) evaluated;
                remaining = list (expression nodes) remaining }
  | _ -> wrong "the number of a call" at

let frame nodes (json : json) : Machine.frame =
  let code = expression nodes in
  match json with
  | `List [ `String "arguments"; at; evaluated; remaining ] -> arguments nodes at evaluated remaining
  | `List [ `String "local"; slot ] -> Assign_local (whole slot)
  | `List [ `String "global"; i ] -> Assign_global (whole i)
  | `List [ `String "choose"; yes; no ] -> Choose (code yes, code no)
  | `List (`String "rest" :: es) -> Rest (List.map code es)
  | `List [ `String "test"; test; body ] -> Loop_test (code test, code body)
  | `List [ `String "body"; test; body ] -> Loop_body (code test, code body)
  | `List [ `String "next"; slot; its_items; body ] -> Next_item (whole slot, items nodes its_items, code body)
  | `List [ `String "leave"; locals ] -> Leave (values nodes locals)
  | `List [ `String "iterate"; name; c; subject; its_items; index; gathered; at ] ->
    Iterate
      { iteration = iteration name; closure = closure nodes c; subject = value nodes subject;
        items = values nodes its_items; index = whole index; gathered = list (value nodes) gathered; at = whole at }
  | json -> wrong "a frame of the script's stack" json

let of_machine budget (m : Machine.t) : json =
  let focus : json =
    match m.focus with
    | Evaluate e -> tagged "evaluate" [ site_of e ]
    | Give x -> tagged "give" [ of_value budget x ]
  in
  `List [ focus; `Int m.at; of_values budget m.locals; of_list (of_frame budget) m.stack ]

let machine nodes : json -> Machine.t = function
  | `List [ focus; at; locals; stack ] ->
    let focus : Machine.focus =
      match focus with
      | `List [ `String "evaluate"; e ] -> Evaluate (expression nodes e)
      | `List [ `String "give"; x ] -> Give (value nodes x)
      | json -> wrong "what the script looks at" json
    in
    let stack = list (frame nodes) stack in
    let is_call : Machine.frame -> bool = function
      | Leave _ -> true
      | Arguments _ | Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Next_item _
      | Iterate _ -> false
    in
    { focus; at = whole at; locals = values nodes locals; stack; calls = List.length (List.filter is_call stack) }
  | json -> wrong "a script" json

(* {1 Requests} *)

let of_pick (p : Settings.pick) : json =
  let f = p.filter in
  let area : Dolphin_geo.Area.t -> json = function
    | Circle { centre; radius } -> `List [ Plan_data.of_position centre; of_float radius ]
    | Shape shape -> tagged "rims" (List.map (of_list Plan_data.of_position) (Dolphin_geo.Area.rings shape))
  in
  let text x : json = `String x in
  tagged (if p.otherwise then "pick-else" else "pick")
    [ of_option text f.id; of_option text f.kind; of_list text f.payload; of_option area f.region;
      (match p.count with Exactly n -> `Int n | All -> `String "all"); of_option of_float p.timeout ]

let area (json : json) =
  let made =
    match json with
    | `List (`String "rims" :: rims) -> Dolphin_geo.Area.of_rings (List.map (list Plan_data.position) rims)
    | json ->
      let centre, radius = pair Plan_data.position float json in
      Dolphin_geo.Area.circle centre radius
  in
  match made with Ok area -> area | Error _ -> wrong "an area" json

let count : json -> Settings.count = function
  | `String "all" -> All
  | `Int n when n > 0 -> Exactly n
  | json -> wrong "a number of vehicles" json

let of_request budget : Code.request -> json = function
  | Pick pick -> of_pick pick
  | Ask prompt -> tagged "ask" [ `String prompt ]
  | Pause seconds -> tagged "pause" [ of_float seconds ]
  | Execute t -> tagged "execute" [ of_task budget t ]
  | Host_call { subject; member; arguments } ->
    let arguments = of_option (of_list (of_value budget)) arguments in
    tagged "call" [ of_option (fun name -> `String name) subject; `String member; arguments ]

let request nodes : json -> Code.request = function
  | `List [ `String (("pick" | "pick-else") as name); id; kind; payload; region; its_count; timeout ] ->
    let filter : Settings.filter =
      { id = option text id; kind = option text kind; payload = list text payload; region = option area region } in
    Pick { filter; count = count its_count; timeout = option float timeout; otherwise = (name = "pick-else") }
  | `List [ `String "ask"; prompt ] -> Ask (text prompt)
  | `List [ `String "pause"; seconds ] -> Pause (float seconds)
  | `List [ `String "execute"; t ] -> Execute (task nodes t)
  | `List [ `String "call"; subject; member; arguments ] ->
    Host_call
      { subject = option text subject; member = text member; arguments = option (list (value nodes)) arguments }
  | json -> wrong "what a script waits for" json

(* {1 Control} *)

let of_fault (f : Fault.t) : json =
  let cause = match f.cause with Code | Task _ -> "code" | Assertion -> "assertion" | Unknown -> "unknown" in
  `List [ `String f.message; `Int f.site; `String cause ]

let fault : json -> Fault.t = function
  | `List [ message; site; `String "code" ] -> Fault.make (whole site) (text message)
  | `List [ message; site; `String "unknown" ] -> { (Fault.make (whole site) (text message)) with cause = Unknown }
  | `List [ message; site; `String "assertion" ] -> Fault.assertion (whole site) (text message)
  | json -> wrong "a fault" json

let of_ending : Configuration.ending -> json = function
  | Completed -> tagged "completed" []
  | Halted message -> tagged "halted" [ `String message ]
  | Failed f -> tagged "failed" [ of_fault f ]
  | Interrupted -> tagged "interrupted" []

let ending : json -> Configuration.ending = function
  | `List [ `String "completed" ] -> Completed
  | `List [ `String "halted"; message ] -> Halted (text message)
  | `List [ `String "failed"; f ] -> Failed (fault f)
  | `List [ `String "interrupted" ] -> Interrupted
  | json -> wrong "an end" json

let of_control budget : Configuration.control -> json = function
  | Script m -> tagged "script" [ of_machine budget m ]
  | Waiting (m, q) -> tagged "wait" [ of_machine budget m; of_request budget q ]
  | Executing (m, r) -> tagged "exec" [ of_machine budget m; of_residual budget r ]
  | Ended e -> tagged "end" [ of_ending e ]

let control nodes : json -> Configuration.control = function
  | `List [ `String "script"; m ] -> Script (machine nodes m)
  | `List [ `String "wait"; m; q ] -> Waiting (machine nodes m, request nodes q)
  | `List [ `String "exec"; m; r ] -> Executing (machine nodes m, residual nodes r)
  | `List [ `String "end"; e ] -> Ended (ending e)
  | json -> wrong "a control" json
