open Dolphin_syntax
open Dolphin_semantics

type dimension = Length | Time | Speed | Angle | Share

type t =
  | Number of float * dimension option
  | Text of string
  | Position of Dolphin_geo.Position.t
  | Unknown

let dimension = function
  | "m" | "meter" | "meters" | "metre" | "metres" | "km" | "kilometer" | "kilometers" | "kilometre" | "kilometres"
  | "nauticalMile" | "nauticalMiles" | "foot" | "feet" | "fathom" | "fathoms" -> Some Length
  | "knot" | "knots" -> Some Speed
  | "second" | "seconds" | "sec" | "ms" | "milliseconds" | "min" | "minute" | "minutes" | "hour" | "hours" | "day"
  | "days" -> Some Time
  | "degree" | "degrees" | "radian" | "radians" | "north" | "east" | "south" | "west" -> Some Angle
  | "percent" -> Some Share
  | _ -> None

let describe = function
  | Number (n, None) -> Format.asprintf "the number %a" Value.pp (Value.canonical (Number n))
  | Number (_, Some Length) -> "a length"
  | Number (_, Some Time) -> "a time"
  | Number (_, Some Speed) -> "a speed"
  | Number (_, Some Angle) -> "an angle"
  | Number (_, Some Share) -> "a percentage"
  | Text text -> Format.asprintf "the text %a" Value.pp (String text)
  | Position _ -> "a position"
  | Unknown -> "unknown"

let error ?hint at fmt = Format.kasprintf (fun message -> Result.Error (Diagnostic.error ?hint at message)) fmt

let did_you_mean name names =
  match Diagnostic.suggest name names with
  | Some near -> Printf.sprintf "did you mean '%s'?" near
  | None -> Printf.sprintf "there are %s" (String.concat ", " names)

let place (name : string Ast.located) =
  match Dolphin_geo.Place.find name.it with
  | Some position -> Ok (Position position)
  | None ->
    error name.at "unknown place Location.%s" name.it
      ~hint:(did_you_mean name.it (List.map fst Dolphin_geo.Place.all))

let in_unit n (name : string Ast.located) =
  match Operators.in_unit (Number n) name.it with
  | Ok value -> Ok (Number (Option.value (Value.to_number value) ~default:n, dimension name.it))
  | Error _ ->
    error name.at "unknown unit '%s'" name.it ~hint:(Operators.unit_hint name.it)

let rec read (e : Ast.expression) =
  match e.it with
  | Integer n -> Ok (Number (float n, None))
  | Number n -> Ok (Number (n, None))
  | String text -> Ok (Text text)
  | Member { subject = { it = Variable "Location"; at = _ }; name; safe = false } -> place name
  | Member { subject; name; safe = false } -> (
      match read subject with
      | Ok (Number (n, None)) -> in_unit n name
      | Ok other -> error e.at "%s has no '%s'" (describe other) name.it
      | Error _ as fault -> fault)
  | Unary (Negate, inner) -> (
      match read inner with
      | Ok (Number (n, dimension)) -> Ok (Number (-.n, dimension))
      | Ok other -> error e.at "%s cannot be negative" (describe other)
      | Error _ as fault -> fault)
  | Variable "unknown" -> Ok Unknown
  | Variable name ->
    error e.at "a fleet has no variables" ~hint:(Printf.sprintf "a text is put in quotes: '%s'" name)
  | _ ->
    error e.at "only a number, a text or a place may stand here"
      ~hint:"as in 1.5, 30.seconds, 'UUV', Location.APDL"
