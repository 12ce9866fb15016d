open Dolphin_syntax
open Dolphin_plans
open Dolphin_semantics
open Ast
open Entry

let error ?hint at fmt = Format.kasprintf (fun message -> Result.Error (Diagnostic.error ?hint at message)) fmt
let ( let* ) = Result.bind

(* {1 Settings} *)

let one read set draft = function
  | [ value ] -> Some (Result.map (set draft) (read value))
  | _ -> None

let two read set draft = function
  | [ first; second ] ->
    Some
      (let* a = read first in
       let* b = read second in
       set draft (first, a) (second, b))
  | _ -> None

let several read set draft = function
  | [] -> None
  | values ->
    let add read_so_far value =
      let* xs = read_so_far in
      Result.map (fun x -> x :: xs) (read value)
    in
    Some (Result.map (fun xs -> set draft (List.rev xs)) (List.fold_left add (Ok []) values))

(* The first of several is the one at the start. *)
let shares v = function
  | [ battery ] -> { v with battery }
  | batteries -> { v with battery = List.hd batteries; batteries }

let battery v = function
  | [ { it = Literal.Unknown; _ } ] -> Some (Ok { v with tells_battery = false })
  | values -> several Setting.share shares v values

let seen_at (v : vehicle) position =
  if v.places = [] then { v with position; places = [ position ] } else { v with places = v.places @ [ position ] }

let shows (v : vehicle) = function
  | [] -> None
  | name :: values ->
    Some
      (let* quantity = Setting.text name in
       if List.mem_assoc quantity v.shows then error name.at "'%s' stands twice" quantity
       else
         let add (v : vehicle) xs = { v with shows = v.shows @ [ (quantity, xs) ] } in
         Option.value (several Setting.number add v values) ~default:(Ok (add v [])))

let place set draft values = Option.map (Result.map (set draft)) (Setting.position values)
let setting ?(again = false) word takes read : 'draft Setting.t = { word; takes; again; read }
let position_takes = "a latitude and a longitude in degrees or a place, as in at 41.185, -8.706 or at Location.APDL"

let drop vehicle (_, from) ((second : Setting.value), lasts) =
  if lasts > 0. then Ok { vehicle with drops = vehicle.drops @ [ { from; lasts } ] }
  else error second.at "a drop lasts longer than 0 seconds"

let charger v values =
  match List.rev values with
  | [] -> None
  | radius :: place ->
    let add position =
      let* position = position in
      let* metres = Setting.number radius in
      if metres > 0. && metres <= Dolphin_geo.Wgs84.farthest then
        Ok { v with chargers = v.chargers @ [ (position, metres) ] }
      else error radius.at "the radius of a charger is greater than 0 m and at most half around the earth"
    in
    Option.map add (Setting.position (List.rev place))

let vehicle_table : vehicle Setting.t list =
  [ setting "type" "a text, as in type 'UUV'" (one Setting.text (fun v kind -> { v with kind }));
    setting "payload" ~again:true "names of devices, as in payload 'DVL', 'Sidescan'"
      (several Setting.text (fun v payload -> { v with payload = v.payload @ payload }));
    setting "at" ~again:true position_takes (place seen_at);
    setting "speed" "metres per second, as in speed 1.5" (one Setting.speed (fun v speed -> { v with speed }));
    setting "battery" "a share, or several, as in battery 80.percent, or unknown" battery;
    setting "drain" "the share of the battery that an hour's work takes, as in drain 10.percent"
      (one Setting.per_hour (fun v drain -> { v with drain }));
    setting "charge" "the share of the battery that an hour's rest gives, as in charge 50.percent"
      (one Setting.per_hour (fun v charge -> { v with charge }));
    setting "charger" ~again:true "a place and a radius in metres, as in charger 41.185, -8.706, 30.m" charger;
    setting "shows" ~again:true "a quantity and its possible values, as in shows 'Temperature', 12, 18" shows;
    setting "joins" "a time, as in joins 30.seconds" (one Setting.time (fun v joins -> { v with joins }));
    setting "leaves" "a time, as in leaves 10.min" (one Setting.time (fun v time -> { v with leaves = Some time }));
    setting "drops" ~again:true "two times, when the link drops and for how long, as in drops 60.seconds, 30.seconds"
      (two Setting.time drop) ]

let duration plan = function
  | [ _ ] as values ->
    one Setting.time (fun plan n -> { plan with duration = Some { least = n; most = n } }) plan values
  | values ->
    let set plan (_, least) ((second : Setting.value), most) =
      if least <= most then Ok { plan with duration = Some { least; most } }
      else
        error second.at "this range is reversed: from %g to %g seconds" least most
          ~hint:"the shortest time comes first, as in duration 3.min, 9.min"
    in
    two Setting.time set plan values

