open Dolphin_results
open Core
module Area = Dolphin_geo.Area
module Suggest = Dolphin_syntax.Diagnostic
module Numeral = Dolphin_numerals.Numeral

let ( let* ) = Result.bind

let one_vehicle world = function
  | [ v ] -> (
      match World.find v world with
      | Some state -> Ok state
      | None -> Error (Printf.sprintf "nothing is known of vehicle %s" v))
  | vs -> Error (Printf.sprintf "the set must be a single vehicle, it has %d" (List.length vs))

let strings names = List (Vector.of_list (List.map (fun name -> String name) names))

let number_text x = match Value.to_number x with Some n -> n | None -> 0.

let sum items = Results.fold (Operators.binary Add) (Integer 0) (Array.to_list items)

let extreme better items =
  let choose best x =
    let* replace = Operators.binary better x best in
    Ok (if Value.truth replace then x else best)
  in
  match Array.to_list items with [] -> Ok Null | first :: _ as items -> Results.fold choose first items

let distinct items =
  let add (known, kept) x = if Equal_values.mem x known then (known, kept) else (Equal_values.add x known, x :: kept) in
  let _, latest_first = Array.fold_left add (Equal_values.empty, []) items in
  Array.of_list (List.rev latest_first)

let reversed items =
  let n = Array.length items in
  Array.init n (fun i -> items.(n - 1 - i))

let part items first count =
  let n = Array.length items in
  let first = max 0 (min n first) in
  Array.sub items first (max 0 (min count (n - first)))

let find_index p items =
  let rec from i = if i = Array.length items then -1 else if p items.(i) then i else from (i + 1) in
  from 0

let replace_all text target by =
  if target = "" then text
  else begin
    let b = Buffer.create (String.length text) and n = String.length target in
    let rec from i =
      if i + n > String.length text then Buffer.add_substring b text i (String.length text - i)
      else if String.sub text i n = target then (Buffer.add_string b by; from (i + n))
      else (Buffer.add_char b text.[i]; from (i + 1))
    in
    from 0;
    Buffer.contents b
  end

let occurrences text target =
  let n = String.length target in
  let rec from i found =
    if i + n > String.length text then found
    else if String.sub text i n = target then from (i + n) (found + 1)
    else from (i + 1) found
  in
  from 0 0

let split text separator =
  match separator with
  | "" -> [ text ]
  | _ when String.length separator = 1 -> String.split_on_char separator.[0] text
  | _ -> String.split_on_char '\000' (replace_all text separator "\000")

let starts_with prefix s =
  String.length prefix <= String.length s && String.sub s 0 (String.length prefix) = prefix

let ends_with suffix s =
  let n = String.length suffix and m = String.length s in
  n <= m && String.sub s (m - n) n = suffix

let parse_number what text convert =
  match convert (String.trim text) with
  | Some x -> Ok x
  | None -> Error (Printf.sprintf "'%s' is not %s" text what)

(* The value of a getter without arguments; [getX()] is the same as [.x]. *)

let of_vehicles world vs name =
  let with_state f = let* state = one_vehicle world vs in Ok (f state) in
  match name with
  | "id" -> (match vs with [ v ] -> Some (Ok (String v)) | _ -> Some (with_state (fun s -> String s.World.id)))
  | "ids" -> Some (Ok (strings vs))
  | "type" -> Some (with_state (fun s -> String s.World.kind))
  | "payload" -> Some (with_state (fun s -> strings s.World.payload))
  | _ -> None

let of_position (p : Dolphin_geo.Position.t) = function
  | "latitude" | "lat" -> Some (Ok (Number p.latitude))
  | "longitude" | "lon" -> Some (Ok (Number p.longitude))
  | "height" -> Some (Ok (Number p.height))
  | _ -> None

let positions ps = List (Vector.of_list (List.map (fun p -> Position p) ps))

let of_area a = function
  | "centre" | "center" -> Some (Ok (Position (Area.centre a)))
  | "radius" -> (
      match a with
      | Area.Circle { radius; _ } -> Some (Ok (Number radius))
      | Shape _ -> Some (Error "only circles have a radius"))
  | "size" -> Some (Ok (Number (Area.size a)))
  | "corners" -> Some (Ok (positions (Area.corners a)))
  | "bounds" ->
    let south_west, north_east = Area.bounds a in
    Some (Ok (positions [ south_west; north_east ]))
  | "hull" -> Some (Operators.area (Area.hull [ a ]))
  | _ -> None

