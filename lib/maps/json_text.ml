module Numeral = Dolphin_numerals.Numeral

let most_deep = 100

(* The place of the bracket that goes too deep: Yojson recurs once for each. *)
let too_deep text =
  let rec go i depth in_text =
    if i >= String.length text then None
    else
      match String.unsafe_get text i with
      | '\\' when in_text -> go (i + 2) depth in_text
      | '"' -> go (i + 1) depth (not in_text)
      | ('[' | '{') when not in_text -> if depth = most_deep then Some i else go (i + 1) (depth + 1) in_text
      | (']' | '}') when not in_text -> go (i + 1) (depth - 1) in_text
      | _ -> go (i + 1) depth in_text
  in
  go 0 0 false

let place_of text offset =
  let rec go i line start =
    if i >= offset then Printf.sprintf "line %d, column %d" line (offset - start + 1)
    else if text.[i] = '\n' then go (i + 1) (line + 1) (i + 1)
    else go (i + 1) line start
  in
  go 0 1 0

(* "Line 3, bytes 4-9:\nwhat is wrong". *)
let told why =
  match String.index_opt why '\n' with
  | Some i ->
    let place = String.sub why 0 i and rest = String.sub why (i + 1) (String.length why - i - 1) in
    let place = match String.index_opt place ':' with Some n -> String.sub place 0 n | None -> place in
    Drawn.wrong (String.uncapitalize_ascii place) "this is not JSON: %s" (String.uncapitalize_ascii rest)
  | None -> Drawn.wrong "" "this is not JSON: %s" (String.uncapitalize_ascii why)

let read text =
  let text = fst (Utf8_text.repaired (Utf8_text.without_mark text)) in
  match too_deep text with
  | Some offset -> Drawn.wrong (place_of text offset) "lists and objects are nested more than %d deep" most_deep
  | None -> ( try Yojson.Safe.from_string text with Yojson.Json_error why -> told why)

let member name : Yojson.Safe.t -> Yojson.Safe.t = function
  | `Assoc members -> Option.value (List.assoc_opt name members) ~default:`Null
  | _ -> `Null

let elements place : Yojson.Safe.t -> Yojson.Safe.t list = function
  | `List xs -> xs
  | _ -> Drawn.wrong place "a list [...] belongs here"

let number place : Yojson.Safe.t -> float = function
  | `Int n -> float_of_int n
  | `Float x when Float.is_finite x -> x
  | `Float _ -> Drawn.wrong place "a number of that size or kind is not known"
  | `Intlit digits when Numeral.number digits <> None -> float_of_string digits
  | _ -> Drawn.wrong place "a number belongs here"

let text : Yojson.Safe.t -> string option = function
  | `String text -> Some text
  | `Int n -> Some (string_of_int n)
  | _ -> None

type order = Longitude_first | Latitude_first

let position order place (json : Yojson.Safe.t) =
  match json with
  | `List (x :: y :: rest) ->
    let height = match rest with h :: _ when h <> `Null -> number place h | _ -> 0. in
    let x = number place x and y = number place y in
    let latitude, longitude = match order with Longitude_first -> (y, x) | Latitude_first -> (x, y) in
    Drawn.position place ~latitude ~longitude ~height
  | _ ->
    let names = match order with Longitude_first -> "longitude, latitude" | Latitude_first -> "latitude, longitude" in
    Drawn.wrong place "a position is [%s] or [%s, height]" names names