let may_fail plan = function
  | [] -> Some (Ok { plan with ending = May_fail Defaults.failure })
  | values -> one Setting.share (fun plan share -> { plan with ending = May_fail share }) plan values

let fails plan = function
  | [] -> Some (Ok { plan with ending = Fails })
  | _ :: _ -> None

let plan_table : plan Setting.t list =
  [ setting "duration" "a time, or the shortest and the longest, as in duration 3.min, 9.min" duration;
    setting "mayFail" "nothing, or how often it fails, as in mayFail 20.percent" may_fail;
    setting "fails" "no value" fails;
    setting "at" position_takes (place (fun (p : plan) position -> { p with place = Some position }));
    setting "only" "types or ids of vehicles, as in only 'UUV', 'x8-02'"
      (several Setting.text (fun plan only -> { plan with only }));
    setting "charges" "the share of the battery that an hour of the plan gives, as in charges 120.percent"
      (one Setting.per_hour (fun plan share -> { plan with charges = Some share })) ]

let words table = List.map (fun (setting : 'draft Setting.t) -> setting.word) table
let vehicle_settings = words vehicle_table
let plan_settings = words plan_table

(* {1 Entries} *)

type 'entry named = { entry : 'entry; name_at : Location.t }

(* The entries read so far, latest first. *)
type state = {
  source : string;
  vehicles : vehicle named list;
  plans : plan named list;
  answers : answer named list;
  replies : reply named list;
  inputs : input list;
  samples : sample list;
  fences : Fences.fence list;
  plans_at : Dolphin_geo.Position.t option;
  begins : Calendar.t option;                   (* in whatever zone *)
  zone : int option;
  assumptions : (Location.t * argument list) list;
  constants : Constants.t;                      (* the names that fences may use: maps, and no variables *)
  unplaced : int;                               (* vehicles without a position *)
  faults : Diagnostic.t list;
}

let add_faults state faults = { state with faults = List.rev_append faults state.faults }
let add_fault state fault = add_faults state [ fault ]

let vehicle state (id : string located) body =
  let draft =
    { id = id.it; kind = ""; payload = []; position = Defaults.position state.unplaced; speed = 0.;
      battery = Defaults.battery; tells_battery = true;
      drain = Defaults.drain; charge = 0.; chargers = []; joins = 0.; leaves = None; drops = [];
      batteries = []; shows = []; places = [] } in
  let v, seen, faults = Setting.block ~what:"a vehicle" vehicle_table draft body in
  let v = match v.places with [ _ ] -> { v with places = [] } | [] | _ :: _ :: _ -> v in
  let given word = List.mem word seen in
  let v = if given "speed" then v else { v with speed = Defaults.speed ~kind:v.kind } in
  let untyped =
    if given "type" then []
    else
      [ Diagnostic.error id.at (Printf.sprintf "vehicle '%s' has no type" id.it) ~hint:"add its type: type 'UUV'" ] in
  let uncharged =
    if v.chargers = [] || v.charge > 0. then []
    else
      [ Diagnostic.error id.at (Printf.sprintf "vehicle '%s' has a charger, and no charge" id.it)
          ~hint:"add the share that an hour there gives: charge 50.percent" ] in
  let early =
    match v.leaves with
    | Some time when time <= v.joins ->
      [ Diagnostic.error id.at
          (Printf.sprintf "vehicle '%s' leaves at %g seconds, before it joins at %g" id.it time v.joins) ]
    | Some _ | None -> []
  in
  let state = add_faults state (faults @ untyped @ uncharged @ early) in
  let unplaced = if given "at" then state.unplaced else state.unplaced + 1 in
  { state with vehicles = { entry = v; name_at = id.at } :: state.vehicles; unplaced }

let plan state (name : string located) body =
  let draft = { name = name.it; duration = None; ending = Succeeds; place = None; only = []; charges = None } in
  let p, seen, faults = Setting.block ~what:"a plan" plan_table draft body in
  let both =
    if List.mem "fails" seen && List.mem "mayFail" seen then
      [ Diagnostic.error name.at (Printf.sprintf "plan '%s' has both fails and mayFail" name.it) ~hint:"leave one out" ]
    else [] in
  { (add_faults state (faults @ both)) with plans = { entry = p; name_at = name.at } :: state.plans }

(* An answer is the text that a person would type: the very text of the expression. *)
let spelling state (e : expression) =
  let start = e.at.Location.start.pos_cnum in
  String.sub state.source start (e.at.Location.stop.pos_cnum - start)

let answer state (prompt : string located) values =
  let texts = List.map (spelling state) values in
  { state with answers = { entry = { prompt = prompt.it; texts }; name_at = prompt.at } :: state.answers }

let reply state (call : string located) values =
  let add (rounds, faults) e =
    match Reply.read e with Ok replies -> (replies :: rounds, faults) | Error fault -> (rounds, fault :: faults)
  in
  let rounds, faults = List.fold_left add ([], []) values in
  let entry = { call = call.it; rounds = List.rev rounds } in
  { (add_faults state faults) with replies = { entry; name_at = call.at } :: state.replies }

let usage = function
  | "vehicle" -> "vehicle takes an id and a block of settings, as in vehicle 'x8-02', { type 'UAV' }"
  | "plan" -> "plan takes a name and a block of settings, as in plan 'survey1', { duration 3.min, 9.min }"
  | "answer" -> "answer takes a prompt and a value, as in answer 'Radius of the area? (km)', 2"
  | "field" ->
    "field takes a quantity, a value and a place, as in field 'Temperature', 12, at(41.18, -8.7), after 10.min"
  | "input" -> "input takes a key and a value, as in input 'abort', true, or input 'target', 1, 2, after 5.min"
  | "begins" -> "begins takes the date at which runs begin, as in begins '2026-06-01 21:00'"
  | "zone" -> "zone takes a time zone, as in zone '+01:00' or zone 'UTC'"
  | _ -> "reply takes a call of the supplier and a value, as in reply 'queue.await', task('survey1')"

(* [after 5.min] and [times 3] may stand behind the values. *)
let input state (word : string located) key values =
  let read (rounds, times, after, faults) (e : expression) =
    let fault at message = (rounds, times, after, Diagnostic.error at message :: faults) in
    match e.it with
    | Call { callee = { it = Variable "after"; _ }; arguments = [ Positional time ] } -> (
        match Result.bind (Literal.read time) (fun it -> Setting.time { it; at = time.at }) with
        | Ok _ when after <> None -> fault e.at "after stands twice"
        | Ok seconds -> (rounds, times, Some seconds, faults)
        | Error d -> (rounds, times, after, d :: faults))
    | Call { callee = { it = Variable "times"; _ }; arguments = [ Positional { it = Integer n; at } ] } ->
      if n < 1 then fault at "an input comes at least once"
      else if times <> None then fault e.at "times stands twice"
      else (rounds, Some n, after, faults)
    | Call { callee = { it = Variable "times"; _ }; _ } -> fault e.at "times takes a whole number, as in times 3"
    | Call { callee = { it = Variable "after"; _ }; _ } -> fault e.at "after takes a time, as in after 5.min"
    | _ -> (
        match Reply.data e with
        | Ok round -> (round :: rounds, times, after, faults)
        | Error d -> (rounds, times, after, d :: faults))
  in
  let rounds, times, after, faults = List.fold_left read ([], None, None, []) values in
  if faults <> [] then add_faults state faults
  else if rounds = [] then add_fault state (Diagnostic.error word.at (usage "input"))
  else
    let rounds = List.rev rounds in
    let times = Option.value times ~default:(List.length rounds) in
    { state with inputs = { key; rounds; times; after } :: state.inputs }

let field state (word : string located) quantity values =
  let read (value, place, time, faults) (e : expression) =
    let fault at message = (value, place, time, Diagnostic.error at message :: faults) in
    let settings arguments =
      let one = function
        | Positional x -> Result.map (fun it -> { it; at = x.at }) (Literal.read x)
        | Named (k, _) -> error k.at "values have no names here"
        | Keyed (k, _) -> error k.at "values have no names here"
      in
      Dolphin_results.Results.map one arguments
    in
    match e.it with
    | Call { callee = { it = Variable (("after" | "at") as what); _ }; _ }
      when (what = "after" && time <> None) || (what = "at" && place <> None) -> fault e.at (what ^ " stands twice")
    | Call { callee = { it = Variable "after"; _ }; arguments } -> (
        match Result.map (fun values -> one Setting.time (fun _ x -> x) 0. values) (settings arguments) with
        | Ok (Some (Ok seconds)) -> (value, place, Some seconds, faults)
        | Ok None -> fault e.at "after takes a time, as in after 5.min"
        | Ok (Some (Error d)) | Error d -> (value, place, time, d :: faults))
    | Call { callee = { it = Variable "at"; _ }; arguments } -> (
        match Result.map Setting.position (settings arguments) with
        | Ok (Some (Ok position)) -> (value, Some position, time, faults)
        | Ok None -> fault e.at ("at takes " ^ position_takes)
        | Ok (Some (Error d)) | Error d -> (value, place, time, d :: faults))
    | _ when value <> None -> fault e.at "a field has one value at one place"
    | _ -> (
        match Result.bind (Literal.read e) (fun it -> Setting.number { it; at = e.at }) with
        | Ok x -> (Some x, place, time, faults)
        | Error d -> (value, place, time, d :: faults))
  in
  let value, place, time, faults = List.fold_left read (None, None, None, []) values in
  match value, place with
  | _, _ when faults <> [] -> add_faults state (List.rev faults)
  | Some value, Some place ->
    { state with samples = { quantity; value; place; time = Option.value time ~default:0. } :: state.samples }
  | _, _ -> add_fault state (Diagnostic.error word.at (usage "field"))

let without_variables (d : Diagnostic.t) =
  match d.code, d.hint with
  | Unknown_name, None ->
    { d with hint = Some "a fleet has no variables: write the area itself, or map('harbour.geojson').basin" }
  | _, _ -> d

let fence state (word : string located) arguments =
  match Fence_declarations.read state.constants word.at arguments with
  | Ok fences -> { state with fences = List.rev_append fences state.fences }
  | Error found -> add_faults state (List.map without_variables found)

let locate state at arguments =
  match Default_place.read state.constants at arguments with
  | Ok _ when state.plans_at <> None -> add_fault state (Diagnostic.error at "locate stands twice")
  | Ok place -> { state with plans_at = Some place }
  | Error found -> add_faults state (List.map without_variables found)

(* An entry that stands once, with a text. *)
let once state (word : string located) ~stands ~read ~add (text : string located) =
  match read text.it with
  | Ok _ when stands -> add_fault state (Diagnostic.error word.at (word.it ^ " stands twice"))
  | Ok x -> add x
  | Error why -> add_fault state (Diagnostic.error text.at why)

let begins state word =
  let add begins = { state with begins = Some begins } in
  once state word ~stands:(state.begins <> None) ~read:(Calendar.read ~zone:0) ~add

let zone state word =
  let add zone = { state with zone = Some zone } in
  once state word ~stands:(state.zone <> None) ~read:Calendar.zone ~add

let entries =
  [ "vehicle"; "plan"; "answer"; "reply"; "input"; "field"; "fence"; "locate"; "begins"; "zone"; Recurrence.word ]

let words =
  match List.rev entries with
  | last :: others -> String.concat ", " (List.rev others) ^ " and " ^ last
  | [] -> ""

let entry state (word : string located) arguments =
  let misused state = add_fault state (Diagnostic.error word.at (usage word.it)) in
  let positional = List.filter_map (function Positional e -> Some e | Named _ | Keyed _ -> None) arguments in
  if word.it = Fence_declarations.word then fence state word arguments
  else if word.it = Default_place.word then locate state word.at arguments
  else if word.it = Recurrence.word then { state with assumptions = (word.at, arguments) :: state.assumptions }
  else if List.length positional < List.length arguments then misused state
  else
    match word.it, positional with
    | _, { it = String ""; at } :: _ -> add_fault state (Diagnostic.error at "this name is empty")
    | "vehicle", [ { it = String id; at }; { it = Closure { parameters = None; body }; at = _ } ] ->
      vehicle state { it = id; at } body
    | "plan", [ { it = String name; at } ] -> plan state { it = name; at } []
    | "plan", [ { it = String name; at }; { it = Closure { parameters = None; body }; at = _ } ] ->
      plan state { it = name; at } body
    | "answer", { it = String prompt; at } :: (_ :: _ as values) -> answer state { it = prompt; at } values
    | "reply", { it = String call; at } :: (_ :: _ as values) -> reply state { it = call; at } values
    | "input", { it = String key; at = _ } :: values -> input state word key values
    | "field", { it = String quantity; at = _ } :: values -> field state word quantity values
    | "begins", [ { it = String text; at } ] -> begins state word { it = text; at }
    | "zone", [ { it = String text; at } ] -> zone state word { it = text; at }
    | ("vehicle" | "plan" | "answer" | "reply" | "input" | "field" | "begins" | "zone"), _ -> misused state
    | other, _ ->
      let hint =
        match Diagnostic.suggest other entries with
        | Some near -> Printf.sprintf "did you mean '%s'?" near
        | None -> "a fleet consists of " ^ words
      in
      add_fault state (Diagnostic.error word.at (Printf.sprintf "a fleet has no '%s'" other) ~hint)

let statement state (s : statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable word; at }; arguments }; at = _ } ->
    entry state { it = word; at } arguments
  | Expression { it = Variable word; at } -> entry state { it = word; at } []
  | _ ->
    add_fault state
      (Diagnostic.error s.at
         (Printf.sprintf "only %s may stand in a fleet" words)
         ~hint:"as in vehicle 'x8-02', { type 'UAV' }")

