(* The formats: exact texts, round trips, and errors with their places. *)

open Dolphin_lts
module Json = Dolphin_lts_json.Graph_json
open Generate

let graph = Alcotest.testable Graph.pp Graph.equal
let example = Graph.of_list [ (0, "start(survey1)", 1); (1, "done(survey1)", 2) ]

let aldebaran = function
  | Ok g -> g
  | Error error -> Alcotest.failf "%a" Aldebaran.pp_error error

let exact () =
  Alcotest.(check string) "Aldebaran" "des (0, 2, 3)\n(0,\"start(survey1)\",1)\n(1,\"done(survey1)\",2)\n"
    (Aldebaran.to_string example);
  Alcotest.(check string) "JSON"
    "{\"format\":\"dolphin-lts\",\"version\":1,\n\
     \"initial\":0,\"states\":3,\n\
     \"labels\":[\"start(survey1)\",\"done(survey1)\"],\n\
     \"transitions\":[\n\
     [0,0,1],\n\
     [1,1,2]]}\n"
    (Json.to_string example);
  Alcotest.(check string) "Graphviz"
    "digraph \"lts\" {\n\
    \  node [shape=box, style=rounded];\n\
    \  initial [shape=point, label=\"\"];\n\
    \  initial -> 0;\n\
    \  0 [label=\"say \\\"hi\\\"\"];\n\
    \  1 [label=\"\", peripheries=2];\n\
    \  0 -> 1 [label=\"a\\\\b\"];\n\
     }\n"
    (Graphviz.to_string
       (Graph.with_text (fun s -> if s = 0 then "say \"hi\"" else "") (Graph.of_list [ (0, "a\\b", 1) ])))

let awkward =
  [ "say \"hi\""; "a,b"; "f(x), g(\"y\",1)"; ")"; "(0,\"a\",1)"; "Leixões"; "\\x41"; "\\"; ""; " a "; "\n"; "\"" ]

let awkward_labels () =
  let g = Graph.of_list (List.mapi (fun i label -> (i, label, i + 1)) awkward) in
  Alcotest.check graph "Aldebaran" g (aldebaran (Aldebaran.of_string (Aldebaran.to_string g)));
  Alcotest.(check string) "one label as it is written"
    "des (0, 1, 2)\n(0,\"say \\x22h\\xc3\\xa9\\x22, (\\\\x5cx41)\",1)\n"
    (Aldebaran.to_string (Graph.of_list [ (0, "say \"h\xc3\xa9\", (\\\\x41)", 1) ]));
  match Json.of_string (Json.to_string g) with
  | Ok h -> Alcotest.check graph "JSON" g h
  | Error error -> Alcotest.failf "%a" Json.pp_error error

(* As other tools write: inner quotes, no quotes, blanks, carriage returns, no last line feed, doubles. *)
let of_others () =
  let expected =
    Graph.of_list ~initial:1 ~states:4
      [ (1, "SEND !\"hello, \"world", 0); (0, "tau", 2); (2, "lock(p2, f2)", 1); (0, "i", 2) ]
  in
  let text =
    "des(1,5, 4)\r\n\n\
     ( 1 , \"SEND !\"hello, \"world\" , 0 )\r\n\
     (0,tau,2)\n(0, i, 2) \n(2,\"lock(p2, f2)\",1)\n(0,\"i\",2)"
  in
  Alcotest.check graph "read" expected (aldebaran (Aldebaran.of_string text))

let aldebaran_errors () =
  let fails text expected =
    match Aldebaran.of_string text with
    | Ok _ -> Alcotest.failf "%S was read" text
    | Error error -> Alcotest.(check string) text expected (Fmt.str "%a" Aldebaran.pp_error error)
  in
  fails "" "line 1: expected \"des (initial state, transitions, states)\", not \"\"";
  fails "des (0, 1)" "line 1: expected \"des (initial state, transitions, states)\", not \"des (0, 1)\"";
  fails "des (0, -1, 1)" "line 1: expected \"des (initial state, transitions, states)\", not \"des (0, -1, 1)\"";
  fails "des (0, 0, 0)" "line 1: there must be a state, the initial one";
  fails "des (3, 0, 2)" "line 1: there is no state 3: there are 2, numbered from 0";
  fails "des (0, 0, 99999999999999999999999)" "line 1: the number 99999999999999999999999 is too large";
  fails "des (0, 2, 2)\n(0,\"a\",1)\n" "line 1: 2 transitions are announced, but there are 1";
  fails "des (0, 1, 2)\n\n(0,\"a\",2)" "line 3: there is no state 2: there are 2, numbered from 0";
  fails "des (0, 1, 2)\n(0,\"a,1)" "line 2: the label \"a lacks its closing quote";
  fails "des (0, 1, 2)\n(0,1)" "line 2: expected (state,\"label\",state), not \"(0,1)\"";
  fails "des (0, 1, 2)\n(0,,1)" "line 2: expected (state,\"label\",state), not \"(0,,1)\"";
  fails "des (0, 1, 2)\n(0,\"a\",1" "line 2: expected (state,\"label\",state), not \"(0,\\\"a\\\",1\""

