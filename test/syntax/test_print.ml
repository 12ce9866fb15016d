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

(* An [ensure] at the end of a call without parentheses would be one of the whole call. *)
let ends_in_ensure () =
  let printed source =
    match Dolphin_syntax.Parse.program ~file:"p" source with
    | Ok program -> Support.printed program
    | Error _ -> Alcotest.failf "not read: %s" source
  in
  let prints source expected = Alcotest.(check string) source (expected ^ "\n") (printed source) in
  prints "f (t ensure { })" "f(t ensure { })";
  prints "f k: 1, (t >> (u ensure { }))" "f(k: 1, t >> (u ensure { }))";
  prints "f t ensure { }" "f(t) ensure { }";
  prints "execute t ensure { }" "execute t ensure { }"

let suite =
  [ Alcotest.test_case "an ensure at the end of a call" `Quick ends_in_ensure;
    Test_support.Property.case "what is printed is read as the same" ~count:600 Generate.program ~print law ]
