open Dolphin_plans
open Dolphin_semantics
open Core
module Diagnostic = Dolphin_syntax.Diagnostic
module Location = Dolphin_syntax.Location
module Ast = Dolphin_syntax.Ast
module Position = Dolphin_geo.Position
module Wgs84 = Dolphin_geo.Wgs84

type t = {
  program : program;
  world : World.t;
  describes_plans : bool;  (* by settings, not by name *)
  places : Places.t;
  vehicles_at : Position.t list;  (* possible places of vehicles: the first of [places] *)
  nodes : (int, Tla.t * site) Hashtbl.t;
  mutable lambdas : (lambda * int * Tla.t) list;  (* latest first *)
  mutable plans : Tla.t list;  (* latest first *)
  mutable reads_position : bool;
  mutable sensors : sensor list;  (* that code reads *)
  mutable refusals : Diagnostic.t list;
}

(* Everywhere where a vehicle may be. *)
let whereabouts world =
  List.concat_map (World.places_of world) (World.vehicles world)

let describes_plans program =
  let found = ref false in
  let look (e : expression) =
    match e.node with Apply (Build ((Imc_plan | Mission), _), _) -> found := true | _ -> ()
  in
  Code_walk.iter look (Code_walk.pieces program);
  !found

let create program world =
  let places = Places.create () in
  List.iter (fun p -> ignore (Places.index places p : int)) (whereabouts world);
  { program; world; describes_plans = describes_plans program; places; vehicles_at = Places.positions places;
    nodes = Hashtbl.create 1000; lambdas = []; plans = []; reads_position = false; sensors = []; refusals = [] }

let place t p = Places.index t.places p
let reads_position t = t.reads_position
let sensors t = List.rev t.sensors

let name_of_sensor = function
  | Battery -> "battery"
  | Speed -> "speed"
  | Connected -> "connected"
  | Progress -> "progress"
  | Measurement name -> "reading " ^ name

let location t site =
  if 0 <= site && site < Array.length t.program.locations then Some t.program.locations.(site) else None

let refuse t ?hint site format =
  let at = Option.value (location t site) ~default:Location.none in
  Format.kasprintf
    (fun message -> t.refusals <- Diagnostic.error ?hint at ("cannot be translated to TLA+: " ^ message) :: t.refusals)
    format

let refusals t = List.sort_uniq Diagnostic.compare t.refusals
(* The code at [site] looks at [sensor]. *)
let note_sensor t site sensor =
  if not (List.mem sensor t.sensors) then t.sensors <- sensor :: t.sensors;
  let is_unknown (s : World.vehicle_state) = World.sensor t.world sensor s = None in
  match List.find_opt is_unknown (World.vehicles t.world) with
  | Some s ->
    refuse t site "the %s of %s is unknown in this fleet: the models have no unknown values"
      (name_of_sensor sensor) s.id
  | None -> ()

(* The same at the property or method [name] of a vehicle, if it is a sensor. *)
let note_member t site name =
  match Reading.subject name with
  | Some (Sensor sensor) -> note_sensor t site sensor
  | Some Position -> t.reads_position <- true
  | None -> ()

(* Or at the readings of its argument. *)
let note_reading t site = function
  | [ _; { node = Constant (String name); _ } ] -> note_sensor t site (Measurement name)
  | _ ->
    refuse t site "a reading whose name is not a text of the program"
      ~hint:"write the name where it is read, as in reading(v, 'Temperature')"

let numbers ints = Tla.Tuple (List.map (fun i -> Tla.Integer i) ints)

(* {1 Values} *)

let tagged tag rest = Tla.Tuple (Tla.String tag :: rest)

let integer t site i =
  if i < Tla.least || i > Tla.greatest then
    refuse t site "%d is beyond TLC's whole numbers, which have 32 bits" i;
  Tla.Integer i

