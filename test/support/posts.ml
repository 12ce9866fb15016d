open Dolphin_semantics
open Dolphin_environment

let inputs : Environment.input list =
  [ { key = "x"; rounds = [ [ Core.Integer 1; Integer 2 ]; [ Integer 3 ] ]; times = 2; certain = false };
    { key = "y"; rounds = [ [ Core.Integer 1 ] ]; times = 1; certain = true } ]

let once = [ { (List.hd inputs) with rounds = [ [ Core.Integer 1 ] ]; times = 1 } ]

let declared (environment : Environment.options) (program : Core.program) =
  if environment.inputs = [] then program else { program with inputs = [ "x"; "y" ] }
