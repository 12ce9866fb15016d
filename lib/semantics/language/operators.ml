open Core
module Ast = Dolphin_syntax.Ast

let instead_of what x =
  let found =
    match x with
    | x when not (Value.has_at_most 60 x) -> Value.kind x
    | Null | Closure _ | Settings _ | Reading _ | Unknown _ -> Value.kind x
    | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | List _ | Map _ | Range _ | Position _
    | Area _ | Vehicles _ | Task _ | Host _ ->
      if String.length (Value.to_string x) > 60 then Value.kind x
      else Format.asprintf "%s, %a" (Value.kind x) Value.pp x
  in
  Printf.sprintf "expected %s, found %s" what found

let expected what x = Error (instead_of what x)

let symbol : Ast.binary -> string = function
  | Divide -> "/" | Multiply -> "*" | Remainder -> "%" | Power -> "**" | Add -> "+" | Subtract -> "-"
  | Sequence -> ">>" | Append -> "<<" | Less -> "<" | Less_equal -> "<=" | Greater -> ">" | Greater_equal -> ">="
  | Equal -> "==" | Not_equal -> "!=" | Member_of -> "in" | Intersect -> "&" | Around -> "^" | Parallel -> "|"
  | And -> "&&" | Or -> "||"

let takes : Ast.binary -> string = function
  | Divide -> "two numbers, or a task and a condition { ... }"
  | Multiply | Remainder | Power -> "two numbers"
  | Add -> "numbers, strings, lists, maps, areas or vehicle sets"
  | Subtract -> "numbers, lists, areas or vehicle sets"
  | Sequence -> "two tasks"
  | Append -> "a list and an element"
  | Less | Less_equal | Greater | Greater_equal -> "two numbers or two strings"
  | Member_of -> "a value, and a list, range, map, string, area or vehicle set"
  | Intersect -> "two vehicle sets or two areas"
  | Around -> "a position and a radius in metres"
  | Parallel -> "two tasks, or a vehicle set and a predicate { v -> ... }"
  | Equal | Not_equal | And | Or -> "two values"

let mismatch op x y =
  Error
    (Printf.sprintf "%s takes %s, not %s and %s" (symbol op) (takes op) (Value.kind x) (Value.kind y))

let unary (op : Ast.unary) x =
  match op, x with
  | Not, x -> Ok (Boolean (not (Value.truth x)))
  | Negate, Integer i when i <> min_int -> Ok (Integer (-i))
  | Negate, x -> (
      match Value.to_number x with
      | Some n -> Ok (Number (-.n))
      | None -> expected "a number after -" x)

