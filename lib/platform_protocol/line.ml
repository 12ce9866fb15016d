open Dolphin_json
open Codec

let version = 1
let longest = 1_048_576

let read variants line =
  match Host_value.parse line with
  | Error why -> Error ("is not JSON: " ^ why)
  | Ok (`Assoc members) -> (
      match List.assoc_opt "kind" members with
      | Some (`String kind) -> (
          match variant variants kind with
          | Some reader ->
            let invalid why = Printf.sprintf "is not a valid '%s': %s" kind why in
            Result.map_error invalid (Result.map Option.some (reader members))
          | None -> Ok None)
      | Some _ | None -> Error "has no member 'kind' that is a text")
  | Ok _ -> Error "is not a JSON object"

let seconds = decimal ~least:0. ()
let request = named "request" (text_up_to 64)
let protocol () = whole ~least:1 ()