let split_area a = function
  | Integer n ->
    let parts = Operators.of_geometry (Area.split a n) in
    Result.map (fun parts -> List (Vector.of_list (List.map (fun part -> Area part) parts))) parts
  | x -> Operators.expected "a whole number of parts" x

let on_area a name arguments =
  match name, List.map Value.to_number arguments with
  | "offset", [ Some metres ] -> Some (Operators.area (Area.offset a metres))
  | "grid", [ Some metres ] ->
    Some (Result.map positions (Operators.of_geometry (Area.grid a metres)))
  | ("offset" | "grid"), [ None ] -> Some (Operators.expected "a number of metres" (List.hd arguments))
  | "split", [ _ ] -> Some (split_area a (Value.canonical_number (List.hd arguments)))
  | _, _ -> None

(* Of a list, a range or a vehicle set [x], with this number of elements, by index. *)
let of_items x length get name =
  let element i what =
    if length > 0 then Ok (get i)
    else
      let kind = match x with Vehicles _ -> "vehicle set" | _ -> "list" in
      Error (Printf.sprintf "an empty %s has no %s" kind what)
  in
  match name, x with
  | "first", _ -> Some (element 0 "first element")
  | "head", _ -> Some (element 0 "head")
  | "last", _ -> Some (element (length - 1) "last element")
  | "tail", Vehicles vs -> Some (Ok (Vehicles (match vs with [] -> [] | _ :: rest -> rest)))
  | "tail", _ -> Some (Ok (List (Vector.of_array (Array.init (max 0 (length - 1)) (fun i -> get (i + 1))))))
  | _, _ -> None

let of_elements x name =
  match x with
  | List xs -> of_items x (Vector.length xs) (Vector.get xs) name
  | Vehicles vs -> of_items x (List.length vs) (Value.vehicle_at vs) name
  | _ -> Option.bind (Value.items x) (fun items -> of_items x (Array.length items) (Array.get items) name)

let getter world x name =
  let specific =
    match x with
    | Vehicles vs -> (
        match of_vehicles world vs name with Some result -> Some result | None -> of_elements x name)
    | Position p -> of_position p name
    | Area a -> of_area a name
    | List _ | Range _ -> of_elements x name
    | Task (Platform p) when name = "id" || name = "name" -> Some (Ok (String p.name))
    | Task (Platform p) when name = "length" -> Some (Travel.length p)
    | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Map _ | Task _ | Closure _
    | Host _ | Settings _ | Reading _ | Unknown _ -> None
  in
  match specific, name with
  | Some result, _ -> Some result
  | None, ("size" | "length") -> Option.map (fun n -> Ok (Integer n)) (Value.length x)
  | None, ("empty" | "isEmpty") -> Option.map (fun n -> Ok (Boolean (n = 0))) (Value.length x)
  | None, _ -> None

let of_any_elements = [ "size"; "length"; "first"; "last"; "head"; "tail" ]

(* The members of [x]. *)
let properties = function
  | Vehicles _ -> [ "id"; "ids"; "type"; "position"; "battery"; "payload" ] @ of_any_elements
  | List _ | Range _ -> of_any_elements
  | String _ | Map _ -> [ "size"; "length" ]
  | Position _ -> [ "latitude"; "longitude"; "height" ]
  | Area _ -> [ "centre"; "radius"; "size"; "corners"; "bounds"; "hull" ]
  | Task _ -> [ "id"; "name"; "length" ]
  | Integer _ | Number _ -> Operators.unit_names
  | Null | Boolean _ | Wildcard | Symbol _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> []

let near name names =
  match Suggest.suggest name names with Some near -> Printf.sprintf "; did you mean '%s'?" near | None -> ""

let property world x name =
  match x, getter world x name with
  | Map entries, inherent -> (
      match List.assoc_opt name entries, inherent with
      | Some x, _ -> Ok x
      | None, Some result -> result
      | None, None -> Ok Null)
  | _, Some result -> result
  | (Integer _ | Number _), None when Operators.unit_factor name <> None -> Operators.in_unit x name
  | (Integer _ | Number _), None ->
    Error (Printf.sprintf "a number has no unit '%s'%s" name (near name (properties x)))
  | Null, None -> Error (Printf.sprintf "null has no property '%s'" name)
  | ( ( Boolean _ | String _ | Wildcard | Symbol _ | List _ | Range _ | Position _ | Area _ | Vehicles _ | Task _
      | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ ),
      None ) -> Error (Printf.sprintf "%s has no property '%s'%s" (Value.kind x) name (near name (properties x)))