(* Integer operations that leave the integers' range give a float number instead of wrapping around. *)

let add a b =
  let sum = a + b in
  if a >= 0 = (b >= 0) && sum >= 0 <> (a >= 0) then Number (float a +. float b) else Integer sum

let subtract a b =
  let difference = a - b in
  if a >= 0 <> (b >= 0) && difference >= 0 <> (a >= 0) then Number (float a -. float b) else Integer difference

let multiply a b =
  let product = a * b in
  if a <> 0 && (product / a <> b || (a = -1 && b = min_int)) then Number (float a *. float b) else Integer product

let power a b =
  let result = Float.pow a b in
  Number result

let integer_power a b =
  let result = Float.pow (float a) (float b) in
  if b >= 0 && Float.abs result < 0x1p53 then Integer (int_of_float result) else power (float a) (float b)

let union vs ws = vs @ List.filter (fun w -> not (List.mem w vs)) ws
let difference vs ws = List.filter (fun v -> not (List.mem v ws)) vs
let intersection vs ws = List.filter (fun v -> List.mem v ws) vs

let put entries k x =
  if List.mem_assoc k entries then List.map (fun (k', y) -> if k' = k then (k, x) else (k', y)) entries
  else entries @ [ (k, x) ]

let too_large : Value.excess -> string = function
  | Parts ->
    Printf.sprintf "a value of more than %d parts, each counted as often as it stands there, is too large for this"
      Value.most_items
  | Depth -> Printf.sprintf "a value that is nested more than %d deep is too large for this" Value.deepest

let key x =
  match Value.excess ~most:Value.most_items x with
  | Some excess -> Error (too_large excess)
  | None -> Ok (Value.to_string (Value.canonical x))

let member x = function
  | List xs -> Ok (Boolean (Vector.exists (Value.equals x) xs))
  | Range (first, last) -> (
      match Value.canonical_number x with
      | Integer i -> Ok (Boolean (min first last <= i && i <= max first last))
      | _ -> Ok (Boolean false))
  | Map entries -> Result.map (fun k -> Boolean (List.mem_assoc k entries)) (key x)
  | Vehicles vs as whole -> (
      match x with
      | Vehicles ws -> Ok (Boolean (List.for_all (fun w -> List.mem w vs) ws))
      | x -> mismatch Ast.Member_of x whole)
  | Area area as whole -> (
      match x with
      | Position p -> Ok (Boolean (Dolphin_geo.Area.contains area p))
      | x -> mismatch Ast.Member_of x whole)
  | String s as whole -> (
      match x with
      | String part ->
        let n = String.length part in
        let rec at i = i + n <= String.length s && (String.sub s i n = part || at (i + 1)) in
        Ok (Boolean (at 0))
      | x -> mismatch Ast.Member_of x whole)
  | whole -> mismatch Ast.Member_of x whole

let compared (op : Ast.binary) x y =
  let decide order =
    match op with
    | Less -> Ok (Boolean (order < 0))
    | Less_equal -> Ok (Boolean (order <= 0))
    | Greater -> Ok (Boolean (order > 0))
    | Greater_equal -> Ok (Boolean (order >= 0))
    | Divide | Multiply | Remainder | Power | Add | Subtract | Sequence | Append | Equal | Not_equal | Member_of
    | Intersect | Around | Parallel | And | Or -> mismatch op x y
  in
  match x, y with
  | Integer a, Integer b -> decide (Int.compare a b)
  | String a, String b -> decide (String.compare a b)
  | x, y -> (
      match Value.to_number x, Value.to_number y with
      | Some a, Some b -> decide (Float.compare a b)
      | _ -> mismatch op x y)

let arithmetic op on_integers on_numbers x y =
  match x, y with
  | Integer a, Integer b -> Ok (on_integers a b)
  | x, y -> (
      match Value.to_number x, Value.to_number y with
      | Some a, Some b -> Ok (Number (on_numbers a b))
      | _ -> mismatch op x y)

let too_long what = Error (Printf.sprintf "%s of more than %d elements is too long" what Value.most_items)

let concatenate x y =
  let x = Value.to_string x and y = Value.to_string y in
  if String.length x + String.length y > Value.most_items then too_long "a string" else Ok (String (x ^ y))

let join xs ys =
  if Vector.length xs + Vector.length ys > Value.most_items then too_long "a list" else Ok (List (Vector.concat xs ys))

let append xs x =
  if Vector.length xs >= Value.most_items then too_long "a list" else Ok (List (Vector.append xs x))

(* Code in the place of a task is the task that it makes. *)
let as_task = function
  | Task t -> t
  | Closure c -> Made c
  | _ -> invalid_arg "Operators.as_task"

let of_geometry made = Result.map_error (Format.asprintf "%a" Dolphin_geo.Area.pp_error) made
let area made = of_geometry (Result.map (fun area -> Area area) made)

let binary (op : Ast.binary) x y =
  match op, x, y with
  | Add, (String _ as x), y | Add, x, (String _ as y) -> concatenate x y
  | Add, Vehicles vs, Vehicles ws -> Ok (Vehicles (union vs ws))
  | Add, Area a, Area b -> area (Dolphin_geo.Area.union a b)
  | Add, List xs, List ys -> join xs ys
  | Add, List xs, y -> append xs y
  | Add, Map a, Map b -> Ok (Map (List.fold_left (fun entries (k, x) -> put entries k x) a b))
  | Add, x, y -> arithmetic op add ( +. ) x y
  | Subtract, Vehicles vs, Vehicles ws -> Ok (Vehicles (difference vs ws))
  | Subtract, Area a, Area b -> area (Dolphin_geo.Area.difference a b)
  | Subtract, List xs, List ys ->
    let ys = List.fold_left (fun known y -> Equal_values.add y known) Equal_values.empty (Vector.to_list ys) in
    let kept x = not (Equal_values.mem x ys) in
    Ok (List (Vector.of_list (List.filter kept (Vector.to_list xs))))
  | Subtract, x, y -> arithmetic op subtract ( -. ) x y
  | Multiply, x, y -> arithmetic op multiply ( *. ) x y
  | Power, x, y -> arithmetic op integer_power Float.pow x y
  | Divide, Closure t, Closure c -> Ok (Task (Until (Completes Fault.unknown_site, c, Made t)))
  | Divide, Task t, Closure c -> Ok (Task (Until (Completes Fault.unknown_site, c, t)))
  | Divide, x, y -> (
      match x, y, Value.to_number x, Value.to_number y with
      | _, _, Some _, Some 0. -> Error "division by zero"
      | Integer a, Integer b, _, _ when a mod b = 0 && not (a = min_int && b = -1) -> Ok (Integer (a / b))
      | _, _, Some a, Some b -> Ok (Number (a /. b))
      | _, _, _, _ -> mismatch op x y)
  | Remainder, x, y -> (
      match x, y, Value.to_number x, Value.to_number y with
      | _, _, Some _, Some 0. -> Error "remainder of a division by zero"
      | Integer a, Integer b, _, _ -> Ok (Integer (a mod b))
      | _, _, Some a, Some b -> Ok (Number (Float.rem a b))
      | _, _, _, _ -> mismatch op x y)
  | Sequence, ((Task _ | Closure _) as a), ((Task _ | Closure _) as b) -> Ok (Task (Sequence (as_task a, as_task b)))
  | Sequence, x, y -> mismatch op x y
  | Append, List xs, y -> append xs y
  | Append, x, y -> mismatch op x y
  | Parallel, ((Task _ | Closure _) as a), ((Task _ | Closure _) as b) -> Ok (Task (Parallel (as_task a, as_task b)))
  | Parallel, Boolean a, Boolean b -> Ok (Boolean (a || b))
  | Parallel, x, y -> mismatch op x y
  | Intersect, Vehicles vs, Vehicles ws -> Ok (Vehicles (intersection vs ws))
  | Intersect, Area a, Area b -> area (Dolphin_geo.Area.intersection a b)
  | Intersect, Boolean a, Boolean b -> Ok (Boolean (a && b))
  | Intersect, x, y -> mismatch op x y
  | Around, Position centre, y -> (
      match Value.to_number y with
      | None -> mismatch op x y
      | Some radius -> area (Dolphin_geo.Area.circle centre radius))
  | Around, x, y -> mismatch op x y
  | Equal, x, y -> Ok (Boolean (Value.equals x y))
  | Not_equal, x, y -> Ok (Boolean (not (Value.equals x y)))
  | Member_of, x, y -> member x y
  | (Less | Less_equal | Greater | Greater_equal), x, y -> compared op x y
  | And, x, y -> Ok (Boolean (Value.truth x && Value.truth y))
  | Or, x, y -> Ok (Boolean (Value.truth x || Value.truth y))

let index_of length i =
  let i = if i < 0 then length + i else i in
  if 0 <= i && i < length then Some i else None

let indexed x length get i =
  match index_of length i with
  | Some i -> Ok (get i)
  | None -> Error (Printf.sprintf "index %d is out of range: %s has %d elements" i (Value.kind x) length)

let element x i =
  match x, Value.canonical_number i with
  | Task t, Vehicles vs -> Ok (Task (Allocated (t, vs)))
  | Closure c, Vehicles vs -> Ok (Task (Allocated (Made c, vs)))
  | (Task _ | Closure _), i -> expected "a vehicle set between [ and ] after a task" i
  | Map entries, k -> Result.map (fun k -> Option.value (List.assoc_opt k entries) ~default:Null) (key k)
  | Range (first, last), Integer i -> (
      let length = Value.range_length first last in
      match index_of length i with
      | Some i -> Ok (Integer (if first <= last then first + i else first - i))
      | None -> Error (Printf.sprintf "index %d is out of range: a range has %d elements" i length))
  | List xs, Integer i -> indexed x (Vector.length xs) (Vector.get xs) i
  | Vehicles vs, Integer i -> indexed x (List.length vs) (Value.vehicle_at vs) i
  | String _, Integer i -> (
      match Value.items x with
      | None -> expected "a list" x
      | Some items -> indexed x (Array.length items) (Array.get items) i)
  | (List _ | Range _ | Vehicles _ | String _), i -> expected "a whole number as index" i
  | x, _ -> expected "a list, a map or a task before [" x

let replace_element x i y =
  match x, Value.canonical_number i with
  | List xs, Integer i -> (
      match index_of (Vector.length xs) i with
      | Some i -> Ok (List (Vector.set xs i y))
      | None when i = Vector.length xs -> Ok (List (Vector.append xs y))
      | None -> Error (Printf.sprintf "index %d is out of range: the list has %d elements" i (Vector.length xs)))
  | Map entries, k -> Result.map (fun k -> Map (put entries k y)) (key k)
  | x, _ -> expected "a list or a map to assign an element of" x

let range ~inclusive first last =
  match Value.canonical_number first, Value.canonical_number last with
  | Integer a, Integer b when (not inclusive) && a = b -> Ok (List Vector.empty)
  | Integer a, Integer b -> (
      let b = if inclusive then b else if a < b then b - 1 else b + 1 in
      match subtract b a with
      | Integer n when abs n < max_int && n <> min_int -> Ok (Range (a, b))
      | _ -> Error (Printf.sprintf "a range has at most %d elements" max_int))
  | Integer _, x | x, _ -> expected "a whole number as end of a range" x

let unit_factor = Dolphin_syntax.Units.factor
let unit_names = Dolphin_syntax.Units.names

(* A name of few letters is near to the wrong unit: kn to km, nm to m. *)
let abbreviations =
  [ ("s", "seconds"); ("secs", "seconds"); ("mins", "minutes"); ("h", "hours"); ("hr", "hours"); ("hrs", "hours");
    ("d", "days"); ("deg", "degrees"); ("degs", "degrees"); ("rad", "radians"); ("rads", "radians");
    ("nm", "nauticalMiles"); ("nmi", "nauticalMiles"); ("mile", "nauticalMiles"); ("miles", "nauticalMiles");
    ("kn", "knots"); ("kt", "knots"); ("kts", "knots"); ("ft", "feet") ]

let unit_hint name =
  let lower = String.lowercase_ascii name in
  let meant =
    match List.assoc_opt lower abbreviations with
    | Some _ as unit -> unit
    | None when List.mem lower unit_names -> Some lower
    | None when String.length name <= 3 -> None
    | None -> Dolphin_syntax.Diagnostic.suggest name unit_names
  in
  match meant with
  | Some unit -> Printf.sprintf "did you mean '%s'?" unit
  | None -> "units are m, km, seconds, min, hours, days, degrees, knots, feet, percent and the like"

let in_unit n name =
  match n, unit_factor name with
  | Integer i, Some factor when Float.is_integer factor -> Ok (multiply i (int_of_float factor))
  | n, Some factor -> (
      match Value.to_number n with
      | Some n ->
        (* 10.percent is 0.1: dividing is exact where multiplying with 0.01 is not. *)
        Ok (Number (if name = "percent" then n /. 100. else n *. factor))
      | None -> expected (Printf.sprintf "a number before .%s" name) n)
  | n, None -> Error (Printf.sprintf "%s has no property '%s'" (Value.kind n) name)
