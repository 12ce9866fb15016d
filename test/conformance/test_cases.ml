(* Reading cases, and likeness of labels and effects. That the corpus passes is in [conform.t]. *)

open Dolphin_conformance

let read text = Case.of_string ~path:"case.json" text

let refused expected text () =
  match read text with
  | Ok _ -> Alcotest.fail "this is read"
  | Error why -> Alcotest.(check string) "why" expected why

let case_with members = Printf.sprintf {|{"title": "t", "fleet": [], "program": ["post a: 1"], %s}|} members

let unreadable =
  [ ("no JSON", "this is not JSON: Blank input data", "");
    ("a list", "[], not an object", "[]");
    ("no title", "\"title\" is missing", {|{"fleet": [], "program": [], "expect": {"trace": []}}|});
    ("nothing expected", "nothing is expected", case_with {|"expect": {}|});
    ( "an unknown expectation",
      "expect.traces: this expectation is not known",
      case_with {|"expect": {"traces": []}|} );
    ( "an unknown member of a step",
      "expect.trace: unknown member \"effect\"; known are label, event, world, now, rule, effects, A, B, N, \
       store, end",
      case_with {|"expect": {"trace": [{"label": "end", "effect": []}]}|} );
    ( "an unknown member",
      "unknown member \"expects\"; known are title, covers, program, fleet, environment, expect, fails",
      case_with {|"expects": {}|} );
    ( "a step without a label",
      "expect.trace: \"label\" is missing",
      case_with {|"expect": {"trace": [{"rule": []}]}|} ) ]

let labels () =
  let like expected seen = Match.label expected seen in
  Alcotest.(check bool) "wording may be left out" true (like "broken" "broken(division by zero)");
  Alcotest.(check bool) "or be there" true (like "broken(why)" "broken(why)");
  Alcotest.(check bool) "and then counts" false (like "broken(why)" "broken(other)");
  Alcotest.(check bool) "deeds do not" false (like "check" "check(consume a:1)");
  Alcotest.(check bool) "nor do other names" false (like "pick" "picked(1)")

let transition effects : Dialogue.transition =
  { event = None; label = "end"; rules = [ "END" ]; effects;
    next = `Assoc [ ("end", `Null); ("A", `Assoc []); ("B", `List []); ("N", `List []); ("store", `Assoc []) ] }

let differs expected found =
  let seen : Case.seen =
    { label = "end"; event = None; world = None; now = None; rule = None; effects = Some expected;
      running = None; bound = None;
      pairs = None; store = None; ending = None } in
  Match.difference seen (transition found) <> None

let effects () =
  let json = Yojson.Safe.from_string in
  let one text = [ json text ] in
  let check what expected e f = Alcotest.(check bool) what expected (differs (one e) (one f)) in
  check "order of members" false {|{"start": "p", "on": "a"}|} {|{"on": "a", "start": "p"}|};
  check "numbers by value" false {|{"set-timer": 1, "seconds": 5}|} {|{"set-timer": 1, "seconds": 5.0}|};
  check "other numbers" true {|{"set-timer": 1, "seconds": 5}|} {|{"set-timer": 1, "seconds": 5.5}|};
  check "what is looked for is wording" false {|{"look-for": "a boat"}|} {|{"look-for": "1 vehicle"}|};
  check "so is why it ended" false {|{"end": {"ending": "failed"}}|} {|{"end": {"ending": "failed", "message": "m"}}|};
  check "unless the case says" true {|{"end": {"ending": "failed", "message": "n"}}|}
    {|{"end": {"ending": "failed", "message": "m"}}|};
  Alcotest.(check bool) "one too many" true (differs [] (one {|{"say": "m"}|}))

(* {1 Codes} *)

let read_file path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

(* Each code of an error is in the table of INTERPRETING.md, and has a case. *)
let codes_are_documented () =
  let page = read_file "../../conformance/INTERPRETING.md" in
  let folder = "../../conformance/cases/rejected" in
  let files = List.map (Filename.concat folder) (Array.to_list (Sys.readdir folder)) in
  let cases = String.concat "\n" (List.map read_file files) in
  let has text part =
    let n = String.length part in
    let rec from i = i + n <= String.length text && (String.sub text i n = part || from (i + 1)) in
    from 0
  in
  let is_of_programs : Dolphin_syntax.Diagnostic.code -> bool = function
    | Deed_in_answer | Deed_in_maker | Unused_task | No_effect | Assigned_condition | Never_holds | Wide_value
    | Unknown_plan | Unread_input | Other_meaning | Partial_map | No_end | No_time | Ends_here ->
      false
    | _ -> true
  in
  let codes = List.filter (fun (code, _) -> is_of_programs code) Dolphin_syntax.Diagnostic.codes in
  let check (_, name) =
    Alcotest.(check bool) (name ^ " is documented") true (has page ("`" ^ name ^ "`"));
    Alcotest.(check bool) (name ^ " has a case") true (has cases ("\"" ^ name ^ "\""))
  in
  List.iter check codes

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "cases"
    [ ("reading", List.map (fun (name, expected, text) -> case name (refused expected text)) unreadable);
      ("likeness", [ case "of labels" labels; case "of effects" effects ]);
      ("codes", [ case "of rejections are documented, and have a case" codes_are_documented ]) ]
