type kind = Any | Number | String | Truth | Closure | Task | Vehicles | Position | Other

let describe = function
  | Any | Other -> "a value"
  | Number -> "a number"
  | String -> "a string"
  | Truth -> "a truth value"
  | Closure -> "code { ... }"
  | Task -> "a task"
  | Vehicles -> "a vehicle set"
  | Position -> "a position"

type pairs = Post | Consume | Poll | Count

type arguments =
  | These of { required : kind list; optional : kind list; operation : Core.builtin }
  | Text_or of { required : kind list; optional : kind list; operation : Core.builtin }
  | Geometry of { required : kind list; named : (string * kind) list; needed : string list }
  | Pairs of pairs
  | Execute
  | Set_connection_timeout
  | Confirm
  | Input
  | On_interrupt
  | Assert
  | Fresh

type place = Anywhere | Script_only | Handler_only | In_handler
type t = { arguments : arguments; place : place; result : kind; reads_sensors : bool }

let these ?(place = Anywhere) ?(result = Any) ?(optional = []) ?(reads_sensors = false) operation required =
  { arguments = These { required; optional; operation }; place; result; reads_sensors }

let other ?(place = Anywhere) arguments = { arguments; place; result = Other; reads_sensors = false }

let location =
  let arguments = Text_or { required = [ Number; Number ]; optional = [ Number ]; operation = Location_of } in
  { arguments; place = Anywhere; result = Position; reads_sensors = false }

let geometry ?(named = []) ?(needed = []) ~result required =
  { arguments = Geometry { required; named; needed }; place = Anywhere; result; reads_sensors = false }

let table : (string * t) list =
  [ ("task", these Platform_task [ String ] ~result:Task);
    ("imcPlan", these Platform_task [ String ] ~result:Task);
    ("action", these Make_action [ Closure ] ~result:Task);
    ("condition", these Make_condition [ Closure ] ~result:Task);
    ("idle", these Make_idle [ Number ] ~result:Any);
    ("fresh", { (other Fresh) with result = Task });
    ("assert", { (other Assert) with result = Task });
    ("execute", other Execute ~place:Script_only);
    ("release", these Release [ Vehicles ] ~place:Script_only ~result:Other);
    ("setConnectionTimeout", other Set_connection_timeout);
    ("ask", these Ask [ String ] ~place:Script_only);
    ("confirm", { (other Confirm ~place:Script_only) with result = Any });
    ("input", other Input);
    ("onInterrupt", other On_interrupt);
    ("message", these Message [ Any ] ~result:Other);
    ("println", these Message [ Any ] ~result:Other);
    ("pause", these Pause [ Number ] ~place:Script_only ~result:Other);
    ("halt", these Halt [] ~optional:[ Any ] ~result:Other);
    ("post", other (Pairs Post));
    ("consume", { (other (Pairs Consume)) with result = Truth });
    ("poll", { (other (Pairs Poll)) with result = Truth });
    ("position", these Position_of [ Vehicles ] ~result:Position ~reads_sensors:true);
    ("battery", these (Sensor_of Battery) [ Vehicles ] ~result:Number ~reads_sensors:true);
    ("speed", these (Sensor_of Speed) [ Vehicles ] ~result:Number ~reads_sensors:true);
    ("progress", these (Sensor_of Progress) [ Vehicles ] ~result:Number ~reads_sensors:true);
    ("connected", these (Sensor_of Connected) [ Vehicles ] ~result:Truth ~reads_sensors:true);
    ("running", these Is_running [ Vehicles ] ~result:Truth);
    ("reading", these Reading_of [ Vehicles; String ] ~result:Number ~reads_sensors:true);
    ("now", these Now [] ~result:Number);
    ("timeOfDay", these Time_of_day [] ~optional:[ String ] ~result:Number);
    ("eta", these Eta [ Vehicles; Position ] ~result:Number ~reads_sensors:true);
    ("isNumber", these (Is_a A_number) [ Any ] ~result:Truth);
    ("isString", these (Is_a A_string) [ Any ] ~result:Truth);
    ("isList", these (Is_a A_list) [ Any ] ~result:Truth);
    ("isMap", these (Is_a A_map) [ Any ] ~result:Truth);
    ("location", location);
    ("area", these Area_of [ Position; Number ]);
    ("polygon", geometry [ Any ] ~named:[ ("holes", Any) ] ~result:Any);
    ("corridor", geometry [ Any; Number ] ~result:Any);
    ("along", geometry [ Any; Number ] ~result:Position);
    ( "coverage",
      geometry [ Any ] ~needed:[ "spacing" ]
        ~named:[ ("spacing", Number); ("bearing", Number); ("overlap", Number); ("turn", Number) ]
        ~result:Any );
    ( "expandingSquare",
      geometry [ Position ] ~needed:[ "spacing"; "radius" ]
        ~named:[ ("spacing", Number); ("radius", Number); ("bearing", Number) ]
        ~result:Any );
    ( "sector",
      geometry [ Position ] ~needed:[ "radius" ] ~named:[ ("radius", Number); ("bearing", Number) ] ~result:Any );
    ( "spiral",
      geometry [ Position ] ~needed:[ "spacing"; "radius" ]
        ~named:[ ("spacing", Number); ("radius", Number); ("bearing", Number) ]
        ~result:Any );
    ( "footprint",
      geometry [] ~needed:[ "altitude" ] ~named:[ ("altitude", Number); ("range", Number); ("angle", Number) ]
        ~result:Number );
    ("fail", these Fail [ Any ] ~result:Other);
    ("ignore", these Ignore [] ~place:Handler_only ~result:Other);
    ("propagate", these Propagate [] ~place:Handler_only ~result:Other);
    ("retry", these Retry [] ~place:In_handler ~result:Other);
    ("dismiss", these Dismiss [ Vehicles ] ~place:In_handler ~result:Other);
    ("getSupplier", these Get_supplier [] ~place:Script_only) ]

