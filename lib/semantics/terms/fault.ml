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
  if fault.site >= 0 && fault.site < Array.length program.locations then Some program.locations.(fault.site)
  else None