(* Platform tasks are those that are made at [at]. *)
let rec value ?at t site x =
  let both tag (a, b) = tagged tag [ Tla.Integer a; Tla.Integer b ] in
  match x with
  | Null -> tagged "null" []
  | Boolean b -> tagged "boolean" [ Boolean b ]
  | Integer i -> tagged "integer" [ integer t site i ]
  | Number n -> both "number" (fraction t site n)
  | String s -> tagged "string" [ String s ]
  | Wildcard -> tagged "wildcard" []
  | Symbol s -> tagged "symbol" [ String s ]
  | List xs -> tagged "list" [ Tuple (List.map (value ?at t site) (Vector.to_list xs)) ]
  | Map entries ->
    tagged "map" [ Tuple (List.map (fun (k, x) -> Tla.Tuple [ String k; value ?at t site x ]) entries) ]
  | Range (a, b) -> both "range" (a, b)
  | Position p -> tagged "position" [ Integer (place t p) ]
  | Area (Circle { centre; radius }) ->
    let n, d = fraction t site radius in
    tagged "area" [ Integer (place t centre); Integer n; Integer d ]
  | Area (Shape _ as shape) ->
    tagged "area" [ Integer (Places.index_of_shape t.places shape); Integer (-1); Integer 1 ]
  | Vehicles vs -> tagged "vehicles" [ Tla.strings vs ]
  | Settings [] -> tagged "settings" [ Tuple [] ]
  | Closure { lambda = l; captured } ->
    let captured = List.map (value t site) (Array.to_list captured) in
    tagged "closure" [ Integer (lambda t l); Tuple captured ]
  | Host name -> tagged "host" [ String name ]
  | Task task -> (
      match task, at with
      | Platform { name; plan = None; _ }, Some at ->
        let of_task = [ ("name", Tla.String name); ("plan", Tla.Integer 0); ("at", at) ] in
        tagged "task" [ Record (("op", String "platform") :: of_task) ]
      | _, _ -> constant_refused t site x)
  | Settings _ | Reading _ | Unknown _ -> constant_refused t site x

and constant_refused t site x =
  refuse t site "%s as a constant" (Value.kind x);
  tagged "null" []

and fraction t site n =
  match Fraction.of_float n with
  | Some fraction -> fraction
  | None ->
    refuse t site "the number %g: TLC's whole numbers, which have 32 bits, cannot hold it as a fraction" n;
    (0, 1)

(* [position(...)] where no position is known. *)
and is_open_position t (e : expression) =
  let is_open s = World.position t.world s = Anything in
  match e.node with
  | Apply (Builtin Position_of, _) -> List.for_all is_open (World.vehicles t.world)
  | _ -> false

(* {1 Operations} *)

and sign : Ast.binary -> string = function
  | Divide -> "/" | Multiply -> "*" | Remainder -> "%" | Power -> "**" | Add -> "+" | Subtract -> "-"
  | Sequence -> ">>" | Append -> "<<" | Less -> "<" | Less_equal -> "<=" | Greater -> ">" | Greater_equal -> ">="
  | Equal -> "==" | Not_equal -> "!=" | Member_of -> "in" | Intersect -> "&" | Around -> "^" | Parallel -> "|"
  | And -> "&&" | Or -> "||"

and names options = Tla.strings (List.map (Option.value ~default:"") options)

