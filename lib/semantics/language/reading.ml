open Core
module Ast = Dolphin_syntax.Ast

type subject = Position | Sensor of sensor

let subject = function
  | "battery" | "getBattery" -> Some (Sensor Battery)
  | "position" | "getPosition" -> Some Position
  | _ -> None

let reading quantity text = Reading { quantity; text }

let name = function
  | Battery -> "battery"
  | Speed -> "speed"
  | Connected -> "connected"
  | Progress -> "progress"
  | Measurement name -> name

let look world subject (s : World.vehicle_state) =
  match subject with
  | Sensor sensor -> (
      match World.sensor world sensor s with
      | None -> Ok (Unknown { sensor = name sensor; of_vehicle = s.id })
      | Some (Shows x) -> Ok x
      | Some (One_of xs) -> Error (World.values sensor s xs)
      | Some Anything -> Ok (reading Amount (World.spell sensor s.id)))
  | Position -> (
      match World.position world s with
      | Shows p -> Ok (Core.Position p)
      | One_of ps -> Error (World.places s ps)
      | Anything -> Ok (reading Place (Printf.sprintf "position(%s)" s.id)))

let of_now = "now()"

let now world : value =
  match World.date world with Exactly n -> Integer n | Since _ | Any -> reading Amount of_now

let of_day = "timeOfDay()"

let time_of_day ~begins world : value option =
  match World.date world, begins with
  | Exactly n, Some begins -> Some (Integer (Calendar.at begins n))
  | Exactly _, None -> None
  | (Since _ | Any), _ -> Some (reading Amount of_day)

let keep (program : program) store =
  let one store (i, x) =
    match x with
    | Reading r when r.text <> program.global_names.(i) ->
      Store.set i (Reading { r with text = program.global_names.(i) }) store
    | _ -> store
  in
  List.fold_left one store (Store.bindings store)

let is_reading = function Reading _ -> true | _ -> false

let unclear at text =
  Fault.make at
    (Printf.sprintf
       "the value of %s is open, and more than a comparison depends on it: a fleet may list the values of batteries, \
        positions and measurements"
       text)

let settled at = function Reading r -> Error (unclear at r.text) | x -> Ok x

type applied = Gives of (value, string) result | Asks of World.question | Unclear of Fault.t | As_any

(* With more comparisons in one step, the outcomes would be too many to list. *)
let most_claims = 12

let spell x = match x with Reading r -> r.text | x -> Format.asprintf "%a" Value.pp (Value.canonical x)

let can_be_spelt = Value.has_at_most Value.most_items

(* As an operand of another operation. *)
let enclosed text = if String.contains text ' ' then "(" ^ text ^ ")" else text

let spell_binary symbol x y = Printf.sprintf "%s %s %s" (enclosed (spell x)) symbol (enclosed (spell y))

let is_amount = function Reading { quantity = Amount; _ } -> true | x -> Value.to_number x <> None
let is_place = function Reading { quantity = Place; _ } | Position _ -> true | _ -> false
let is_region = function Reading { quantity = Region; _ } | Area _ -> true | _ -> false
let is_words = function Reading { quantity = Words; _ } | String _ -> true | _ -> false

let coordinates =
  [ "latitude"; "lat"; "longitude"; "lon"; "height"; "getLatitude"; "getLat"; "getLongitude"; "getLon"; "getHeight" ]

(* Of a number these give a number and never fail: [round] and the like too, whatever a battery or a place shows. *)
let numeric = [ "abs"; "round"; "intValue"; "toInteger"; "doubleValue"; "toDouble" ]
let mathematical = [ "abs"; "round"; "floor"; "ceil"; "min"; "max" ]

let distances = [ "distance"; "distanceTo"; "bearing"; "bearingTo" ]

(* Whether the comparison that [text] spells holds; with [~is:false], whether it does not hold. *)
let claim world at ~is text =
  match World.claim world text with
  | Ok holds -> Gives (Ok (Boolean (holds = is)))
  | Error _ when World.claims world >= most_claims -> Unclear (unclear at text)
  | Error question -> Asks question

(* [x] as a number to compare: the date, if it is certain. *)
let dated ~begins world x =
  match x, World.date world, begins with
  | Reading { quantity = Amount; text }, Since n, _ when String.equal text of_now -> Some (float_of_int n)
  | Reading { quantity = Amount; text }, Since n, Some begins when String.equal text of_day ->
    Some (float_of_int (Calendar.at begins n))
  | x, _, _ -> Value.to_number x

