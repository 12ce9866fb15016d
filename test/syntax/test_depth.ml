(* Texts of unusual size, nesting or content are refused with a place, or read, and never raise. *)

open Dolphin_syntax

let repeat n text = String.concat "" (List.init n (fun _ -> text))

let refused name source message line column =
  Alcotest.test_case name `Quick (fun () ->
      match Parse.program ~file:"deep.dol" source with
      | Ok _ -> Alcotest.fail "was read"
      | Error [] -> Alcotest.fail "no fault is told"
      | Error (fault :: _) ->
        Alcotest.(check string) "message" message fault.message;
        Alcotest.(check (pair int int)) "place" (line, column) (Location.line fault.at, Location.column fault.at))

let accepted name source =
  Alcotest.test_case name `Quick (fun () -> ignore (Support.parse source))

(* A text of four times the length takes about four times as long, and not sixteen times: measured side by side, the
   shortest of some runs each, on whatever machine. *)
let linear name source =
  let spent source =
    let start = Sys.time () in
    ignore (Parse.program ~file:"large.dol" source);
    Sys.time () -. start
  in
  Alcotest.test_case name `Quick (fun () ->
      let short = source 1 and long = source 4 in
      let round (a, b) _ = (Float.min a (spent short), Float.min b (spent long)) in
      let a, b = List.fold_left round (infinity, infinity) [ 1; 2; 3 ] in
      if b > 0.1 && b > 9. *. a then Alcotest.failf "took %.2f s, and a quarter of it %.2f s" b a)

let brackets = "brackets nest deeper than 1000 here"
let nesting = "the program nests deeper than 10000 here"

let size = "the program has more than 500000 words and signs up to here"

let deep =
  [ refused "parentheses" ("x = " ^ repeat 100_000 "(") brackets 1 1005;
    refused "closed parentheses" ("x = " ^ repeat 1_001 "(" ^ "1" ^ repeat 1_001 ")") brackets 1 1005;
    accepted "a thousand parentheses" ("x = " ^ repeat 1_000 "(" ^ "1" ^ repeat 1_000 ")");
    refused "square brackets" (repeat 100_000 "[") brackets 1 1001;
    refused "braces" (repeat 100_000 "{") brackets 1 1001;
    refused "blocks" (repeat 1_000 "if (a) {\n" ^ "{ }" ^ repeat 1_000 "}") brackets 1001 1;
    refused "holes of strings" ("x = " ^ repeat 1_001 "\"${" ^ "a" ^ repeat 1_001 "}\"") brackets 1 3006;
    refused "negations" ("x = " ^ repeat 100_000 "!" ^ "a") nesting 1 10_004;
    refused "a long sum" ("x = 1" ^ repeat 100_000 " + 1") nesting 1 360_013;
    refused "a long path" ("x = a" ^ repeat 100_000 ".a") nesting 1 5;
    refused "commands" (repeat 100_000 "a " ^ "1") nesting 1 19_997;
    refused "tasks in tasks" ("x = " ^ repeat 100_000 "during 1 run " ^ "a") nesting 1 129_992;
    refused "alternatives" (repeat 50_000 "if (a) b else " ^ "c") nesting 1 139_980;
    refused "conditionals" ("x = " ^ repeat 100_000 "a ? b : " ^ "c") nesting 1 79_997;
    refused "limits" ("x = a" ^ repeat 100_000 " during 1") nesting 1 5;
    accepted "a sum of 9,000" ("x = 1" ^ repeat 9_000 " + 1");
    refused "300,000 statements" (repeat 300_000 "a b\n") size 166_668 1;
    refused "a list of a million" ("x = [1" ^ repeat 1_000_000 ", 1" ^ "]") size 1 750_001;
    accepted "a list of 200,000" ("x = [1" ^ repeat 200_000 ", 1" ^ "]") ]

let strange =
  [ refused "a zero byte" "x = 1\ny\000" "this file is not text: a zero byte stands here" 2 2;
    refused "no UTF-8" "x = '\xFF'" "this file is not UTF-8 text: byte 0xFF stands here" 1 6;
    refused "half a character" "x = '\xC3'" "this file is not UTF-8 text: byte 0xC3 stands here" 1 6;
    refused "a surrogate" "'\xED\xA0\x80'" "this file is not UTF-8 text: byte 0xED stands here" 1 2;
    refused "columns are characters" "x = 'é€🐬' )" "unexpected ')'" 1 11;
    accepted "an empty file" "";
    accepted "blank lines" "\n \n\t\n";
    accepted "only a comment" "// nothing";
    accepted "a byte order mark" "\xEF\xBB\xBFx = 1";
    accepted "carriage returns" "x = [\r\n1,\r\n2]\r\nif (x) {\r\n  y\r\n}\r\nelse z\r\n" ]

let unit_of_text =
  "if (a) {\n  x = f(1, 'two', [k: 3.5]) + \"t $a\" // c\n  execute v: t1 >> t2 | { it }\n}\nmessage x\n"

let large =
  [ linear "20,000 lines" (fun n -> repeat (n * 1_000) unit_of_text);
    linear "one long line" (fun n -> repeat (n * 5_000) "a;");
    linear "a long string" (fun n -> "x = '" ^ repeat (n * 250_000) "a" ^ "'");
    linear "a long comment" (fun n -> "/*" ^ repeat (n * 250_000) "* " ^ "*/");
    linear "many untils" (fun n -> "x = a" ^ repeat (n * 2_250) " until { a }");
    linear "many faults" (fun n -> repeat (n * 5_000) "x = = 1\n");
    linear "many unclosed strings" (fun n -> repeat (n * 5_000) "x = 'a\n");
    linear "many unclosed brackets" (fun n -> repeat (n * 225) "f(\n") ]

(* Any bytes at all, and any shuffle of tokens. *)
let never_raises source = match Parse.program ~file:"any" source with Ok _ -> true | Error faults -> faults <> []

let told_in_bounds source =
  match Parse.program ~file:"any" source with
  | Ok _ -> true
  | Error faults ->
    ignore (Format.asprintf "%a" (Support.pp_faults source) faults);
    List.length faults <= Parse.most_faults

let words =
  [| "a"; "b"; "task"; "pick"; "allOf"; "if"; "else"; "while"; "for"; "in"; "def"; "return"; "when"; "watch"; "waitFor";
     "until"; "during"; "then"; "run"; "onError"; "("; ")"; "["; "]"; "{"; "}"; "\n"; ";"; ","; ":"; "->"; "."; "?.";
     "?"; "?:"; "="; "+="; "++"; ".."; "-"; "+"; "*"; "!"; ">>"; "|"; "'x'"; "\"$a ${"; "\""; "'"; "1"; "2.5"; "_";
     "true"; "/*"; "*/"; "//" |]

let shuffled =
  let open QCheck2.Gen in
  map (String.concat " ") (list_size (int_bound 40) (map (Array.get words) (int_bound (Array.length words - 1))))

let arbitrary =
  [ Test_support.Property.case "bytes" ~count:1000 QCheck2.Gen.(string_size (int_bound 60)) ~print:String.escaped
      (fun source -> never_raises source && told_in_bounds source);
    Test_support.Property.case "words" ~count:4000 shuffled ~print:String.escaped
      (fun source -> never_raises source && told_in_bounds source) ]

let suite = deep @ strange @ large @ arbitrary