(* "getId" is a getter of "id". *)
let property_of_getter name =
  if String.length name > 3 && String.sub name 0 3 = "get" then
    Some (String.uncapitalize_ascii (String.sub name 3 (String.length name - 3)))
  else None

let on_string s name arguments =
  match name, arguments with
  | ("toUpperCase" | "toUpper"), [] -> Some (Ok (String (String.uppercase_ascii s)))
  | ("toLowerCase" | "toLower"), [] -> Some (Ok (String (String.lowercase_ascii s)))
  | "equalsIgnoreCase", [ String t ] ->
    Some (Ok (Boolean (String.lowercase_ascii s = String.lowercase_ascii t)))
  | "capitalize", [] -> Some (Ok (String (String.capitalize_ascii s)))
  | "trim", [] -> Some (Ok (String (String.trim s)))
  | "startsWith", [ String t ] -> Some (Ok (Boolean (starts_with t s)))
  | "endsWith", [ String t ] -> Some (Ok (Boolean (ends_with t s)))
  | "replace", [ String target; String by ] ->
    let longer = String.length by - String.length target in
    Some
      (if target <> "" && String.length s + (occurrences s target * longer) > Value.most_items then
         Operators.too_long "a string"
       else Ok (String (replace_all s target by)))
  | "split", [ String separator ] -> Some (Ok (strings (split s separator)))
  | "toInteger", [] ->
    Some (parse_number "a whole number" s (fun s -> Option.map (fun i -> Integer i) (Numeral.whole s)))
  | ("toDouble" | "toFloat" | "toBigDecimal"), [] ->
    Some (parse_number "a number" s (fun s -> Option.map (fun n -> Number n) (Numeral.number s)))
  | "isNumber", [] -> Some (Ok (Boolean (Numeral.number s <> None)))
  | ("padLeft" | "padRight"), [ Integer n ] when n > Value.most_items ->
    Some (Error (Printf.sprintf "a string of %d characters is too long" n))
  | ("padLeft" | "padRight"), [ Integer n ] ->
    let length = Option.value (Value.length (String s)) ~default:0 in
    let padding = String.make (max 0 (n - length)) ' ' in
    Some (Ok (String (if name = "padLeft" then padding ^ s else s ^ padding)))
  | ("substring" | "take" | "drop"), Integer a :: rest -> (
      match Value.items (String s) with
      | None -> None
      | Some characters ->
        let n = Array.length characters in
        let join items = String (String.concat "" (Array.to_list (Array.map Value.to_string items))) in
        match name, rest with
        | "substring", [] when 0 <= a && a <= n -> Some (Ok (join (part characters a n)))
        | "substring", [ Integer b ] when 0 <= a && a <= b && b <= n ->
          Some (Ok (join (part characters a (b - a))))
        | "substring", _ -> Some (Error (Printf.sprintf "the bounds are outside of a string of %d characters" n))
        | "take", [] -> Some (Ok (join (part characters 0 a)))
        | "drop", [] -> Some (Ok (join (part characters a n)))
        | _, _ -> None)
  | _, _ -> None

let on_items items name arguments =
  match name, arguments with
  | ("remove" | "removeAt"), [ Integer i ] when 0 <= i && i < Array.length items ->
    let kept = List.filteri (fun j _ -> j <> i) (Array.to_list items) in
    Some (Ok (List (Vector.of_list kept)))
  | ("remove" | "removeAt"), [ Integer i ] ->
    Some (Error (Printf.sprintf "index %d is out of range: the list has %d elements" i (Array.length items)))
  | "removeElement", [ y ] ->
    let at = find_index (Value.equals y) items in
    Some (Ok (List (Vector.of_list (List.filteri (fun j _ -> j <> at) (Array.to_list items)))))
  | "clear", [] -> Some (Ok (List Vector.empty))
  | "indexOf", [ y ] -> Some (Ok (Integer (find_index (Value.equals y) items)))
  | "reverse", [] -> Some (Ok (List (Vector.of_array (reversed items))))
  | "sum", [] -> Some (sum items)
  | "max", [] -> Some (extreme Greater items)
  | "min", [] -> Some (extreme Less items)
  | "unique", [] -> Some (Ok (List (Vector.of_array (distinct items))))
  | "take", [ Integer n ] -> Some (Ok (List (Vector.of_array (part items 0 n))))
  | "drop", [ Integer n ] -> Some (Ok (List (Vector.of_array (part items n (Array.length items)))))
  | "toList", [] -> Some (Ok (List (Vector.of_array items)))
  | "join", ([] | [ String _ ]) ->
    let separator = match arguments with [ String s ] -> s | _ -> "" in
    Some
      (if Array.length items * String.length separator > Value.most_items then Operators.too_long "a string"
       else Ok (String (String.concat separator (Array.to_list (Array.map Value.to_string items)))))
  | "sort", [] ->
    let order a b =
      match Value.to_number a, Value.to_number b with
      | Some a, Some b -> Float.compare a b
      | _, _ -> Value.compare a b
    in
    Some (Ok (List (Vector.of_list (List.stable_sort order (Array.to_list items)))))
  | _, _ -> None

