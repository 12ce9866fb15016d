open Dolphin_syntax.Ast
open Dolphin_plans
open Dolphin_semantics
module Diagnostic = Dolphin_syntax.Diagnostic
module Scenario = Dolphin_scenario.Scenario
module Position = Dolphin_geo.Position

type ending = Succeeds | Fails | Either

(* A task that takes no time. *)
type timeless = {
  ending : ending;
  acts : bool;  (* it has code, which may open a guard *)
  place : Position.t option;  (* it takes none on vehicles that are here already *)
}

let succeeds = { ending = Succeeds; acts = false; place = None }
let fails = { succeeds with ending = Fails }

type known = {
  scenario : Scenario.t;
  vehicles : Scenario.vehicle list;  (* those that the program may have *)
  plans : (expression * Inline_plan.t) list;
  names : (string * timeless) list;  (* variables and functions that surely are such a task *)
}

(* {1 Plans} *)

let is_empty (v : Scenario.vehicle) = v.battery = 0. && v.charge = 0.

let never_runs known (plan : Scenario.plan option) =
  let refuses v = Option.fold plan ~none:false ~some:(fun p -> not (Scenario.knows p v)) in
  known.vehicles <> [] && List.for_all refuses known.vehicles

let all_are_empty known =
  let charges (p : Scenario.plan) = p.charges <> None in
  known.vehicles <> [] && List.for_all is_empty known.vehicles && not (List.exists charges known.scenario.plans)

let of_ending : Scenario.ending -> ending = function
  | Succeeds -> Succeeds
  | Fails -> Fails
  | May_fail _ -> Either

let entry known name = List.find_opt (fun (p : Scenario.plan) -> p.name = name) known.scenario.plans

let by_name known name =
  let plan = entry known name in
  if never_runs known plan then Some fails
  else
    match plan with
    | Some { duration = Some { most = 0.; _ }; ending; _ } -> Some { succeeds with ending = of_ending ending }
    | Some _ | None -> if all_are_empty known then Some fails else None

(* A vehicle that has run it once is at its end. *)
let described known plan =
  let entry = entry known (Inline_plan.name plan) in
  let places from =
    List.concat_map (fun (leg : Inline_plan.leg) -> leg.waypoints) (Inline_plan.path ~from ~speed:1. plan) in
  let place = match List.rev (places Dolphin_geo.Place.apdl) with [] -> None | last :: _ -> Some last in
  let from = Option.value place ~default:Dolphin_geo.Place.apdl in
  let { Inline_plan.moving; staying; metres = _ } = Inline_plan.extent ~from ~speed:1. plan in
  if never_runs known entry then Some fails
  else if moving +. staying = 0. then
    let ending = Option.fold entry ~none:Succeeds ~some:(fun (p : Scenario.plan) -> of_ending p.ending) in
    Some { succeeds with ending; place }
  else if all_are_empty known then Some fails
  else None

(* {1 Code} *)

(* Expressions of code that cannot fail, and cannot end anything. *)
let rec is_plain (e : expression) =
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ -> true
  | Template parts -> List.for_all (function Literal _ -> true | Hole e -> is_plain e) parts
  | Binary ((Add | Subtract | Multiply), a, b) -> is_plain a && is_plain b
  | Unary (_, e) | Increment { target = e; _ } -> is_plain e
  | Call { callee = { it = Variable ("post" | "message"); _ }; arguments } ->
    List.for_all (function Positional e | Named (_, e) -> is_plain e | Keyed _ -> false) arguments
  | _ -> false

let is_plain_statement (s : statement) =
  match s.it with
  | Expression e | Assign { value = e; target = { it = Variable _; _ }; _ } | Define (_, Some e) -> is_plain e
  | _ -> false

let calls name (s : statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable f; _ }; arguments = [] }; _ } -> f = name
  | _ -> false

(* Whether the code does [name()] in the end, and nothing else that matters. *)
let comes_to name (c : closure) =
  match List.rev c.body with
  | last :: rest -> calls name last && List.for_all is_plain_statement rest
  | [] -> false

let ends_in_failure (c : closure) =
  match List.rev c.body with
  | { it = Expression { it = Call { callee = { it = Variable "fail"; _ }; _ }; _ }; _ } :: rest ->
    List.for_all is_plain_statement rest
  | _ -> false

(* {1 Tasks} *)

