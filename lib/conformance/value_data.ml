open Dolphin_semantics
open Core
open Data

let of_text x : json = `String x
let of_vehicles = of_list of_text

let quantities = [ (Amount, "amount"); (Place, "place"); (Region, "region"); (Words, "words") ]

(* {1 Writing} *)

let of_platform_task budget (p : platform_task) : json =
  part budget @@ fun () -> `List [ `String p.name; `Int p.task_site; of_option Plan_data.of_inline p.plan ]

let rec of_value budget (x : value) : json =
  part budget @@ fun () ->
  let each = of_value budget in
  match x with
  | Null -> `Null
  | Boolean b -> `Bool b
  | Integer i -> `Int i
  | Number n -> of_number n
  | String text -> `String text
  | Wildcard -> tagged "wildcard" []
  | Symbol name -> tagged "symbol" [ `String name ]
  | List xs -> tagged "list" (List.map each (Vector.to_list xs))
  | Map entries -> tagged "map" (List.map (of_pair of_text each) entries)
  | Range (first, last) -> tagged "range" [ `Int first; `Int last ]
  | Position p -> tagged "position" [ Plan_data.of_position p ]
  | Area (Circle { centre; radius }) -> tagged "area" [ Plan_data.of_position centre; of_float radius ]
  | Area (Shape shape) ->
    tagged "rims" (List.map (of_list Plan_data.of_position) (Dolphin_geo.Area.rings shape))
  | Vehicles vs -> tagged "vehicles" (List.map of_text vs)
  | Task t -> tagged "task" [ of_task budget t ]
  | Closure c -> tagged "closure" [ of_closure budget c ]
  | Host name -> tagged "host" [ `String name ]
  | Settings settings -> tagged "settings" (List.map (of_setting budget) settings)
  | Reading r -> tagged "reading" [ `String (List.assoc r.quantity quantities); `String r.text ]
  | Unknown u -> tagged "unknown" [ `String u.sensor; `String u.of_vehicle ]

(* Texts stand for themselves, so what JSON has no number for needs a tag. *)
and of_number n = if Float.is_finite n then of_float n else tagged "number" [ of_float n ]

and of_setting budget s : json =
  let each = of_value budget in
  `List
    [ `String s.setting; of_list each s.positional; of_list (of_pair of_text each) s.named; `Int s.setting_site ]

and of_closure budget (c : closure) : json =
  `List (`Int c.lambda.id :: List.map (of_value budget) (Array.to_list c.captured))

and of_task budget (t : task) : json =
  part budget @@ fun () ->
  let part = of_task budget and code = of_closure budget in
  match t with
  | Platform p -> tagged "platform" [ of_platform_task budget p ]
  | Action c -> tagged "action" [ code c ]
  | Condition c -> tagged "condition" [ code c ]
  | Sequence (a, b) -> tagged "sequence" [ part a; part b ]
  | Parallel (a, b) -> tagged "parallel" [ part a; part b ]
  | Allocated (a, vs) -> tagged "allocated" [ part a; of_vehicles vs ]
  | All_of branches -> tagged "allOf" (List.map (of_branch budget) branches)
  | One_of branches -> tagged "oneOf" (List.map (of_branch budget) branches)
  | Until (Completes _, c, a) -> tagged "until" [ code c; part a ]
  | Until (Fails site, c, a) -> tagged "assure" [ `Int site; code c; part a ]
  | Idle { seconds; site = _ } -> tagged "idle" [ of_float seconds ]
  | Confirm { prompt; site } -> tagged "confirm" [ `Int site; `String prompt ]
  | During (Completes _, d, a) -> tagged "during" [ of_duration budget d; part a ]
  | During (Fails site, d, a) -> tagged "within" [ `Int site; of_duration budget d; part a ]
  | Watch (a, c) -> tagged "watch" [ part a; code c ]
  | Repeat { rounds; until; body; site } ->
    let rounds = of_option (fun n : json -> `Int n) rounds in
    tagged "repeat" [ `Int site; rounds; of_option code until; part body ]
  | Made c -> tagged "made" [ code c ]
  | Fresh c -> tagged "fresh" [ code c ]
  | Ensure (ds, a) -> tagged "ensure" [ of_list (of_ensured budget) ds; part a ]
  | Recruit { asked; code = c; site } -> tagged "recruit" [ `Int site; of_filter budget asked; code c ]