(* Methods that go through all of [x] only if necessary. *)
let on_elements x name arguments =
  match name, arguments with
  | "get", [ i ] -> Some (Operators.element x i)
  | ("add" | "push" | "leftShift"), [ y ] -> Some (Operators.binary Append x y)
  | "addAll", [ ys ] -> Some (Operators.binary Add x ys)
  | ("size" | "length" | "isEmpty" | "first" | "last" | "head"), [] -> None
  | _, _ -> Option.bind (Value.items x) (fun items -> on_items items name arguments)

let on_map entries name arguments =
  match name, arguments with
  | ("get" | "getAt"), [ k ] -> Some (Operators.element (Map entries) k)
  | "get", [ k; default ] ->
    Some (Result.map (fun k -> Option.value (List.assoc_opt k entries) ~default) (Operators.key k))
  | "containsKey", [ k ] -> Some (Operators.member k (Map entries))
  | "containsValue", [ x ] -> Some (Ok (Boolean (List.exists (fun (_, y) -> Value.equals x y) entries)))
  | ("keySet" | "keys"), [] -> Some (Ok (strings (List.map fst entries)))
  | "values", [] -> Some (Ok (List (Vector.of_list (List.map snd entries))))
  | "put", [ k; x ] -> Some (Operators.replace_element (Map entries) k x)
  | "remove", [ k ] -> Some (Result.map (fun k -> Map (List.remove_assoc k entries)) (Operators.key k))
  | "clear", [] -> Some (Ok (Map []))
  | _, _ -> None

let on_number n x name arguments =
  match name, arguments with
  | ("abs" | "intValue" | "toInteger" | "doubleValue" | "toDouble" | "round"), [] ->
    let whole f = if Float.abs f < 0x1p62 then Ok (Integer (int_of_float f)) else Error "the number is too large" in
    Some
      (match name, x with
       | "abs", Integer i when i <> min_int -> Ok (Integer (abs i))
       | "abs", _ -> Ok (Number (Float.abs n))
       | ("doubleValue" | "toDouble"), _ -> Ok (Number n)
       | "round", _ -> whole (Float.round n)
       | _, _ -> whole (Float.trunc n))
  | "round", [ Integer digits ] ->
    let scale = Float.pow 10. (float digits) in
    Some (Ok (Number (Float.round (n *. scale) /. scale)))
  | _, _ -> None

let farthest = Dolphin_geo.Wgs84.farthest
let is_distance metres = Float.abs metres <= farthest  (* false for NaN *)

let on_position p name arguments =
  match name, arguments with
  | ("distance" | "distanceTo"), [ Position q ] -> Some (Ok (Number (Dolphin_geo.Wgs84.distance p q)))
  | ("bearing" | "bearingTo"), [ Position q ] -> Some (Ok (Number (Dolphin_geo.Wgs84.bearing p q)))
  | "displace", [ x; y ] -> (
      match Value.to_number x, Value.to_number y with
      | Some north, Some east when is_distance north && is_distance east ->
        Some (Ok (Position (Dolphin_geo.Wgs84.displace p ~north ~east)))
      | Some north, Some east ->
        let way = if is_distance north then east else north in
        Some (Error (Printf.sprintf "displace moves a place by at most %.0f km, not by %g m" (farthest /. 1000.) way))
      | Some _, None -> Some (Operators.expected "metres to the east" y)
      | None, _ -> Some (Operators.expected "metres to the north" x))
  | _, _ -> None

let on_plan p name arguments =
  match name, arguments with
  | "rest", [ x ] -> Option.map (Rest.from_share p) (Value.to_number x)
  | _, _ -> None

let updates = function
  | "add" | "push" | "addAll" | "leftShift" | "remove" | "removeAt" | "removeElement" | "clear" | "put" -> true
  | _ -> false

