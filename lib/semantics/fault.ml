type t = { message : string; site : Core.site }

let unknown_site = -1
let make site message = { message; site }

let location (program : Core.program) fault =
  if fault.site >= 0 && fault.site < Array.length program.locations then Some program.locations.(fault.site)
  else None