let together a b ending =
  match a.place, b.place with
  | Some p, Some q when not (Position.equal p q) -> None
  | None, place | place, (None | Some _) -> Some { ending; acts = a.acts || b.acts; place }

let ( let* ) = Option.bind

(* Of tasks that are not timeless: whether nothing of this happens before time passes. *)
let rec begins_with_time (e : expression) =
  match e.it with
  | Builder ((Imc_plan | Mission), _) | Call { callee = { it = Variable ("task" | "imcPlan" | "idle"); _ }; _ } -> true
  | Binary (Sequence, t, _) | Index (t, _) | Repeat { body = t; rounds = None; _ } -> begins_with_time t
  | Binary (Parallel, a, b) -> begins_with_time a && begins_with_time b
  | _ -> false

let rec task known (e : expression) =
  match e.it with
  | Variable x | Call { callee = { it = Variable x; _ }; arguments = [] } -> List.assoc_opt x known.names
  | Builder ((Imc_plan | Mission), _) -> Option.bind (List.assq_opt e known.plans) (described known)
  | Call { callee = { it = Variable name; _ }; arguments = [ Positional argument ] } -> call known name argument
  | Binary (Sequence, a, b) -> sequence known a b
  | Binary (Parallel, a, b) ->
    let* a = task known a in
    let* b = task known b in
    together a b (if a.ending = b.ending then a.ending else if a.ending = Succeeds then b.ending else Either)
  | Closure { parameters = None | Some []; body = [ { it = Expression e | Return (Some e); _ } ] } -> task known e
  | Index (t, _) -> task known t
  | Ensure (t, _) -> Option.map (fun t -> { t with acts = true }) (task known t)
  | During (on_cut, d, t) -> limited known on_cut d t
  | Until (Completes, _, t) ->
    Option.map (fun t -> { t with ending = (if t.ending = Fails then Either else t.ending) }) (task known t)
  | Until (Fails, _, t) -> Option.map (fun t -> { t with ending = Either }) (task known t)
  | Repeat { rounds = Some { it = Integer n; _ }; body; until = None } when n > 0 -> task known body
  | Conditional (_, a, b) ->
    let* a = task known a in
    let* b = task known b in
    together a b (if a.ending = b.ending then a.ending else Either)
  | Watch (t, handler) -> watched known t handler
  | _ -> None

(* At 0 s a task that takes time is cut. *)
and limited known on_cut d t =
  match Option.bind (Literal_check.value d) Value.to_number, task known t with
  | Some 0., Some t when on_cut = Fails && t.ending = Succeeds -> Some { t with ending = Either }
  | Some 0., None when begins_with_time t -> Some (if on_cut = Fails then fails else succeeds)
  | _, found -> found

and call known name argument =
  match name, argument.it with
  | ("task" | "imcPlan"), String plan -> by_name known plan
  | "action", Closure c ->
    let acting ending = Some { succeeds with ending; acts = true } in
    if List.for_all is_plain_statement c.body then acting Succeeds
    else if ends_in_failure c then acting Fails
    else None
  | "idle", _ ->
    let seconds = Option.bind (Literal_check.value argument) Value.to_number in
    if seconds = Some 0. then Some succeeds else None
  | _ -> None

and sequence known a b =
  let* a = task known a in
  match a.ending with
  | Fails -> Some a
  | Succeeds ->
    let* b = task known b in
    together a b b.ending
  | Either ->
    let* b = task known b in
    together a b Either

and watched known t handler =
  let* t = task known t in
  if t.ending = Succeeds || comes_to "propagate" handler then Some t
  else if comes_to "ignore" handler then Some { t with ending = Succeeds; acts = true }
  else if comes_to "retry" handler && t.ending = Fails then None
  else Some { t with ending = Either; acts = true }

(* {1 Names} *)

let function_bodies ast =
  let body (s : statement) =
    match s.it with
    | Function { name; parameters = []; body = [ { it = Expression e | Return (Some e); _ } ] } -> Some (name.it, e)
    | _ -> None
  in
  List.filter_map body ast

(* The value of each of [names], which are assigned once. *)
let rec values names acc (s : statement) =
  match s.it with
  | Assign { target = { it = Variable x; _ }; value; operator = None } | Define ({ it = x; _ }, Some value)
    when Assigned.Names.mem x names -> (x, value) :: acc
  | Function { body; _ } | Block body | While (_, body) | For (_, _, body) -> List.fold_left (values names) acc body
  | If (_, yes, no) -> List.fold_left (values names) acc (yes @ no)
  | _ -> acc