module String_map = Map.Make (String)

let by_name = String_map.of_seq (List.to_seq table)
let find name = String_map.find_opt name by_name
let names = List.map fst table

let is_of_script name =
  match find name with Some { place = Script_only; _ } -> true | Some _ | None -> false

let is_deed name =
  match find name with
  | Some { place = Anywhere; result = Other | Truth; _ } -> true
  | Some _ | None -> false

let is_geometry name =
  match find name with
  | Some { arguments = Geometry _; _ } -> true
  | Some _ | None -> false

(* Operations that may not stand in code that only computes, and may in that of other tasks. *)
let changes name = List.mem name [ "post"; "consume"; "message"; "println"; "setConnectionTimeout"; "halt" ]

let math_names =
  [ "abs"; "max"; "min"; "round"; "floor"; "ceil"; "sqrt"; "exp"; "log"; "log10"; "sin"; "cos"; "tan"; "asin"; "acos";
    "atan"; "atan2"; "pow"; "hypot"; "toRadians"; "toDegrees"; "signum" ]

let math name = List.mem name math_names

let units = Plan_builder.units

let table_of_constants : (string * Core.value) list =
  [ ("Math.PI", Core.Number Float.pi); ("Math.E", Number (Float.exp 1.)) ]
  @ List.map (fun (name, p) -> ("Location." ^ name, Core.Position p)) Dolphin_geo.Place.all
  @ List.map (fun unit -> (unit, Core.Symbol unit)) units

let owners = [ "Location"; "Math"; "Speed"; "Z" ]

let takes_nothing name =
  match find name with Some { arguments = These { required = []; _ }; _ } -> true | Some _ | None -> false

(* The parentheses of a call [position(v)] distinguish it from a variable [position]; [message x] needs none. *)
let is_reserved name =
  List.mem name owners || match find name with Some { result = Other; _ } -> true | Some _ | None -> false

let constant name = List.assoc_opt name table_of_constants
let constants = List.map fst table_of_constants
let builders =
  [ ("pick", "type 'UUV'"); ("pos", "lat 41.18; lon 8.7.west"); ("imcPlan", "goTo()"); ("mission", "goPos p");
    ("allOf", "when { condition } then task"); ("oneOf", "when { condition } then task");
    ("choose", "when { condition } then task") ]

let builder_names = List.map fst builders

let example_of_builder name =
  Option.map (fun inside -> Printf.sprintf "%s { %s }" name inside) (List.assoc_opt name builders)

let settings : Dolphin_syntax.Ast.builder -> string list = function
  | Pick -> [ "id"; "type"; "payload"; "region"; "count"; "timeout" ]
  | Recruit -> [ "id"; "type"; "payload"; "region" ]
  | Pos -> [ "lat"; "latitude"; "lon"; "longitude"; "height"; "hae" ]
  | Imc_plan -> List.map fst Plan_builder.vocabulary
  | Mission -> List.map fst Mission_builder.vocabulary
  | All_of | One_of -> []
