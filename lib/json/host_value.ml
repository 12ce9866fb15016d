open Dolphin_results
open Dolphin_semantics
open Dolphin_geo

let ( let* ) = Result.bind

let deepest = 100
let longest_range = 100_000
let too_deep = Printf.sprintf "it is nested more than %d deep" deepest

(* Whether a map with these keys would be taken for something else. *)
let is_reserved fields =
  match List.sort String.compare (List.map fst fields) with
  | [ ("object" | "task" | "vehicles" | "map" | "rims") ]
  | [ "latitude"; "longitude" ] | [ "height"; "latitude"; "longitude" ]
  | [ "centre"; "radius" ] -> true
  | _ -> false

(* {1 To JSON} *)

let of_float x : (Yojson.Safe.t, string) result =
  if Float.is_finite x then Ok (`Float x) else Error (Printf.sprintf "%g is not a number that JSON has" x)

let of_position (p : Position.t) =
  let* latitude = of_float p.latitude in
  let* longitude = of_float p.longitude in
  let* height = of_float p.height in
  Ok (`Assoc [ ("latitude", latitude); ("longitude", longitude); ("height", height) ])

let of_range first last : (Yojson.Safe.t, string) result =
  if Float.abs (float_of_int last -. float_of_int first) >= float_of_int longest_range then
    Error (Printf.sprintf "a range of more than %d numbers is too long to send" longest_range)
  else
    let number i = `Int (if first <= last then first + i else first - i) in
    Ok (`List (List.init (abs (last - first) + 1) number))

