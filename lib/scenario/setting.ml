open Dolphin_syntax
open Ast

type value = Literal.t located

type 'draft t = {
  word : string;
  takes : string;
  again : bool;
  read : 'draft -> value list -> ('draft, Diagnostic.t) result option;
}

let error ?hint at fmt = Format.kasprintf (fun message -> Result.Error (Diagnostic.error ?hint at message)) fmt

(* {1 Values} *)

let expected what (value : value) = error value.at "expected %s, found %s" what (Literal.describe value.it)

let text (value : value) =
  match value.it with
  | Text "" -> error value.at "this text is empty"
  | Text text -> Ok text
  | Number _ | Position _ | Unknown ->
    expected "a text in quotes" value

let number (value : value) =
  match value.it with
  | Number (n, _) -> Ok n
  | Text _ | Position _ | Unknown -> expected "a number" value

let time (value : value) =
  match value.it with
  | Number (n, (None | Some Time)) when Dolphin_semantics.Time.is_one n -> Ok n
  | Number (n, (None | Some Time)) when n >= 0. ->
    error value.at "a time is less than %g seconds, not %g" Dolphin_semantics.Time.longest n
  | Number (n, (None | Some Time)) -> error value.at "a time is at least 0 seconds, not %g" n
  | Number (_, Some (Length | Speed | Angle | Share)) | Text _ | Position _ | Unknown ->
    expected "a time, as in 30.seconds" value

let share (value : value) =
  match value.it with
  | Number (n, (None | Some Share)) when n >= 0. && n <= 1. -> Ok n
  | Number (n, None) when n > 1. && n <= 100. ->
    error value.at "a share is from 0 to 1, not %g" n ~hint:(Printf.sprintf "did you mean %g.percent?" n)
  | Number (n, None) -> error value.at "a share is from 0 to 1, not %g" n
  | Number (n, Some Share) -> error value.at "a share is from 0 to 100.percent, not %g.percent" (n *. 100.)
  | Number (_, Some (Length | Speed | Angle | Time)) | Text _ | Position _ | Unknown ->
    expected "a share, as in 80.percent" value

let per_hour (value : value) =
  match value.it with
  | Number (n, Some Share) when n >= 0. -> Ok n
  | Number (n, None) when n >= 0. && n <= 1. -> Ok n
  | Number (n, None) when n > 1. ->
    error value.at "a share is from 0 to 1, not %g" n ~hint:(Printf.sprintf "did you mean %g.percent?" n)
  | Number (_, (None | Some Share)) -> error value.at "a share is at least 0"
  | Number (_, Some (Length | Speed | Angle | Time)) | Text _ | Position _ | Unknown ->
    expected "a share of the battery, as in 10.percent" value

let speed (value : value) =
  match value.it with
  | Number (n, (None | Some Speed)) when n > 0. -> Ok n
  | Number (n, (None | Some Speed)) -> error value.at "a speed is more than 0 metres per second, not %g" n
  | Number (_, Some (Length | Time | Angle | Share)) | Text _ | Position _ | Unknown ->
    expected "metres per second without a unit, as in 1.5, or knots" value

let degrees what (value : value) =
  match value.it with
  | Number (n, (None | Some Angle)) -> Ok n
  | Number (_, Some (Length | Time | Speed | Share)) | Text _ | Position _ | Unknown ->
    expected (what ^ " in degrees") value

let metres (value : value) =
  match value.it with
  | Number (n, (None | Some Length)) -> Ok n
  | Number (_, Some (Angle | Speed | Time | Share)) | Text _ | Position _ | Unknown ->
    expected "a height in metres" value

let coordinates (latitude : value) (longitude : value) height =
  let ( let* ) = Result.bind in
  let* lat = degrees "a latitude" latitude in
  let* lon = degrees "a longitude" longitude in
  let* above = Option.fold height ~none:(Ok 0.) ~some:metres in
  match Dolphin_geo.Position.make ~latitude:lat ~longitude:lon ~height:above with
  | Ok position -> Ok position
  | Error fault ->
    let at =
      match fault with
      | Latitude _ -> latitude.at
      | Longitude _ -> longitude.at
      | Height _ -> (Option.value height ~default:longitude).at
    in
    error at "%a" Dolphin_geo.Position.pp_error fault

let position = function
  | [ { it = Literal.Position position; at = _ } ] -> Some (Ok position)
  | [ latitude; longitude ] -> Some (coordinates latitude longitude None)
  | [ latitude; longitude; height ] -> Some (coordinates latitude longitude (Some height))
  | _ -> None

(* {1 Blocks} *)

(* A line of a block: its word, and its arguments. *)
let line (s : statement) =
  match s.it with
  | Expression { it = Variable word; at } -> Ok ({ it = word; at }, [])
  | Expression { it = Call { callee = { it = Variable word; at }; arguments }; at = _ } ->
    Ok ({ it = word; at }, arguments)
  | Setting (word, e) -> Ok (word, [ Positional e ])
  | Expression { it = Binary (Subtract, { it = Variable word; at = _ }, _); at } ->
    error at "this subtracts from '%s'" word
      ~hint:(Printf.sprintf "a first value that is negative is put in parentheses: %s(-1)" word)
  | _ -> error s.at "only settings may stand here" ~hint:"a setting is a name and its values: speed 1.5"

let rec elements = function
  | Positional { it = List xs; at = _ } -> List.concat_map (fun x -> elements (Positional x)) xs
  | Positional e -> [ Result.map (fun it -> { it; at = e.at }) (Literal.read e) ]
  | Named (name, _) -> [ error name.at "values have no names here" ]
  | Keyed (k, _) -> [ error k.at "values have no names here" ]

let rec collect = function
  | [] -> Ok []
  | Ok x :: rest -> Result.map (fun xs -> x :: xs) (collect rest)
  | Result.Error fault :: _ -> Result.Error fault

let find ~what settings (word : string located) =
  match List.find_opt (fun setting -> setting.word = word.it) settings with
  | Some setting -> Ok setting
  | None ->
    let words = List.map (fun setting -> setting.word) settings in
    let hint =
      match Diagnostic.suggest word.it words with
      | Some near -> Printf.sprintf "did you mean '%s'?" near
      | None -> Printf.sprintf "its settings are %s" (String.concat ", " words)
    in
    error word.at "%s has no setting '%s'" what word.it ~hint

let apply ~what settings seen draft (word, arguments) =
  let ( let* ) = Result.bind in
  let* setting = find ~what settings word in
  if (not setting.again) && List.mem word.it seen then error word.at "'%s' stands twice" word.it
  else
    let* values = collect (List.concat_map elements arguments) in
    match setting.read draft values with
    | Some result -> result
    | None -> error word.at "'%s' takes %s" word.it setting.takes

let block ~what settings draft body =
  let add (draft, seen, faults) statement =
    match line statement with
    | Error fault -> (draft, seen, fault :: faults)
    | Ok (word, arguments) -> (
        match apply ~what settings seen draft (word, arguments) with
        | Ok draft -> (draft, word.it :: seen, faults)
        | Error fault -> (draft, word.it :: seen, fault :: faults))
  in
  List.fold_left add (draft, [], []) body
