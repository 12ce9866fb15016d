open Dolphin_syntax
open Dolphin_semantics
open Ast
module Area = Dolphin_geo.Area

type t = (Core.value, string) result

let ( let* ) = Result.bind
let error ?hint at fmt = Format.kasprintf (fun message -> Result.Error (Diagnostic.error ?hint at message)) fmt

(* The reason of a supplier that gives neither a reply nor a reason. *)
let failure = "failure"

(* {1 Reading} *)

let rec each read = function
  | [] -> Ok []
  | x :: rest ->
    let* y = read x in
    Result.map (fun ys -> y :: ys) (each read rest)

let positional arguments =
  let value = function Positional e -> Some e | Named _ | Keyed _ -> None in
  let values = List.filter_map value arguments in
  if List.compare_lengths values arguments = 0 then Some values else None

let name (e : expression) =
  match e.it with
  | String "" -> error e.at "this name is empty"
  | String name -> Ok name
  | _ -> error e.at "a name in quotes is expected here"

let at place = Result.map_error (Diagnostic.error place)

let words = [ "object"; "task"; "imcPlan"; "vehicles"; "location"; "area"; "polygon"; "rims"; "either"; "fails" ]

let rec value (e : expression) : (Core.value, Diagnostic.t) result =
  match e.it with
  | Null -> Ok Null
  | Boolean b -> Ok (Boolean b)
  | Integer i -> Ok (Integer i)
  | Number n -> Ok (Number n)
  | String text -> Ok (String text)
  | List es -> Result.map (fun xs -> Core.List (Vector.of_list xs)) (each value es)
  | Map entries -> List.fold_left entry (Ok (Core.Map [])) entries
  | Unary (Negate, inner) ->
    let* x = value inner in
    at e.at (Operators.unary Negate x)
  | Variable "fails" -> error e.at "fails is not a value: it stands for a whole reply"
  | Member { subject = { it = Variable "Location"; _ }; safe = false; _ } | Variable _ -> literal e
  | Member { subject; name; safe = false } ->
    let* _ = literal e in
    let* n = value subject in
    at e.at (Operators.in_unit n name.it)
  | Binary (Around, centre, radius) -> area e.at centre radius
  | Call { callee = { it = Variable word; _ }; arguments } -> (
      match word, positional arguments with
      | "object", Some [ x ] -> Result.map (fun name -> Core.Host name) (name x)
      | ("task" | "imcPlan"), Some [ x ] ->
        let task name = Core.Task (Platform { name; plan = None; task_site = Fault.unknown_site }) in
        Result.map task (name x)
      | "vehicles", Some xs -> Result.map (fun vs -> Core.Vehicles vs) (each name xs)
      | "location", Some [ _; _ ] | "location", Some [ _; _; _ ] -> location e.at arguments
      | "area", Some [ centre; radius ] -> area e.at centre radius
      | "polygon", Some (corners :: holes) ->
        shape e.at (fun corners -> Area.polygon ~holes:(List.tl corners) (List.hd corners)) (corners :: holes)
      | "rims", Some (_ :: _ as rims) -> shape e.at Area.of_rings rims
      | ("polygon" | "rims"), _ ->
        error e.at "%s takes lists of positions, as in %s([location(41.18, -8.7), ...])" word word
      | ("object" | "task" | "imcPlan"), _ -> error e.at "%s takes a name in quotes, as in %s('queue')" word word
      | "vehicles", None -> error e.at "vehicles takes ids in quotes, as in vehicles('x8-02', 'x8-03')"
      | "location", _ -> error e.at "location takes a latitude and a longitude in degrees, and perhaps a height"
      | "area", _ -> error e.at "area takes a position and a radius, as in area(Location.APDL, 2.km)"
      | ("either" | "fails"), _ -> error e.at "%s is not a value: it stands for a whole reply" word
      | _ -> (
          match Diagnostic.suggest word words with
          | Some near -> other e ~hint:(Printf.sprintf "did you mean %s?" near)
          | None -> other e))
  | _ -> other e

(* Whatever other entries of a fleet may have for a value. *)
and literal e =
  let* x = Literal.read e in
  match x with
  | Position p -> Ok (Core.Position p)
  | Number (n, _) -> Ok (Core.Number n)
  | Text text -> Ok (Core.String text)
  | Unknown -> other e

and other ?(hint = "as in true, 2.km, 'text', [1, 2], task('survey1'), object('queue'), either(true, false), fails") e =
  error e.at "this is nothing that a supplier can reply" ~hint

and entry map ((key : key located), e) =
  let* map = map in
  let* k =
    match key.it with
    | Name k -> Ok (Core.String k)
    | Computed ({ it = String _ | Integer _; _ } as k) -> value k
    | Computed k -> error k.at "a key is a name here"
  in
  let* x = value e in
  at key.at (Operators.replace_element map k x)

and location place arguments =
  let coordinate = function
    | Positional e -> Result.map (fun it -> { it; at = e.at }) (Literal.read e)
    | Named (name, _) -> error name.at "values have no names here"
    | Keyed (k, _) -> error k.at "values have no names here"
  in
  let* coordinates = each coordinate arguments in
  match Setting.position coordinates with
  | Some found -> Result.map (fun p -> Core.Position p) found
  | None -> error place "location takes a latitude and a longitude in degrees, and perhaps a height"