(* [known] is whether its operands may be values other than readings. *)
and operation t ~known site op : Tla.t =
  let record name fields = Tla.Record (("op", Tla.String name) :: fields) in
  let named op name names' = record op [ ("name", Tla.String name); ("names", names names') ] in
  match op with
  | Unary Not -> record "unary" [ ("sign", String "!") ]
  | Unary Negate -> record "unary" [ ("sign", String "-") ]
  | Binary op -> record "binary" [ ("sign", String (sign op)) ]
  | Make_list -> record "list" []
  | Make_map keys ->
    let key = function Some k -> Tla.Tuple [ Tla.String k ] | None -> Tla.Tuple [] in
    record "map" [ ("keys", Tuple (List.map key keys)) ]
  | Make_range inclusive -> record "range" [ ("inclusive", Boolean inclusive) ]
  | Concatenate -> record "concatenate" []
  | Element -> record "element" []
  | Replace_element -> record "replaceElement" []
  | Replace_member k -> record "replaceMember" [ ("name", String k) ]
  | Property "length" | Method (("length" | "getLength"), _) when t.describes_plans ->
    refuse t site "length, which may be that of a plan: TLA+ has whole numbers only"
      ~hint:"the number of elements is size()";
    record "list" []
  | Property name ->
    if Supported.is_refused_property name && (known || not (Supported.is_for_readings name)) then
      refuse t site "'.%s' of a value that is not a constant: TLA+ has no such numbers" name;
    note_member t site name;
    record "property" [ ("name", String name) ]
  | Call names' -> record "call" [ ("names", names names') ]
  | Method (("duration" | "energy" | "rest") as name, _) ->
    refuse t site "the %s of a plan: TLA+ has whole numbers only" name;
    record "list" []
  | Method (name, names') ->
    if Supported.is_refused_method name && (known || not (Supported.is_for_readings name)) then
      refuse t site "the method '%s'" name;
    note_member t site name;
    named "method" name names'
  | Add_setting (name, names') -> named "setting" name names'
  | Make_branch -> record "branch" []
  | Build (Pick, _) -> record "build" [ ("builder", String "pick") ]
  | Pick_if_any -> record "build" [ ("builder", String "pick if any") ]
  | Build (All_of, _) -> record "build" [ ("builder", String "allOf") ]
  | Build (One_of, _) -> record "build" [ ("builder", String "oneOf") ]
  | Make_recruit -> record "recruit" []
  | Build ((Pos | Imc_plan | Mission | Recruit), _) ->
    refuse t site "a position or plan whose settings are not constants"
      ~hint:"the translator computes it once, so its settings may not depend on variables";
    record "list" []
  | Builtin builtin -> procedure t site builtin

and procedure t site builtin : Tla.t =
  let record name fields = Tla.Record (("op", Tla.String name) :: fields) in
  let plain name = record name [] in
  let keyed name keys =
    let key = function Some k -> Tla.Tuple [ Tla.String k ] | None -> Tla.Tuple [] in
    record name [ ("keys", Tuple (List.map key keys)) ]
  in
  let ensured_form : ensured_form -> Tla.t = function
    | Pair_of (Some k) -> record "post" [ ("key", Tla.Tuple [ Tla.String k ]) ]
    | Pair_of None -> record "post" [ ("key", Tla.Tuple []) ]
    | Variable_of (i, name) -> record "set" [ ("global", Integer (i + 1)); ("name", String name) ]
    | Taken_pairs -> plain "giveBack"
  in
  match builtin with
  | Platform_task -> plain "task"
  | Make_action -> plain "action"
  | Make_condition -> plain "condition"
  | Make_wait_for -> plain "waitFor"
  | Make_until Completes -> plain "until"
  | Make_until Fails -> plain "assure"
  | Make_idle -> plain "idle"
  | Make_confirm -> plain "confirm"
  | Make_during Completes -> plain "during"
  | Make_during Fails -> plain "within"
  | Make_watch -> plain "watch"
  | Make_fresh -> plain "fresh"
  | Make_ensure forms -> record "ensure" [ ("forms", Tuple (List.map ensured_form forms)) ]
  | Make_repeat { counted; asked } -> record "repeat" [ ("counted", Boolean counted); ("asked", Boolean asked) ]
  | Execute -> plain "execute"
  | Execute_for vehicles -> record "executeFor" [ ("names", Tla.strings vehicles) ]
  | Release -> plain "release"
  | Set_connection_timeout -> plain "setConnectionTimeout"
  | Ask -> plain "ask"
  | Message -> plain "message"
  | Pause -> plain "pause"
  | Halt -> plain "halt"
  | Post keys -> keyed "post" keys
  | Consume keys -> keyed "consume" keys
  | Poll keys -> keyed "poll" keys
  | Values_of -> plain "valuesOf"
  | Position_of -> t.reads_position <- true; plain "position"
  | Sensor_of sensor ->
    note_sensor t site sensor;
    record "sensor" [ ("name", String (name_of_sensor sensor)) ]
  | Now -> plain "now"
  | Time_of_day ->
    let begins = Option.to_list t.program.begins in
    record "timeOfDay" [ ("begins", Tuple (List.map (fun (b : Calendar.t) -> Tla.Integer b.second) begins)) ]
  | Is_running -> plain "running"
  | Reading_of -> plain "reading"
  | Eta -> refuse t site "eta: TLA+ has whole numbers only"; plain "list"
  | Area_of -> plain "area"
  | Assert -> plain "assert"
  | Fail -> plain "fail"
  | Ignore -> plain "ignore"
  | Propagate -> plain "propagate"
  | Retry -> plain "retry"
  | Dismiss -> plain "dismiss"
  | Is_there -> plain "isThere"
  | Is_a form ->
    let form =
      match form with A_number -> "number" | A_string -> "string" | A_list -> "list" | A_map -> "map" in
    record "isA" [ ("form", String form) ]
  | Is_host -> plain "isHost"
  | Math name ->
    if not (Supported.is_mathematics name) then
      refuse t site "Math.%s of a value that is not a constant: TLA+ has whole numbers only" name;
    record "math" [ ("name", String name) ]
  | Location_of ->
    refuse t site "a location whose coordinates are not constants"
      ~hint:"the translator computes distances, so it must know the coordinates";
    plain "list"
  | Geometry (name, _) ->
    refuse t site "%s of values that are not constants: TLA+ has whole numbers only" name
      ~hint:"the translator computes it once, so what it is of may not depend on variables";
    plain "list"
  | Get_supplier -> plain "getSupplier"
  | Interrupted -> plain "interrupted"

(* {1 Expressions} *)

and reserve t site =
  let n = Hashtbl.length t.nodes + 1 in
  Hashtbl.add t.nodes n (Tla.Tuple [], site);
  n

and define t n site is fields =
  Hashtbl.replace t.nodes n (Tla.Record (("is", Tla.String is) :: fields), site);
  n

and expression t (e : expression) =
  match e.node with
  | Block [ start; body; { node = Apply (Build (((Imc_plan | Mission) as builder), name), [ _ ]); site } ] ->
    plan t e.site builder start body name site
  | Block [ _; _; { node = Apply (Build (Pos, _), _); _ } ]
  | Apply (Builtin (Location_of | Area_of | Math _ | Geometry _), _)
  | Apply (Builtin Time_of_day, [ _ ])
    when Constant.is_closed e -> folded t e
  | Apply (Property name, _) when Supported.is_refused_property name && Constant.is_closed e -> folded t e
  | Apply (Builtin Time_of_day, [ _ ]) ->
    refuse t e.site "timeOfDay of a text that is not a constant: TLA+ does not read texts"
      ~hint:"the translator computes it once, so the text may not be a variable";
    unfolded t e
  | _ -> unfolded t e

and folded t (e : expression) =
  let n = reserve t e.site in
  match Constant.value t.program t.world e with
  | Ok x -> define t n e.site "constant" [ ("value", value t e.site x) ]
  | Error fault ->
    refuse t e.site "it has no value: %s" fault.message;
    n

and unfolded t (e : expression) =
  let n = reserve t e.site in
  let define is fields = define t n e.site is fields in
  let part e = Tla.Integer (expression t e) in
  let parts es = Tla.Tuple (List.map part es) in
  let slot i = ("slot", Tla.Integer (i + 1)) and global i = ("global", Tla.Integer (i + 1)) in
  match e.node with
  | Constant x -> define "constant" [ ("value", value t e.site x) ]
  | Local i -> define "local" [ slot i ]
  | Global i -> define "global" [ global i ]
  | Set_local (i, e) -> define "setLocal" [ slot i; ("value", part e) ]
  | Set_global (i, e) -> define "setGlobal" [ global i; ("value", part e) ]
  | Apply (op, arguments) ->
    (match op with Builtin Reading_of -> note_reading t e.site arguments | _ -> ());
    let known = match arguments with subject :: _ -> not (is_open_position t subject) | [] -> true in
    let op = operation t ~known e.site op in
    define "apply" [ ("operation", op); ("arguments", parts arguments) ]
  | Make_closure (l, captured) ->
    let l = lambda t l in
    define "closure" [ ("lambda", Integer l); ("slots", numbers (List.map succ captured)) ]
  | If (test, yes, no) ->
    let test = part test in
    let yes = part yes in
    define "if" [ ("test", test); ("yes", yes); ("no", part no) ]
  | Block es -> define "block" [ ("parts", parts es) ]
  | While (test, body) ->
    let test = part test in
    define "while" [ ("test", test); ("body", part body) ]
  | For (i, range, body) ->
    let range = part range in
    define "for" [ slot i; ("range", range); ("body", part body) ]
  | Return e -> define "return" [ ("value", part e) ]
  | Break -> define "break" []
  | Continue -> define "continue" []

(* {1 Inline plans} *)

(* A plan is built once, here, so all its settings but the name must be constants. Of the lines of the block only
   planName is left to the program; the others are kept without their arguments. *)
and plan t site builder start body default build_site =
  let n = reserve t site in
  let settings = ref [] in
  let setting (s : setting) = settings := s :: !settings in
  let start = expression t start in
  let body = plan_lines t setting body in
  let number = plan_number t builder build_site (List.rev !settings) in
  let slot =
    match Hashtbl.find t.nodes start with
    | Tla.Record fields, _ -> List.assoc "slot" fields
    | _, _ -> Tla.Integer 1
  in
  let local = reserve t build_site in
  let local = define t local build_site "local" [ ("slot", slot) ] in
  let op =
    Tla.Record
      [ ("op", String "build"); ("builder", String "imcPlan"); ("name", String default); ("plan", Integer number) ]
  in
  let build = reserve t build_site in
  let build = define t build build_site "apply" [ ("operation", op); ("arguments", numbers [ local ]) ] in
  define t n site "block" [ ("parts", numbers [ start; body; build ]) ]

and plan_lines t setting (e : expression) =
  match e.node with
  | Block es ->
    let n = reserve t e.site in
    define t n e.site "block" [ ("parts", numbers (List.map (plan_lines t setting) es)) ]
  | Set_local (_, { node = Apply (Add_setting ("planName", _), _); _ }) | Constant Null -> unfolded t e
  | Set_local (slot, ({ node = Apply (Add_setting (name, names), so_far :: arguments); site } as line)) ->
    Option.iter setting (constant_setting t line site name names arguments);
    let empty = { line with node = Apply (Add_setting (name, []), [ so_far ]) } in
    unfolded t { e with node = Set_local (slot, empty) }
  | _ ->
    refuse t e.site "an inline plan with code among its settings"
      ~hint:"the translator computes plans once, so their settings must be there in any case";
    reserve t e.site

and constant_setting t line site name names arguments =
  let known = List.for_all Constant.is_closed arguments in
  if not known then begin
    refuse t line.site "'%s' of an inline plan depends on computed values" name
      ~hint:"of an inline plan, only planName may do so";
    None
  end
  else
    let values = List.map (Constant.value t.program t.world) arguments in
    match List.find_opt Result.is_error values with
    | Some (Error fault) -> refuse t line.site "'%s' has no value: %s" name fault.message; None
    | Some (Ok _) | None ->
      let all = List.combine names (List.filter_map Result.to_option values) in
      let positional = List.filter_map (function None, x -> Some x | Some _, _ -> None) all in
      let named = List.filter_map (function Some k, x -> Some (k, x) | None, _ -> None) all in
      Some { setting = name; positional; named; setting_site = site }

and plan_number t builder site settings =
  let built =
    match (builder : Dolphin_syntax.Ast.builder) with
    | Mission -> Result.map (fun m -> Inline_plan.Mission m) (Mission_builder.build ~name:"plan" site settings)
    | Imc_plan | Pick | Recruit | Pos | All_of | One_of ->
      Result.map (fun p -> Inline_plan.Maneuvers p) 
        (Plan_builder.build ~name:"plan" ~place:t.program.place site settings)
  in
  match built with
  | Error fault -> refuse t site "this plan cannot be built: %s" fault.message; 0
  | Ok plan ->
    let reference = Option.map Wgs84.cartesian (Inline_plan.reference plan) in
    let metres p = Option.fold ~none:0. ~some:(Wgs84.straight (Wgs84.cartesian p)) reference in
    let millimetres p = Float.round (1000. *. metres p) in
    let ways = List.map millimetres t.vehicles_at in
    let nearest = List.fold_left Float.min infinity ways in
    let farther way = Tla.Integer (int_of_float (Float.min (way -. nearest) (float_of_int (Tla.greatest / 1000)))) in
    let facts =
      [ ("devices", Tla.strings (Inline_plan.required_payload plan));
        ("vehicles", Tla.strings (Inline_plan.vehicles plan));
        ("farther", Tla.Tuple (List.map farther ways)) ]
    in
    t.plans <- Record facts :: t.plans;
    List.length t.plans

(* {1 Closures} *)

and lambda t (l : lambda) =
  match List.find_opt (fun (l', _, _) -> l == l') t.lambdas with
  | Some (_, n, _) -> n
  | None ->
    let n = List.length t.lambdas + 1 in
    (* A function may refer to itself, so it has its number before its code is translated. *)
    t.lambdas <- (l, n, Tla.Tuple []) :: t.lambdas;
    let code = expression t l.code in
    let fields =
      [ ("label", Tla.String l.label); ("parameters", Tla.Integer l.parameters); ("implicit", Tla.Boolean l.implicit);
        ("captures", numbers (List.map succ (Array.to_list l.captures))); ("slots", Integer l.slots);
        ("recovers", Tla.Boolean (Recovery.possible l));
        ("code", Integer code) ]
    in
    t.lambdas <- List.map (fun (l', n', x) -> if n' = n then (l', n, Tla.Record fields) else (l', n', x)) t.lambdas;
    n

let reply t ~at x = value ~at t Fault.unknown_site x

(* {1 The tables} *)

let code t =
  List.map
    (fun i -> let node, site = Hashtbl.find t.nodes (i + 1) in (node, location t site))
    (List.init (Hashtbl.length t.nodes) Fun.id)

let lambdas t = List.rev_map (fun (l, _, record) -> (record, location t l.lambda_site)) t.lambdas
let lambda_names t = Tla.strings (List.rev_map (fun (l, _, _) -> l.label) t.lambdas)
let plans t = Tla.Tuple (List.rev t.plans)
let places t = Places.texts t.places
let distances t = Places.distances t.places