(* {1 All together} *)

let repeated what name named =
  let first = Hashtbl.create 64 in
  let check faults { entry; name_at } =
    match Hashtbl.find_opt first (name entry) with
    | None ->
      Hashtbl.add first (name entry) name_at;
      faults
    | Some earlier ->
      Diagnostic.error name_at
        (Printf.sprintf "%s '%s' stands twice" what (name entry))
        ~hint:(Printf.sprintf "the first is on line %d" (Location.line earlier))
      :: faults
  in
  List.fold_left check [] (List.rev named)

(* The quantity is missing. *)
let unmeasured state =
  let is_sampled q = List.exists (fun s -> s.quantity = q) state.samples in
  let of_vehicle { entry = (v : vehicle); name_at } =
    let is_open (q, xs) = xs = [] && not (is_sampled q) in
    let fault (q, _) =
      Diagnostic.error name_at (Printf.sprintf "vehicle '%s' shows '%s', which has no values" v.id q)
        ~hint:(Printf.sprintf "give values, as in shows '%s', 12, 18, or a field: field '%s', 12, at(41.18, -8.7)" q q)
    in
    List.map fault (List.filter is_open v.shows)
  in
  List.concat_map of_vehicle state.vehicles

(* Vehicles may stand behind the assumptions on them. Of several with the same readings the first counts. *)
let recurrences state vehicles =
  let one (at, arguments) = Recurrence.read ~vehicles at arguments in
  let read (found, faults) assumption =
    match one assumption with Ok more -> (found @ more, faults) | Error more -> (found, faults @ more) in
  let found, faults = List.fold_left read ([], []) (List.rev state.assumptions) in
  let add unique (r : recurrence) =
    let is_same (r' : recurrence) = List.equal (fun a b -> World.compare_assumption a b = 0) r.readings r'.readings in
    if List.exists is_same unique then unique else r :: unique
  in
  (List.rev (List.fold_left add [] found), faults)

let rec take n = function
  | x :: rest when n > 0 -> x :: take (n - 1) rest
  | _ -> []

let read ~chart ~file source =
  let* program = Parse.program ~file source in
  let start = { source; vehicles = []; plans = []; answers = []; replies = []; inputs = []; samples = []; fences = [];
                plans_at = None; begins = None; zone = None; assumptions = [];
                constants = Constants.of_program ~chart ~place:None [];
                unplaced = 0; faults = [] } in
  let state = List.fold_left statement start program in
  let vehicles = List.rev_map (fun { entry; name_at = _ } -> entry) state.vehicles in
  let recurrences, unassumed = recurrences state vehicles in
  let faults =
    repeated "vehicle" (fun (v : vehicle) -> v.id) state.vehicles
    @ repeated "plan" (fun (p : plan) -> p.name) state.plans
    @ repeated "answer" (fun a -> a.prompt) state.answers
    @ repeated "reply" (fun r -> r.call) state.replies
    @ (if state.faults = [] then unmeasured state else [])
    @ unassumed @ state.faults in
  let entries named = List.rev_map (fun { entry; name_at = _ } -> entry) named in
  if faults = [] then
    Ok
      { Entry.vehicles; plans = entries state.plans; answers = entries state.answers;
        replies = entries state.replies; inputs = List.rev state.inputs;
        samples = List.rev state.samples; fences = List.rev state.fences; plans_at = state.plans_at;
        recurrences;
        begins = Option.map (fun t -> { t with Calendar.zone = Option.value state.zone ~default:0 }) state.begins;
        zone = state.zone }
  else Error (take Parse.most_faults (List.sort Diagnostic.compare faults))

let names_at word ~file source =
  let at (s : statement) =
    match s.it with
    | Expression
        { it = Call { callee = { it = Variable word'; _ }; arguments = Positional { it = String name; at } :: _ }; _ }
      when word' = word -> Some (name, at)
    | _ -> None
  in
  match Parse.program ~file source with Ok program -> List.filter_map at program | Error _ -> []

let replies_at = names_at "reply"