and area place centre radius =
  let* c = value centre in
  let* r = value radius in
  match c, Value.to_number r with
  | Position c, Some r -> (
      match Area.circle c r with
      | Ok area -> Ok (Core.Area area)
      | Error _ -> error radius.at "a radius is 0 metres or more")
  | _, _ -> error place "an area is a position and a radius, as in Location.APDL ^ 2.km"

and shape place make lists =
  let corner (e : expression) x =
    match x with Core.Position p -> Ok p | _ -> error e.at "a corner is a position, as in location(41.18, -8.7)"
  in
  let corners (e : expression) =
    match e.it with
    | List es -> each (fun e -> Result.bind (value e) (corner e)) es
    | _ -> error e.at "corners are a list of positions, as in [location(41.18, -8.7), ...]"
  in
  let* rims = each corners lists in
  match make rims with
  | Ok area -> Ok (Core.Area area)
  | Error fault -> error place "%a" Area.pp_error fault

(* As it arrives from a supplier that sends it. *)
let sent (e : expression) =
  let* x = value e in
  let open Dolphin_json in
  match Result.bind (Host_value.to_json x) (Host_value.of_json ~site:Fault.unknown_site) with
  | Ok x -> Ok x
  | Error why -> error e.at "a supplier cannot reply this: %s" why

let one (e : expression) : (t, Diagnostic.t) result =
  match e.it with
  | Variable "fails" -> Ok (Error failure)
  | Call { callee = { it = Variable "fails"; _ }; arguments } -> (
      match positional arguments with
      | Some [ { it = String why; _ } ] when why <> "" -> Ok (Error why)
      | _ -> error e.at "fails takes a reason in quotes, as in fails('the queue is closed')")
  | _ -> Result.map Result.ok (sent e)

let read (e : expression) =
  match e.it with
  | Call { callee = { it = Variable "either"; _ }; arguments } -> (
      match positional arguments with
      | Some (_ :: _ as es) -> each one es
      | Some [] | None -> error e.at "either takes replies, as in either(true, false)")
  | _ -> Result.map (fun reply -> [ reply ]) (one e)

let data (e : expression) =
  let datum reply =
    match reply with
    | Ok x when Dolphin_json.Host_value.is_data x -> Ok x
    | Ok _ -> error e.at "tasks and objects cannot be posted"
    | Error _ -> error e.at "fails is not an input"
  in
  let* replies = read e in
  List.fold_right (fun reply rest -> Result.bind (datum reply) (fun x -> Result.map (List.cons x) rest)) replies (Ok [])

let equal (a : t) (b : t) =
  match a, b with
  | Ok x, Ok y -> Value.compare x y = 0
  | Error why, Error why' -> why = why'
  | (Ok _ | Error _), _ -> false

(* {1 Writing} *)

let pp_text ppf text = Value.pp ppf (String text)
let pp_position ppf (p : Dolphin_geo.Position.t) =
  let number ppf n = Value.pp ppf (Core.Number n) in
  Format.fprintf ppf "location(%a, %a, %a)" number p.latitude number p.longitude number p.height

let rec pp_value ppf (x : Core.value) =
  match x with
  | Null | Boolean _ | Integer _ | Number _ | String _ -> Value.pp ppf x
  | List xs -> Format.fprintf ppf "[%a]" Fmt.(list ~sep:(any ", ") pp_value) (Vector.to_list xs)
  | Map [] -> Format.pp_print_string ppf "[:]"
  | Map entries ->
    let entry ppf (k, x) = Format.fprintf ppf "%a: %a" pp_text k pp_value x in
    Format.fprintf ppf "[%a]" Fmt.(list ~sep:(any ", ") entry) entries
  | Host name -> Format.fprintf ppf "object(%a)" pp_text name
  | Task (Platform p) -> Format.fprintf ppf "task(%a)" pp_text p.name
  | Vehicles vs -> Format.fprintf ppf "vehicles(%a)" Fmt.(list ~sep:(any ", ") pp_text) vs
  | Position p -> pp_position ppf p
  | Area (Shape shape) ->
    let rim ppf ps = Format.fprintf ppf "[%a]" Fmt.(list ~sep:(any ", ") pp_position) ps in
    Format.fprintf ppf "rims(%a)" Fmt.(list ~sep:(any ", ") rim) (Area.rings shape)
  | Area (Circle { centre; radius }) ->
    Format.fprintf ppf "area(%a, %a)" pp_position centre Value.pp (Core.Number radius)
  | Task _ | Wildcard | Symbol _ | Range _ | Closure _ | Settings _ | Reading _ | Unknown _ ->
    invalid_arg ("Reply.pp: " ^ Value.kind x)

let pp_one ppf = function
  | Ok x -> pp_value ppf x
  | Error why -> Format.fprintf ppf "fails(%a)" pp_text why

let pp ppf = function
  | [ reply ] -> pp_one ppf reply
  | replies -> Format.fprintf ppf "either(%a)" Fmt.(list ~sep:(any ", ") pp_one) replies