let rec to_json_within depth (x : Core.value) : (Yojson.Safe.t, string) result =
  let stays = Error (Value.kind x ^ " cannot be sent to the host") in
  if depth > deepest then Error too_deep
  else
    match x with
    | Null | Unknown _ -> Ok `Null
    | Boolean b -> Ok (`Bool b)
    | Integer i -> Ok (`Int i)
    | Number x -> of_float x
    | String text | Symbol text -> Ok (`String text)
    | List xs -> Result.map (fun xs -> `List xs) (Results.map (to_json_within (depth + 1)) (Vector.to_list xs))
    | Map entries ->
      let* fields = Results.map_values (to_json_within (depth + 1)) entries in
      Ok (if is_reserved fields then `Assoc [ ("map", `Assoc fields) ] else `Assoc fields)
    | Range (first, last) -> of_range first last
    | Position p -> of_position p
    | Area (Shape shape) ->
      let rim ps = Result.map (fun ps -> `List ps) (Results.map of_position ps) in
      Result.map (fun rims -> `Assoc [ ("rims", `List rims) ]) (Results.map rim (Area.rings shape))
    | Area (Circle { centre; radius }) ->
      let* centre = of_position centre in
      let* radius = of_float radius in
      Ok (`Assoc [ ("centre", centre); ("radius", radius) ])
    | Vehicles vs -> Ok (`Assoc [ ("vehicles", `List (List.map (fun v -> `String v) vs)) ])
    | Host name -> Ok (`Assoc [ ("object", `String name) ])
    | Task (Platform { name; plan = None; _ }) -> Ok (`Assoc [ ("task", `String name) ])
    | Task (Platform { plan = Some _; _ }) -> Error "an inline plan cannot be sent to the host"
    | Task _ -> Error "of tasks, only platform tasks can be sent to the host"
    | Wildcard | Closure _ | Settings _ | Reading _ -> stays

let to_json = to_json_within 0

(* {1 From JSON} *)

let expected what json = Error (Printf.sprintf "%s is expected, not %s" what (Canonical.shortened 60 json))

let to_float what (json : Yojson.Safe.t) =
  let* x =
    match json with
    | `Int i -> Ok (float_of_int i)
    | `Intlit digits -> Ok (float_of_string digits)
    | `Float x -> Ok x
    | json -> expected what json
  in
  if Float.is_finite x then Ok x else expected what json

let to_name what : Yojson.Safe.t -> (string, string) result = function
  | `String name when name <> "" -> Ok name
  | json -> expected what json

let to_position fields =
  let coordinate name default =
    match List.assoc_opt name fields with Some json -> to_float ("a " ^ name ^ " in numbers") json | None -> Ok default
  in
  let* latitude = coordinate "latitude" 0. in
  let* longitude = coordinate "longitude" 0. in
  let* height = coordinate "height" 0. in
  Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height)

let to_area centre radius =
  let* centre =
    match centre with
    | `Assoc fields when is_reserved fields && List.mem_assoc "latitude" fields -> to_position fields
    | json -> expected "a position as centre" json
  in
  let* metres = to_float "a radius in metres" radius in
  match Area.circle centre metres with Ok area -> Ok area | Error _ -> expected "a radius of 0 metres or more" radius

let to_shape rims =
  let corner : Yojson.Safe.t -> (Position.t, string) result = function
    | `Assoc fields when is_reserved fields && List.mem_assoc "latitude" fields -> to_position fields
    | json -> expected "a position in a rim" json
  in
  let rim : Yojson.Safe.t -> (Position.t list, string) result = function
    | `List corners -> Results.map corner corners
    | json -> expected "a list of positions as a rim" json
  in
  let* rims = Results.map rim rims in
  Result.map_error (Format.asprintf "%a" Area.pp_error) (Area.of_rings rims)

let to_vehicles names =
  let* vs = Results.map (to_name "the id of a vehicle") names in
  let add set v = if List.mem v set then set else v :: set in
  Ok (Core.Vehicles (List.rev (List.fold_left add [] vs)))

let rec of_json_within depth ~site (json : Yojson.Safe.t) : (Core.value, string) result =
  if depth > deepest then Error too_deep
  else
    match (json :> Canonical.extended) with
    | `Null -> Ok Null
    | `Bool b -> Ok (Boolean b)
    | `Int i -> Ok (Integer i)
    | `Intlit _ | `Float _ -> Result.map (fun x -> Core.Number x) (to_float "a finite number" json)
    | `String text -> Ok (String text)
    | `List items ->
      let* xs = Results.map (of_json_within (depth + 1) ~site) items in
      Ok (Core.List (Vector.of_list xs))
    | `Assoc fields -> of_object depth ~site fields
    | `Tuple _ | `Variant _ -> expected "JSON without extensions" json

and of_object depth ~site fields =
  match fields with
  | [ ("map", `Assoc fields) ] -> of_map depth ~site fields
  | [ ("map", json) ] -> expected "an object as \"map\"" json
  | [ ("object", json) ] -> Result.map (fun name -> Core.Host name) (to_name "the name of an object" json)
  | [ ("task", json) ] ->
    let* name = to_name "the name of a task" json in
    Ok (Core.Task (Platform { name; plan = None; task_site = site }))
  | [ ("vehicles", `List names) ] -> to_vehicles names
  | [ ("rims", `List rims) ] -> Result.map (fun area -> Core.Area area) (to_shape rims)
  | [ ("rims", json) ] -> expected "a list of rims" json
  | [ ("vehicles", json) ] -> expected "a list of vehicles" json
  | [ ("centre", centre); ("radius", radius) ] | [ ("radius", radius); ("centre", centre) ] ->
    Result.map (fun area -> Core.Area area) (to_area centre radius)
  | fields when is_reserved fields -> Result.map (fun p -> Core.Position p) (to_position fields)
  | fields -> of_map depth ~site fields

and of_map depth ~site fields =
  let rec repeated = function
    | k :: (k' :: _ as others) -> if String.equal k k' then Some k else repeated others
    | [ _ ] | [] -> None
  in
  match repeated (List.sort String.compare (List.map fst fields)) with
  | Some k -> Error (Printf.sprintf "the key %S is there twice" k)
  | None ->
    let* entries = Results.map_values (of_json_within (depth + 1) ~site) fields in
    Ok (Core.Map entries)

let of_json ~site json = of_json_within 0 ~site json

(* How deep brackets nest, those inside of strings left aside. *)
let nesting text =
  let deepest_so_far = ref 0 and depth = ref 0 and quoted = ref false and escaped = ref false in
  let bracket = function
    | '[' | '{' | '(' | '<' -> incr depth; deepest_so_far := max !depth !deepest_so_far
    | ']' | '}' | ')' | '>' -> decr depth
    | '"' -> quoted := true
    | _ -> ()
  in
  let within_string = function
    | _ when !escaped -> escaped := false
    | '\\' -> escaped := true
    | '"' -> quoted := false
    | _ -> ()
  in
  String.iter (fun c -> if !quoted then within_string c else bracket c) text;
  !deepest_so_far

(* Values that Yojson accepts and JSON does not have. *)
let rec beyond (json : Yojson.Safe.t) =
  let text s = if Dolphin_utf8.Utf8.is_valid s then None else Some "a text in it is not UTF-8" in
  match (json :> Canonical.extended) with
  | `Null | `Bool _ | `Int _ | `Intlit _ -> None
  | `Float x -> if Float.is_finite x then None else Some "a number in it is not finite, or too large"
  | `String s -> text s
  | `List xs | `Tuple xs -> List.find_map beyond xs
  | `Assoc members ->
    List.find_map (fun (name, x) -> match text name with None -> beyond x | wrong -> wrong) members
  | `Variant (name, x) -> (match text name with None -> Option.bind x beyond | wrong -> wrong)

let parse ?(deepest = 2 * deepest) text =
  if nesting text > deepest then Error (Printf.sprintf "it is nested more than %d deep" deepest)
  else
    match Yojson.Safe.from_string text with
    | json -> (match beyond json with None -> Ok json | Some why -> Error why)
    (* Yojson quotes the bytes of the text as they are. *)
    | exception Yojson.Json_error why ->
      Error (Dolphin_syntax.Character.printable (String.concat " " (String.split_on_char '\n' why)))

let rec is_data : Core.value -> bool = function
  | Null | Boolean _ | Integer _ | Number _ | String _ | Position _ | Area _ | Vehicles _ -> true
  | List xs -> Vector.for_all is_data xs
  | Map entries -> List.for_all (fun (_, x) -> is_data x) entries
  | Task _ | Host _ | Wildcard | Symbol _ | Range _ | Closure _ | Settings _ | Reading _ | Unknown _ -> false

let data_of_json json =
  match of_json ~site:Fault.unknown_site json with
  | Ok x when is_data x -> Ok x
  | Ok _ -> Error "tasks and objects cannot be posted"
  | Error why -> Error why
