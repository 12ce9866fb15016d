type cause = Code | Assertion | Task of { vehicle : Core.vehicle; task : string } | Unknown
type t = { message : string; site : Core.site; cause : cause }

let unknown_site = -1
let make site message = { message; site; cause = Code }
let assertion site message = { message; site; cause = Assertion }
let of_task site ~vehicle ~task message = { message; site; cause = Task { vehicle; task } }
let is_assertion fault = match fault.cause with Assertion -> true | Code | Unknown | Task _ -> false

let unknown site ({ sensor; of_vehicle = v } : Core.unknown) =
  let message =
    Printf.sprintf "%s(%s) is unknown, since %s has not reported it: %s(v) ?: x takes x then" sensor v v sensor
  in
  { message; site; cause = Unknown }

let is_unknown fault = match fault.cause with Unknown -> true | Code | Assertion | Task _ -> false

let location (program : Core.program) fault =
  if fault.site < 0 || fault.site >= Array.length program.locations then None
  else
    match Prelude_calls.to_site program fault.site with
    | Some { calls = [ call ]; name = _ } -> Some call
    | Some { calls = [] | _ :: _ :: _; name = _ } | None -> Some program.locations.(fault.site)

let hint (program : Core.program) fault =
  match Prelude_calls.to_site program fault.site with
  | None -> None
  | Some { name; calls = [] | [ _ ] } -> Some (Printf.sprintf "this is an error in %s of the prelude" name)
  | Some { name; calls = first :: others } ->
    let place at = Format.asprintf "%a" Dolphin_syntax.Location.pp at in
    let places = List.fold_left (fun text at -> Printf.sprintf "%s or %s" text (place at)) (place first) others in
    Some (Printf.sprintf "this is an error in %s of the prelude, called at %s" name places)
