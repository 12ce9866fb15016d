open Ast

type t = { name : string; value : expression; description : string option }

let of_statement s =
  match s.it with
  | Parameter { name; value; description } ->
    Some { name = name.it; value; description = Option.map (fun text -> text.it) description }
  | Expression _ | Assign _ | Define _ | Function _ | If _ | While _ | For _ | Return _ | Break | Continue | Block _
  | Setting _ -> None

let of_program p = List.filter_map of_statement p
let pp ppf p = Format.fprintf ppf "%s = %a" p.name Print.expression p.value

(* {1 Kinds of values} *)

type kind = Nothing | Whole | Number | Text | Truth | Place | List_of_values | Map_of_values

let rec kind e =
  match e.it with
  | Null -> Some Nothing
  | Boolean _ -> Some Truth
  | Integer _ -> Some Whole
  | Number _ -> Some Number
  | String _ -> Some Text
  | Unary (Negate, e) -> (
      match kind e with
      | Some (Whole | Number) as number -> number
      | Some (Nothing | Text | Truth | Place | List_of_values | Map_of_values) | None -> None)
  | Member { subject = { it = Variable "Location"; _ }; safe = false; _ } -> Some Place
  | Member { subject; safe = false; _ } -> (
      match kind subject with
      | Some (Whole | Number) -> Some Number
      | Some (Nothing | Text | Truth | Place | List_of_values | Map_of_values) | None -> None)
  | Call { callee = { it = Variable "location"; _ }; arguments } ->
    let is_number = function
      | Positional e -> (match kind e with Some (Whole | Number) -> true | _ -> false)
      | Named _ | Keyed _ -> false
    in
    if List.for_all is_number arguments then Some Place else None
  | List es -> if List.for_all is_value es then Some List_of_values else None
  | Map entries -> if List.for_all (fun (k, e) -> is_key k.it && is_value e) entries then Some Map_of_values else None
  | _ -> None

and is_key = function Name _ -> true | Computed k -> is_value k
and is_value e = kind e <> None

let described = function
  | Nothing -> "null"
  | Whole -> "a whole number"
  | Number -> "a number"
  | Text -> "a text"
  | Truth -> "true or false"
  | Place -> "a place"
  | List_of_values -> "a list"
  | Map_of_values -> "a map"

let suits ~wanted found =
  match wanted, found with
  | Nothing, _ | Number, Whole -> true
  | (Whole | Number | Text | Truth | Place | List_of_values | Map_of_values), _ -> wanted = found

(* {1 Setting them} *)

let told p =
  Option.fold p.description ~none:(Format.asprintf "%a" pp p) ~some:(fun text -> Format.asprintf "%a (%s)" pp p text)

let unknown name parameters =
  let known = List.map (fun p -> p.name) parameters in
  match Diagnostic.suggest name known, parameters with
  | _, [] -> "the program has no parameters"
  | Some near, _ -> Printf.sprintf "the program has no parameter '%s': did you mean '%s'?" name near
  | None, _ ->
    Printf.sprintf "the program has no parameter '%s', only %s" name (String.concat ", " (List.map told parameters))

let wrong p =
  let wanted = Option.fold (kind p.value) ~none:"a value" ~some:described in
  Printf.sprintf "'%s' is %s, as in %s" p.name wanted (told p)

let longest_range = 1_000

let range p text =
  let rec whole e =
    match e.it with
    | Integer n -> Some n
    | Unary (Negate, e) -> Option.map Int.neg (whole e)
    | _ -> None
  in
  let between first last inclusive =
    let step = if first <= last then 1 else -1 in
    let n = abs (last - first) + if inclusive then 1 else 0 in
    if n <= 0 || n > longest_range then None else Some (List.init n (fun i -> first + (i * step)))
  in
  match kind p.value, Parse.expression ~file:"--set" text with
  | Some Whole, Ok { it = Range { first; last; inclusive }; _ } -> (
      match whole first, whole last with
      | Some first, Some last -> between first last inclusive
      | _, _ -> None)
  | _, (Ok _ | Error _) -> None

(* The value of a text for a parameter that is one: as it stands, if it is not in quotes. *)
let read p text =
  match kind p.value, Parse.expression ~file:"--set" text with
  | Some Text, Ok ({ it = String _; _ } as e) -> Ok e
  | Some Text, _ -> Ok { p.value with it = String text }
  | _, Ok ({ it = Variable name; _ }) when kind p.value = Some Nothing ->
    Error (Printf.sprintf "a text stands in quotes: '%s'" name)
  | Some wanted, Ok e when Option.fold (kind e) ~none:false ~some:(fun found -> suits ~wanted found) -> Ok e
  | _, (Ok _ | Error _) -> Error (wrong p)

let rec twice = function
  | [] -> None
  | (x, _) :: rest -> if List.mem_assoc x rest then Some x else twice rest

let ( let* ) = Result.bind

let value parameters (x, text) =
  let told result = Result.map_error (Printf.sprintf "--set %s=%s: %s" x text) result in
  match List.find_opt (fun p -> p.name = x) parameters with
  | None -> told (Error (unknown x parameters))
  | Some p ->
    (* Diagnostics have the place of the parameter. *)
    Result.map (fun e -> (x, Relocate.expression (fun _ -> p.value.at) e)) (told (read p text))

let set settings p =
  let parameters = of_program p in
  let* () =
    match twice settings with
    | Some x -> Error (Printf.sprintf "--set %s is given twice" x)
    | None -> Ok ()
  in
  let add values setting =
    let* values = values in
    Result.map (fun v -> v :: values) (value parameters setting)
  in
  let* values = List.fold_left add (Ok []) settings in
  let replace s =
    match s.it with
    | Parameter ({ name; _ } as parameter) -> (
        match List.assoc_opt name.it values with
        | Some value -> { s with it = Parameter { parameter with value } }
        | None -> s)
    | _ -> s
  in
  Ok (if values = [] then p else List.map replace p)
