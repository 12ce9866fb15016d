(* Printing and reading are inverse. *)

let law program =
  let text = Support.printed program in
  match Dolphin_syntax.Parse.program ~file:"printed.dol" text with
  | Ok read -> Dolphin_syntax.Erase.program read = program
  | Error _ -> false

let print program =
  let text = Support.printed program in
  text ^ Support.told ~file:"printed.dol" text
  ^ match Dolphin_syntax.Parse.program ~file:"p" text with
  | Ok read -> "read as:\n" ^ Support.printed read
  | Error _ -> ""

let suite =
  [ Test_support.Property.case "what is printed is read as the same" ~count:600 Generate.program ~print law ]