let json_errors () =
  let fails text expected =
    match Json.of_string text with
    | Ok _ -> Alcotest.failf "%S was read" text
    | Error error -> Alcotest.(check string) text expected (Fmt.str "%a" Json.pp_error error)
  in
  let graph members = Printf.sprintf "{\"format\":\"dolphin-lts\",\"version\":1,%s}" members in
  fails "[]" "this is not a graph: expected an object with \"format\": \"dolphin-lts\"";
  fails "{\"format\":\"dolphin-lts\",\"version\":2}" "this is version 2 of the format; expected version 1";
  fails (graph "\"initial\":0") "expected \"states\" in the object";
  fails (graph "\"initial\":1,\"states\":1") "there is no state 1 in \"initial\": there are 1, numbered from 0";
  fails
    (graph "\"initial\":0,\"states\":1,\"labels\":[\"a\"],\"transitions\":[[0,0,0],[0,1,0]]")
    "there is no label 1 in transition 1: there are 1, numbered from 0";
  fails
    (graph "\"initial\":0,\"states\":1,\"labels\":[\"a\"],\"transitions\":[[0,0]]")
    "expected [source, label, target] in transition 0";
  fails
    (graph "\"initial\":0,\"states\":2,\"labels\":[],\"transitions\":[],\"texts\":[\"x\"]")
    "expected 2 strings, one for each state in \"texts\"";
  match Json.of_string "{" with
  | Error (Not_json _) -> ()
  | Error _ | Ok _ -> Alcotest.fail "an open brace is JSON"

let texts () =
  let g = Graph.with_text (Printf.sprintf "state \"%d\"") example in
  match Json.of_string (Json.to_string g) with
  | Ok h ->
    let text = Option.get (Graph.text h) in
    Alcotest.(check (list string)) "texts" [ "state \"0\""; "state \"1\""; "state \"2\"" ] (List.init 3 text)
  | Error error -> Alcotest.failf "%a" Json.pp_error error

let labelled =
  let open QCheck2.Gen in
  let character = oneofl [ "\""; "\\"; "x"; "4"; "1"; ","; "("; ")"; " "; "é"; "\t"; "a" ] in
  let label = map (String.concat "") (list_size (int_bound 8) character) in
  let* n = int_range 1 5 in
  let state = int_bound (n - 1) in
  map (fun all -> Graph.of_list ~states:n all) (list_size (int_bound 6) (triple state label state))

let () =
  Alcotest.run "formats"
    [
      ( "examples",
        [
          case "exact texts" exact;
          case "awkward labels" awkward_labels;
          case "files of other tools" of_others;
          case "what is wrong with a file" aldebaran_errors;
          case "what is wrong with JSON" json_errors;
          case "texts of states" texts;
        ] );
      ( "laws",
        [
          law "Aldebaran's text reads back" ~print labelled (fun g ->
              match Aldebaran.of_string (Aldebaran.to_string g) with Ok h -> Graph.equal g h | Error _ -> false);
          law "JSON reads back" ~print labelled (fun g ->
              match Json.of_string (Json.to_string g) with Ok h -> Graph.equal g h | Error _ -> false);
          law "union and reversal" ~print labelled (fun g ->
              Graph.equal g (Graph.reverse (Graph.reverse g))
              && Graph.transitions (Graph.union g g) = 2 * Graph.transitions g
              && Graph.equal g (Graph.of_list ~initial:(Graph.initial g) ~states:(Graph.states g) (Graph.to_list g)));
        ] );
    ]