and of_ensured budget = function
  | Pair (k, x) -> tagged "post" [ of_text k; of_value budget x ]
  | Variable (i, name, x) -> tagged "set" [ `Int i; of_text name; of_value budget x ]
  | Taken -> tagged "giveBack" []

and of_filter budget (q : Vehicle_filter.t) : json =
  let text = of_option of_text and area a = of_value budget (Area a) in
  `List [ text q.id; text q.kind; of_list of_text q.payload; of_option area q.region ]

and of_branch budget (b : branch) : json = `List [ of_closure budget b.guard; of_task budget b.body ]

and of_duration budget = function
  | Seconds seconds -> of_float seconds
  | Given_by c -> tagged "code" [ of_closure budget c ]

(* {1 Reading} *)

let platform_task _ : json -> platform_task = function
  | `List [ name; site; plan ] ->
    { name = text name; task_site = whole site; plan = option Plan_data.inline plan }
  | json -> wrong "a platform task" json

let quantity json =
  let name = text json in
  match List.find_opt (fun (_, name') -> String.equal name name') quantities with
  | Some (quantity, _) -> quantity
  | None -> wrong "a quantity that sensors show" json

let rec value nodes (json : json) : value =
  let each = value nodes in
  match json with
  | `Null -> Null
  | `Bool b -> Boolean b
  | `Int i -> Integer i
  | `Float x -> Number x
  | `String text -> String text
  | `List [ `String "number"; x ] -> Number (float x)
  | `List [ `String "wildcard" ] -> Wildcard
  | `List [ `String "symbol"; name ] -> Symbol (text name)
  | `List (`String "list" :: xs) -> List (Vector.of_list (List.map each xs))
  | `List (`String "map" :: entries) -> Map (List.map (pair text each) entries)
  | `List [ `String "range"; first; last ] -> Range (whole first, whole last)
  | `List [ `String "position"; p ] -> Position (Plan_data.position p)
  | `List [ `String "area"; centre; radius ] -> (
      match Dolphin_geo.Area.circle (Plan_data.position centre) (float radius) with
      | Ok area -> Area area
      | Error _ -> wrong "an area" json)
  | `List (`String "rims" :: rims) -> (
      match Dolphin_geo.Area.of_rings (List.map (list Plan_data.position) rims) with
      | Ok area -> Area area
      | Error _ -> wrong "an area" json)
  | `List (`String "vehicles" :: vs) -> Vehicles (List.map text vs)
  | `List [ `String "task"; t ] -> Task (task nodes t)
  | `List [ `String "closure"; c ] -> Closure (closure nodes c)
  | `List [ `String "host"; name ] -> Host (text name)
  | `List [ `String "unknown"; sensor; v ] -> Unknown { sensor = text sensor; of_vehicle = text v }
  | `List [ `String "reading"; q; spelt ] -> Reading { quantity = quantity q; text = text spelt }
  | `List (`String "settings" :: settings) -> Settings (List.map (setting nodes) settings)
  | json -> wrong "a value" json

and setting nodes : json -> setting = function
  | `List [ name; positional; named; site ] ->
    let each = value nodes in
    { setting = text name; positional = list each positional; named = list (pair text each) named;
      setting_site = whole site }
  | json -> wrong "a setting" json

and closure nodes (json : json) : closure =
  match json with
  | `List (`Int id :: captured) -> (
      match Nodes.lambda nodes id with
      | Some lambda when Array.length lambda.captures = List.length captured ->
        { lambda; captured = Array.of_list (List.map (value nodes) captured) }
      | Some _ | None -> wrong "code of this program" json)
  | json -> wrong "code" json

and task nodes (json : json) : task =
  let part = task nodes and code = closure nodes in
  match json with
  | `List [ `String "platform"; p ] -> Platform (platform_task nodes p)
  | `List [ `String "action"; c ] -> Action (code c)
  | `List [ `String "condition"; c ] -> Condition (code c)
  | `List [ `String "sequence"; a; b ] -> Sequence (part a, part b)
  | `List [ `String "parallel"; a; b ] -> Parallel (part a, part b)
  | `List [ `String "allocated"; a; vs ] -> Allocated (part a, list text vs)
  | `List (`String "allOf" :: (_ :: _ as branches)) -> All_of (List.map (branch nodes) branches)
  | `List (`String "oneOf" :: (_ :: _ as branches)) -> One_of (List.map (branch nodes) branches)
  | `List [ `String "until"; c; a ] -> Until (Completes Fault.unknown_site, code c, part a)
  | `List [ `String "assure"; site; c; a ] -> Until (Fails (whole site), code c, part a)
  | `List [ `String "idle"; seconds ] -> Idle { seconds = float seconds; site = Fault.unknown_site }
  | `List [ `String "confirm"; site; prompt ] -> Confirm { prompt = text prompt; site = whole site }
  | `List [ `String "during"; d; a ] ->
    During (Completes Fault.unknown_site, duration nodes d, part a)
  | `List [ `String "within"; site; d; a ] -> During (Fails (whole site), duration nodes d, part a)
  | `List [ `String "watch"; a; c ] -> Watch (part a, code c)
  | `List [ `String "repeat"; site; rounds; until; body ] ->
    Repeat { rounds = option whole rounds; until = option code until; body = part body; site = whole site }
  | `List [ `String "made"; c ] -> Made (code c)
  | `List [ `String "fresh"; c ] -> Fresh (code c)
  | `List [ `String "ensure"; ds; a ] -> Ensure (list (ensured nodes) ds, part a)
  | `List [ `String "recruit"; site; asked; c ] ->
    Recruit { asked = filter nodes asked; code = code c; site = whole site }
  | json -> wrong "a task" json

and ensured nodes (json : json) : ensured =
  match json with
  | `List [ `String "post"; k; x ] -> Pair (text k, value nodes x)
  | `List [ `String "set"; i; name; x ] -> Variable (whole i, text name, value nodes x)
  | `List [ `String "giveBack" ] -> Taken
  | json -> wrong "an ensured deed" json

and filter nodes : json -> Vehicle_filter.t = function
  | `List [ id; kind; payload; region ] ->
    let area json = match value nodes json with Area a -> a | _ -> wrong "an area" json in
    { id = option text id; kind = option text kind; payload = list text payload; region = option area region }
  | json -> wrong "what a recruit asks of a vehicle" json

and branch nodes json : branch =
  let guard, body = pair (closure nodes) (task nodes) json in
  { guard; body }

and duration nodes : json -> duration = function
  | `List [ `String "code"; c ] -> Given_by (closure nodes c)
  | json -> Seconds (float json)