(* A name may be a task made of another. *)
let deepest = 5

let with_names known ast =
  let variables = List.fold_left (values (Assigned.once (fun _ -> true) ast)) [] ast in
  let assigned = Assigned.names ast in
  let functions = List.filter (fun (f, _) -> not (Assigned.Names.mem f assigned)) (function_bodies ast) in
  let learn known =
    let name (x, e) = Option.map (fun t -> (x, t)) (task known e) in
    { known with names = List.filter_map name (functions @ variables) }
  in
  let rec go n known = if n = 0 then known else go (n - 1) (learn known) in
  go deepest known

(* The vehicles of the types that all [pick]s name; those of the fleet, if one has none. *)
let vehicles_of ast (s : Scenario.t) =
  let kinds (s : statement) =
    match s.it with
    | Setting ({ it = "type"; _ }, e)
    | Expression { it = Call { callee = { it = Variable "type"; _ }; arguments = [ Positional e ] }; _ } ->
      (match e.it with String kind -> Some [ kind ] | _ -> None)
    | _ -> None
  in
  let settings acc (e : expression) =
    match e.it with
    | Builder (Pick, body) | Pick_else (body, _) | Recruit (body, _) -> List.find_map kinds body :: acc
    | _ -> acc
  in
  let picks = List.fold_left (Fold.statement settings) [] ast in
  if List.mem None picks then s.vehicles
  else
    let kinds = List.concat_map (Option.value ~default:[]) picks in
    List.filter (fun (v : Scenario.vehicle) -> List.mem v.kind kinds) s.vehicles

(* {1 Loops} *)

(* The endless loops that a guard around them may end. *)
let guarded ast =
  let loop acc (e : expression) = match e.it with Repeat _ | Watch _ -> e :: acc | _ -> acc in
  let inside acc (e : expression) = match e.it with Until (_, _, t) -> Fold.expression loop acc t | _ -> acc in
  List.fold_left (Fold.statement inside) [] ast

let goes_round at =
  Diagnostic.warning No_time at "a round of this takes no time: a run that gets here goes round at one instant"
    ~hint:"let each round wait: give a plan in it a duration, or add idle(1)"

let fails_again at =
  Diagnostic.warning No_time at "this fails at once, and retry() starts it again at the same instant"
    ~hint:"let each try wait, as in watch idle(10) >> T onError { retry() }, or limit their number"

let at_expression known guarded acc (e : expression) =
  let counts t = not (t.acts && List.memq e guarded) in
  match e.it with
  | Repeat { rounds = None; body; until } -> (
      match task known body with
      | Some ({ ending = Succeeds; _ } as t) when counts t && not (t.acts && until <> None) -> goes_round e.at :: acc
      | Some _ | None -> acc)
  | Watch (t, handler) when comes_to "retry" handler -> (
      match task known t with
      | Some ({ ending = Fails; _ } as t) when counts t -> fails_again e.at :: acc
      | Some _ | None -> acc)
  | _ -> acc

let executed (s : statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable "execute"; _ }; arguments }; _ } -> (
      match List.rev arguments with (Positional e | Named (_, e) | Keyed (_, e)) :: _ -> Some e | [] -> None)
  | _ -> None

let rec at_statement known acc (s : statement) =
  let within = List.fold_left (at_statement known) in
  match s.it with
  | While ({ it = Boolean true; _ }, body) ->
    let tasks = List.filter_map executed body in
    let succeeds e = match task known e with Some { ending = Succeeds; _ } -> true | Some _ | None -> false in
    let all_plain = List.for_all (fun s -> executed s <> None || is_plain_statement s) body in
    if tasks <> [] && all_plain && List.for_all succeeds tasks then goes_round s.at :: acc else within acc body
  | While (_, body) | For (_, _, body) | Block body | Function { body; _ } -> within acc body
  | If (_, yes, no) -> within (within acc yes) no
  | _ -> acc

let found ~plans ast scenario =
  let known = with_names { scenario; vehicles = vehicles_of ast scenario; plans; names = [] } ast in
  let inside = List.fold_left (Fold.statement (at_expression known (guarded ast))) [] ast in
  List.fold_left (at_statement known) inside ast