let compared ~begins world (op : Ast.binary) x y =
  match dated ~begins world x, dated ~begins world y with
  | Some a, Some b -> (
      match op with
      | Less -> Some (a < b)
      | Less_equal -> Some (a <= b)
      | Greater -> Some (a > b)
      | Greater_equal -> Some (a >= b)
      | Equal -> Some (a = b)
      | Not_equal -> Some (a <> b)
      | Member_of | Add | Subtract | Multiply | Divide | Around | Remainder | Power | Sequence | Append | Intersect
      | Parallel | And | Or ->
        None)
  | None, _ | _, None -> None

let binary world at (op : Ast.binary) x y =
  let holds symbol = claim world at ~is:true (spell_binary symbol x y) in
  let fails symbol = claim world at ~is:false (spell_binary symbol x y) in
  let computed quantity symbol = Gives (Ok (reading quantity (spell_binary symbol x y))) in
  match op with
  | Less when is_amount x && is_amount y -> holds "<"
  | Greater_equal when is_amount x && is_amount y -> fails "<"
  | Greater when is_amount x && is_amount y -> holds ">"
  | Less_equal when is_amount x && is_amount y -> fails ">"
  | Equal when can_be_spelt x && can_be_spelt y -> holds "=="
  | Not_equal when can_be_spelt x && can_be_spelt y -> fails "=="
  | Member_of when is_place x && is_region y -> holds "in"
  | Add when is_words x || is_words y -> Gives (Ok (reading Words (Value.to_string x ^ Value.to_string y)))
  | Add when is_amount x && is_amount y -> computed Amount "+"
  | Subtract when is_amount x && is_amount y -> computed Amount "-"
  | Multiply when is_amount x && is_amount y -> computed Amount "*"
  | Divide when is_amount x && Value.to_number y = Some 0. -> Gives (Error "division by zero")
  | Divide when is_amount x && Value.to_number y <> None -> computed Amount "/"
  | Around when is_place x && (match Value.to_number y with Some r -> r >= 0. | None -> false) -> computed Region "^"
  | Less | Less_equal | Greater | Greater_equal | Equal | Not_equal | Member_of | Add | Subtract | Multiply | Divide
  | Around | Remainder | Power | Sequence | Append | Intersect | Parallel | And | Or -> As_any

let method_call world at name arguments =
  match arguments with
  | [ x ] when is_place x && List.mem name coordinates ->
    Gives (Ok (reading Amount (Printf.sprintf "%s.%s" (spell x) name)))
  | [ x ] when is_amount x && List.mem name numeric ->
    Gives (Ok (reading Amount (Printf.sprintf "%s.%s()" (enclosed (spell x)) name)))
  | [ x; Integer digits ] when is_amount x && name = "round" ->
    Gives (Ok (reading Amount (Printf.sprintf "%s.round(%d)" (enclosed (spell x)) digits)))
  | [ x; y ] when is_place x && is_place y && List.mem name distances ->
    Gives (Ok (reading Amount (Printf.sprintf "%s.%s(%s)" (spell x) name (spell y))))
  | [ Task (Platform p); x ] when name = "rest" && is_amount x -> Gives (Rest.from_reading p)
  | [ x; y ] when name = "contains" -> binary world at Member_of y x
  | [ x; y ] when name = "equals" -> binary world at Equal x y
  | _ -> As_any

let calls_code = function Closure _ :: _ -> true | _ -> false

let apply ~begins world at operation arguments =
  let result =
    match operation, arguments with
    | Binary op, [ x; y ] -> (
        match compared ~begins world op x y with
        | Some holds -> Gives (Ok (Boolean holds))
        | None -> binary world at op x y)
    | Unary Negate, [ Reading { quantity = Amount; text } ] -> Gives (Ok (reading Amount ("-" ^ enclosed text)))
    | Concatenate, parts -> Gives (Ok (reading Words (String.concat "" (List.map Value.to_string parts))))
    | Builtin (Math name), xs when List.mem name mathematical && List.for_all is_amount xs ->
      Gives (Ok (reading Amount (Printf.sprintf "Math.%s(%s)" name (String.concat ", " (List.map spell xs)))))
    | Property name, [ x ] when is_place x -> method_call world at name [ x ]
    | Method (name, names), arguments when List.for_all Option.is_none names -> method_call world at name arguments
    | _, _ -> As_any
  in
  match result, operation with
  | (Gives _ | Asks _ | Unclear _), _ -> result
  | As_any, Call names when List.for_all Option.is_none names && calls_code arguments -> As_any
  | As_any, Builtin (Message | Halt | Assert | Fail | Is_a _ | Is_host | Is_there) -> As_any
  | As_any, _ ->
    let texts = List.filter_map (function Reading r -> Some r.text | _ -> None) arguments in
    Unclear (unclear at (String.concat ", " texts))