let specific x name arguments =
  match x with
  | String s -> on_string s name arguments
  | Map entries -> on_map entries name arguments
  | List _ | Range _ | Vehicles _ -> on_elements x name arguments
  | Integer _ | Number _ -> on_number (number_text x) x name arguments
  | Position p -> on_position p name arguments
  | Area a -> on_area a name arguments
  | Task (Platform p) -> on_plan p name arguments
  | Null | Boolean _ | Wildcard | Symbol _ | Task _ | Closure _ | Host _ | Settings _ | Reading _
  | Unknown _ -> None

let of_all_with_elements =
  [ "size"; "length"; "isEmpty"; "contains"; "each"; "eachWithIndex"; "collect"; "collectWithIndex"; "findAll"; "find";
    "any"; "every"; "count"; "inject" ]

let of_lists =
  [ "get"; "first"; "last"; "head"; "tail"; "take"; "drop"; "indexOf"; "reverse"; "sort"; "unique"; "sum"; "max"; "min";
    "join"; "toList"; "add"; "push"; "addAll"; "remove"; "removeAt"; "removeElement"; "clear" ]

(* The methods of the table in docs/language.md that [x] has. *)
let known x =
  let own =
    match x with
    | List _ | Range _ -> of_all_with_elements @ of_lists
    | Vehicles _ ->
      [ "getId"; "getType"; "getPosition"; "getBattery"; "getPayload"; "getIds" ] @ of_all_with_elements @ of_lists
    | Map _ ->
      [ "get"; "containsKey"; "containsValue"; "keySet"; "keys"; "values"; "put"; "remove"; "clear" ]
      @ of_all_with_elements
    | String _ ->
      [ "toUpperCase"; "toLowerCase"; "capitalize"; "trim"; "equalsIgnoreCase"; "startsWith"; "endsWith"; "replace";
        "split"; "substring"; "take"; "drop"; "padLeft"; "padRight"; "isNumber"; "toInteger"; "toDouble" ]
      @ of_all_with_elements
    | Integer _ | Number _ -> [ "abs"; "round"; "toInteger"; "toDouble"; "times" ]
    | Position _ -> [ "distance"; "bearing"; "displace"; "getLatitude"; "getLongitude"; "getHeight" ]
    | Area _ ->
      [ "contains"; "getCentre"; "getRadius"; "getSize"; "getCorners"; "getBounds"; "hull"; "offset"; "grid"; "split" ]
    | Task _ -> [ "getName"; "length"; "duration"; "energy"; "rest" ]
    | Closure _ -> [ "call" ]
    | Null | Boolean _ | Wildcard | Symbol _ | Host _ | Settings _ | Reading _ | Unknown _ -> []
  in
  [ "equals"; "toString" ] @ own

let may_have x name =
  let gets name = getter World.empty x name <> None in
  let other_names = [ "filter"; "distanceTo"; "bearingTo"; "getAt" ] in
  List.exists (List.mem name) [ known x; properties x; other_names ] || updates name || gets name
  || Option.fold (property_of_getter name) ~none:false ~some:gets
  || specific x name [] <> None

let like x name = Suggest.suggest name (known x @ properties x)

(* Such a range, or number of times, is not gone through by methods; loops take any range. *)
let too_many x name =
  match x with
  | Range _ -> Value.items x = None
  | Integer n -> name = "times" && n > Value.most_items
  | Null | Boolean _ | Number _ | String _ | Wildcard | Symbol _ | List _ | Map _ | Position _ | Area _ | Vehicles _
  | Task _ | Closure _ | Host _ | Settings _ | Reading _ | Unknown _ -> false

let call world x name arguments =
  match name, arguments with
  | "equals", [ y ] -> Ok (Boolean (Value.equals x y))
  | "toString", [] -> Ok (String (Value.to_string x))
  | "contains", [ y ] when Value.length x <> None || (match x with Area _ -> true | _ -> false) ->
    Operators.binary Member_of y x
  | _, _ -> (
      match specific x name arguments with
      | Some result -> result
      | None ->
        let by_getter = match property_of_getter name with Some p -> getter world x p | None -> None in
        match arguments, by_getter, getter world x name with
        | [], Some result, _ | [], None, Some result -> result
        | _, _, _ ->
          let hint =
            if too_many x name then Printf.sprintf " for more than %d elements" Value.most_items
            else if List.mem name (known x) then Printf.sprintf " for %d arguments of that kind" (List.length arguments)
            else near name (known x)
          in
          Error (Printf.sprintf "%s has no method '%s'%s" (Value.kind x) name hint))
