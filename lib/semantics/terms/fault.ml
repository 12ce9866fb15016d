type cause = Code | Assertion
type t = { message : string; site : Core.site; cause : cause }

let unknown_site = -1
let make site message = { message; site; cause = Code }
let assertion site message = { message; site; cause = Assertion }
let is_assertion fault = match fault.cause with Assertion -> true | Code -> false

let location (program : Core.program) fault =
  if fault.site >= 0 && fault.site < Array.length program.locations then Some program.locations.(fault.site)
  else None

