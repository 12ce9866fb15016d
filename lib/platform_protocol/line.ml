open Dolphin_json
open Field

let version = 1
let longest = 1_048_576
let text x : Yojson.Safe.t = `String x
let make kind members : Yojson.Safe.t = `Assoc (("kind", text kind) :: members)

let read kinds line =
  match Host_value.parse line with
  | Error why -> Error ("is not JSON: " ^ why)
  | Ok (`Assoc members) -> (
      match List.assoc_opt "kind" members with
      | Some (`String kind) -> (
          match List.assoc_opt kind kinds with
          | Some reader ->
            let told why = Printf.sprintf "is not a valid '%s': %s" kind why in
            Result.map_error told (Result.map Option.some (reader members))
          | None -> Ok None)
      | Some _ | None -> Error "has no member 'kind' that is a text")
  | Ok _ -> Error "is not a JSON object"

let count json =
  let* n = whole json in
  if n >= 0 then Ok n else Error (Printf.sprintf "%d, not a number from 0" n)

let seconds json =
  let* x = number json in
  if x >= 0. then Ok x else Error (Printf.sprintf "%g, not a number from 0" x)

let word json =
  let* x = Field.text json in
  if x <> "" then Ok x else Error "empty"

let request json =
  let* x = word json in
  if String.length x <= 64 then Ok x else Error "longer than 64 bytes"
