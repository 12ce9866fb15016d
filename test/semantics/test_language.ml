open Dolphin_semantics
open Test_support

let case name f = Alcotest.test_case name `Quick f
let strings = Alcotest.(check (list string))
let last run = Option.get (Pure_run.last run)
let run ?answers ?world ?limit source = Pure_run.run ?answers ?world ?limit (Pure_run.compile_exn source)

(* The configuration in which [source] waits for an event. *)
let waiting ?(world = Pure_run.fleet) source =
  let program = Pure_run.compile_exn source in
  let rec go c =
    match (Transition.internal program world c) () with Seq.Nil -> c | Cons (t, _) -> go t.Transition.next
  in
  (program, go (Configuration.initial program))

(* [after program c events] is [c] after the program's own steps and these events. *)
let after ?(world = Pure_run.fleet) program c events =
  let rec settle c =
    match (Transition.internal program world c) () with Seq.Nil -> c | Cons (t, _) -> settle t.Transition.next
  in
  let take c e =
    match Transition.accept program world c e with
    | Ok t -> settle t.next
    | Error Not_awaited -> Alcotest.fail "an event is not awaited"
    | Error (Bad_answer why) -> Alcotest.failf "bad answer: %s" why
  in
  List.fold_left take (settle c) events

let variable program c name =
  let is_it (i, _) = program.Core.global_names.(i) = name in
  match List.find_opt is_it (Store.bindings c.Configuration.shared.store) with
  | Some (_, x) -> Value.to_string x
  | None -> "nothing"

(* {1 Code without end} *)

let endless_script () =
  let run = run ~limit:5 "n = 0\nwhile (true) { n = n + 1 }" in
  strings "labels" [ "script"; "script"; "script"; "script"; "script" ] (Pure_run.labels run);
  List.iter (fun (t : Transition.t) -> Alcotest.(check string) "rule" "SCRIPT" (Pure_run.rules t)) run;
  Alcotest.(check string) "goes on" "goes on" (Pure_run.ending run)

let long_script () =
  let run = run "n = 0\nfor (i in 1..100000) { n = n + i }\nmessage n" in
  strings "the result is that of one go" [ "5000050000" ] (Pure_run.said run);
  Alcotest.(check bool) "in several steps" true (List.mem "script" (Pure_run.labels run))

let interrupted_script () =
  let program, _ = waiting "pause 1" in
  let c = Configuration.initial program in
  match Transition.accept program Pure_run.fleet c Interruption with
  | Ok t -> Alcotest.(check string) "ended" "interrupted" (Pure_run.ending [ t ])
  | Error _ -> Alcotest.fail "refused"

let on_the_way () =
  let program, _ = waiting "onInterrupt task('home')\nv = pick { id 'noptilus-1' }\npause 1" in
  let rec interrupted c times =
    match Transition.accept program Pure_run.fleet c Interruption with
    | Error _ -> times
    | Ok t -> interrupted t.next (times + 1)
  in
  let is_at_rest (t : Transition.t) = t.label = Pause 1. in
  match List.find_opt is_at_rest (Pure_run.run program) with
  | Some t -> Alcotest.(check int) "so often" 2 (interrupted t.next 0)
  | None -> Alcotest.fail "no pause"

(* {1 Answers} *)

let answered text =
  let program, c = waiting "def twice(x) { 2 * x }\nr = 3\nv = pick { id 'noptilus-1' }\nn = ask 'n?'\npause 1" in
  match Result.bind (Answer.event program text) (Transition.accept program Pure_run.fleet c) with
  | Ok t -> Ok (variable program (after program t.next []) "n")
  | Error (Bad_answer why) -> Error why
  | Error Not_awaited -> Alcotest.fail "not awaited"

let answer_is text expected () = Alcotest.(check (result string string)) text (Ok expected) (answered text)
let answer_is_bad text why () = Alcotest.(check (result string string)) text (Error why) (answered text)

(* Most of these are no expression, or do what an answer may not: each is taken or refused. *)
let words =
  [ "r"; "n"; "y"; "v"; "it"; "1"; "2.km"; "'a'"; "true"; "null"; "++"; "--"; "+"; "-"; "!"; "="; "+="; "=="; "<"; "?";
    ":"; ","; "."; "["; "]"; "("; ")"; "{"; "}"; "->"; "[0]"; ".size()"; "twice("; "task('p')"; "post(a: r)";
    "poll(a: _)"; "ask('x')"; "now()"; "halt()"; "battery(v)"; "|"; ">>"; "def"; "\xe5\x8c\x97"; "\n" ]

let any_answer =
  let generator = QCheck2.Gen.(map (String.concat " ") (list_size (int_range 1 5) (oneofl words))) in
  let is_judged text = match answered text with Ok _ | Error _ -> true in
  Property.case ~count:5_000 "any words are taken or refused" ~print:(Printf.sprintf "%S") generator is_judged

let answers =
  [ any_answer;
    case "a number" (answer_is "2" "2");
    case "with a unit" (answer_is "2.km" "2000");
    case "a string" (answer_is "'a' + 'b'" "ab");
    case "with variables and functions" (answer_is "twice(r) + v.size()" "7");
    case "yes in words" (answer_is "yes" "true");
    case "no in words" (answer_is "NO" "false");
    case "a word of several" (answer_is_bad "perhaps" "unknown name 'perhaps' (a text stands in quotes: 'perhaps')");
    case "confirm asks until it hears yes or no" (fun () ->
        let program, c = waiting "y = false\nb = confirm 'now?'\npause 1" in
        let hears text = Result.get_ok (Answer.event program text) in
        let c = after program c (List.map hears [ "1"; "'yes'"; "y" ]) in
        Alcotest.(check string) "b" "true" (variable program c "b"));
    case "no code"
      (answer_is_bad "[1, 2].collect { it + 1 }" "an answer may not contain code { ... }");
    case "an unknown name" (answer_is_bad "twise(2)" "unknown name 'twise' (did you mean 'twice'?)");
    case "division by zero" (answer_is_bad "1 / 0" "division by zero");
    case "a deed" (answer_is_bad "post(a: 1)" "an answer may only compute a value");
    case "halt" (answer_is_bad "halt('now')" "an answer may only compute a value");
    case "waiting" (answer_is_bad "ask('again?')" "ask may not stand in an answer");
    case "a change of an unknown variable" (answer_is_bad "y++" "'y' may not be changed in an answer");
    case "a change within" (answer_is_bad "[1, --y]" "'y' may not be changed in an answer");
    case "nothing" (fun () -> Alcotest.(check bool) "refused" true (Result.is_error (answered "")));
    case "no expression" (fun () -> Alcotest.(check bool) "refused" true (Result.is_error (answered "2 +")));
    case "an assignment" (fun () ->
        let program, c = waiting "r = 3\nn = ask 'n?'\npause 1" in
        match Result.bind (Answer.event program "r++") (Transition.accept program Pure_run.fleet c) with
        | Ok _ -> Alcotest.fail "accepted"
        | Error (Bad_answer why) -> Alcotest.(check string) "why" "'r' may not be changed in an answer" why
        | Error Not_awaited -> Alcotest.fail "not awaited");
    case "a task that fails later has no place in the program" (fun () ->
        let program, c = waiting "v = pick { id 'noptilus-1' }\nexecute ask('what?')" in
        let c = after program c [ Result.get_ok (Answer.event program "task('p')"); Vehicle_failed ("noptilus-1", "leak") ] in
        match c.control with
        | Ended (Failed fault) ->
          Alcotest.(check string) "message" "p failed on noptilus-1: leak" fault.message;
          Alcotest.(check bool) "no place" true (Fault.location program fault = None)
        | _ -> Alcotest.fail "did not fail") ]

(* {1 Picks} *)

let times_out program c =
  match Transition.accept program Pure_run.fleet c (Timer_expired Residual.script_timer) with
  | Ok t -> Format.asprintf "%a" Label.pp t.label
  | Error Not_awaited -> "not awaited"
  | Error (Bad_answer why) -> why

(* The configuration in which the script waits for its pick. *)
let picking source =
  let program = Pure_run.compile_exn source in
  match (Transition.internal program Pure_run.fleet (Configuration.initial program)) () with
  | Cons (t, _) -> (program, t.next)
  | Nil -> Alcotest.fail "no step"

let picks =
  let choices source =
    let program, c = picking source in
    Pure_run.labels (List.of_seq (Transition.internal program Pure_run.fleet c))
  in
  [ case "one for each choice, in pick order" (fun () ->
        strings "choices"
          [ "bind(noptilus-1, noptilus-2)"; "bind(noptilus-1, noptilus-3)"; "bind(noptilus-2, noptilus-3)" ]
          (choices "v = pick { count 2; type 'UUV' }"));
    case "too many are none" (fun () -> strings "choices" [] (choices "v = pick { count 4; type 'UUV' }"));
    case "what can be met does not time out" (fun () ->
        let program, c = picking "v = pick { type 'UUV' }" in
        Alcotest.(check string) "refused" "not awaited" (times_out program c));
    case "count _ waits for its whole time" (fun () ->
        strings "no choice before" [] (choices "v = pick { count _; type 'UUV' }");
        let program, c = picking "v = pick { count _; type 'UUV' }" in
        Alcotest.(check string) "all" "bind(noptilus-1, noptilus-2, noptilus-3)" (times_out program c));
    case "bound vehicles are not picked again" (fun () ->
        let run = run "v = pick { count 2; type 'UUV' }\nw = pick { type 'UUV' }\nmessage w\nx = pick { type 'UUV' }" in
        strings "said" [ "noptilus-3" ] (Pure_run.said run);
        Alcotest.(check bool) "failed" true (String.length (Pure_run.ending run) > 20));
    case "released vehicles are" (fun () ->
        strings "said" [ "noptilus-1" ]
          (Pure_run.said (run "v = pick { type 'UUV' }\nrelease v\nmessage pick { type 'UUV' }"))) ]

(* {1 Tuples} *)

let tuples_of source = Tuples.bindings (last (run source)).shared.tuples

let same source source' =
  let n source = (snd (waiting (source ^ "\npause 1"))).Configuration.shared.tuples in
  Tuples.equal (n source) (n source')

let tuples =
  let same_or_not name expected a b = case name (fun () -> Alcotest.(check bool) name expected (same a b)) in
  [ same_or_not "order is forgotten" true "post a: 1\npost a: 2" "post a: 2\npost a: 1";
    same_or_not "order is kept where _ takes the oldest" false "post a: 1\npost a: 2\nif (false) { consume a: _ }"
      "post a: 2\npost a: 1\nif (false) { consume a: _ }";
    same_or_not "order of other keys is forgotten" true "post a: 1\npost b: 2\npost b: 3\nif (false) { consume a: _ }"
      "post b: 3\npost a: 1\npost b: 2\nif (false) { consume a: _ }";
    same_or_not "whole numbers are integers" true "post a: 1.0, b: [2.0]" "post a: 1, b: [2]";
    same_or_not "a multiset" false "post a: 1" "post a: 1, a: 1";
    same_or_not "what is consumed is gone" true "post a: 1, a: 1\nconsume a: 1" "post a: 1";
    case "the oldest first" (fun () ->
        strings "said" [ "3 1 2" ]
          (Pure_run.said
             (run
                "r = []\npost a: 3, a: 1, a: 2\n\
                 for (i in 1..3) { for (x in 1..3) { } }\n\
                 execute oneOf { when { consume a: _ } then action { r << (poll(a: 3) ? 'no' : 3) } }\n\
                 execute oneOf { when { consume a: _ } then action { r << (poll(a: 1) ? 'no' : 1) } }\n\
                 execute oneOf { when { consume a: _ } then action { r << (poll(a: 2) ? 'no' : 2) } }\n\
                 message r.join(' ')")));
    case "left over" (fun () ->
        Alcotest.(check int) "keys" 2 (List.length (tuples_of "post a: 1, b: 2\nconsume a: 3"))) ]

(* {1 Values that vehicles have not reported} *)

let silent = { (Pure_run.vehicle "silent") with battery = None }
let with_silent = World.add silent Pure_run.fleet
let begun = "v = pick { id 'silent' }\nw = pick { id 'noptilus-1' }\n"

(* The output of the program that prints [e], or its failure. *)
let value_of e =
  let run = run ~world:with_silent (begun ^ Printf.sprintf "message(%s)" e) in
  match Pure_run.said run with [ text ] -> text | _ -> Pure_run.ending run

let is_unknown = "failed: battery(silent) is unknown, since silent has not reported it: battery(v) ?: x takes x then"

(* Whether a task that waits for [guard] begins. *)
let begins guard =
  let run = run ~world:with_silent (begun ^ Printf.sprintf "execute waitFor { %s } then action { message 'begun' }" guard) in
  Pure_run.said run = [ "begun" ]

let unknown =
  let gives text e = case e (fun () -> Alcotest.(check string) "value" text (value_of e)) in
  let guard holds g = case ("guard " ^ g) (fun () -> Alcotest.(check bool) "begins" holds (begins g)) in
  [ gives "unknown" "battery(v)"; gives "unknown" "v.battery * 100 + 1"; gives "unknown" "-battery(v).round(2)";
    gives "unknown" "battery(v) < 0.3"; gives "unknown" "!(battery(v) < 0.3)"; gives "unknown" "0.3 == battery(v)";
    gives "unknown" "Math.max(battery(v), 0.3)"; gives "at unknown" "\"at ${battery(v)}\"";
    gives "false" "battery(v) == null"; gives "true" "battery(v) != null";
    gives "unknown" "battery(v) < 0.3 && true"; gives "false" "false && battery(v) < 0.3";
    gives "true" "battery(v) < 0.3 || true"; gives "unknown" "battery(v) < 0.3 || false";
    gives "true" "true || battery(v) < 0.3"; gives "unknown" "(v + w).any { battery(it) < 0.3 }";
    gives "true" "(v + w).any { battery(it) > 0.3 }"; gives "false" "(v + w).every { battery(it) < 0.3 }";
    gives "unknown" "(v + w).every { battery(it) > 0.3 }"; gives "unknown" "(v + w).sum { battery(it) }";
    gives "[unknown, 1.0]" "(v + w).collect { battery(it) }";
    gives "1" "battery(v) ?: 1"; gives "0" "0 ?: 1"; gives "1.0" "battery(w) ?: 0.5";
    gives is_unknown "battery(v) < 0.3 ? 'low' : 'well'"; gives is_unknown "[1, 2][battery(v)]";
    gives is_unknown "(v + w) | { battery(it) > 0.3 }"; gives is_unknown "(v + w).max { battery(it) }";
    gives is_unknown "imcPlan { speed battery(v) }";
    guard false "battery(v) < 0.3"; guard false "!(battery(v) < 0.3)"; guard false "battery(v)";
    guard false "battery(v) < 0.3 ? 1 : 2"; guard true "battery(v) < 0.3 || true";
    guard true "(battery(v) ?: 0.1) < 0.3"; guard false "post(a: battery(v)) || true";
    case "a loop" (fun () ->
        Alcotest.(check string) "ending" is_unknown
          (Pure_run.ending (run ~world:with_silent (begun ^ "while (battery(v) > 0.3) { pause 1 }"))));
    case "an action fails" (fun () ->
        let run = run ~world:with_silent (begun ^ "execute action { if (battery(v) < 0.3) { post low: 1 } }") in
        Alcotest.(check string) "ending" is_unknown (Pure_run.ending run));
    case "posted" (fun () ->
        Alcotest.(check string) "ending" is_unknown
          (Pure_run.ending (run ~world:with_silent (begun ^ "post a: battery(v)"))));
    case "assure goes on" (fun () ->
        let run = run ~world:with_silent (begun ^ "execute action { message 'done' } assure { battery(v) > 0.3 }") in
        strings "said" [ "done" ] (Pure_run.said run)) ]

(* {1 When things happen} *)

let moments =
  [ case "the time of during is asked for when its turn comes" (fun () ->
        let run = run "n = 1\nexecute(action { n = 60 } >> during { n } run idle(1))" in
        Alcotest.(check bool) "set to 60" true (List.mem "set-time(60)" (Pure_run.labels run)));
    case "a task is built once, and runs as often as it is executed" (fun () ->
        strings "said" [ "a"; "a"; "a" ]
          (Pure_run.said (run "t = action { message 'a' }\nexecute(t >> t)\nexecute t")));
    case "one task on two vehicles" (fun () ->
        let run = run "v = pick { count 2; type 'UUV' }\nt = task('p')\nexecute(t[v[0]] | t[v[1]])" in
        let started = List.filter (fun l -> String.length l > 5 && String.sub l 0 5 = "start") (Pure_run.labels run) in
        strings "both" [ "start(noptilus-1, p)"; "start(noptilus-2, p)" ] started);
    case "who is picked, and waits for its turn, does not run" (fun () ->
        let run = run "v = pick { id 'noptilus-1' }\nexecute((action { message running(v) }) >> task('p')[v])" in
        strings "said" [ "false" ] (Pure_run.said run));
    case "captured when the closure is made" (fun () ->
        strings "said" [ "1"; "2"; "3" ]
          (Pure_run.said
             (run "ts = []\nfor (i in 1..3) { ts << action { message i } }\nfor (t in ts) { execute t }")));
    case "a failing task is blamed where it was written" (fun () ->
        let program, c = waiting "v = pick { id 'noptilus-1' }\n\nexecute   task('p')" in
        let c = after program c [ Vehicle_failed ("noptilus-1", "leak") ] in
        match c.control with
        | Ended (Failed fault) ->
          let at = Option.get (Fault.location program fault) in
          Alcotest.(check (pair int int)) "place" (3, 11) Dolphin_syntax.Location.(line at, column at)
        | _ -> Alcotest.fail "did not fail");
    case "a handler's verdict is of this error only" (fun () ->
        let source =
          "n = 0\ndef t() { watch action { 1 / 0 } onError { n = n + 1; if (n == 1) { ignore() } } }\n\
           execute(t() >> t())"
        in
        Alcotest.(check string) "the second propagates" "failed: division by zero" (Pure_run.ending (run source)));
    case "a host call waits, and goes on with the reply" (fun () ->
        let program, c = waiting "s = getSupplier()\nx = s.next(1)\npause 1" in
        let c = after program c [ Replied (Host "supplier"); Replied (Integer 7) ] in
        Alcotest.(check string) "x" "7" (variable program c "x")) ]

(* {1 Equality} *)

let list xs : Core.value = List (Vector.of_list xs)

(* In 60 levels, each of which holds the one below twice, with [last] between: an own copy at each call. *)
let doubled last =
  let rec from level x = if level = 0 then x else from (level - 1) (list [ x; last; x ]) in
  from 60 (list [ Integer 1 ])

let equality =
  let check what expected x y = Alcotest.(check bool) what expected (Value.equals x y) in
  [ case "of what is held many times" (fun () ->
        check "alike" true (doubled (Integer 2)) (doubled (Number 2.));
        check "not alike" false (doubled (Integer 2)) (doubled (Integer 3));
        check "not alike at the top" false (list [ doubled Null; Integer 1 ]) (list [ doubled Null; Integer 2 ]));
    case "of long lists, in their last elements" (fun () ->
        let long last = list (List.init 5_000 (fun i : Core.value -> Integer (if i = 4_999 then last else i))) in
        check "alike" true (list [ long 1; long 2 ]) (list [ long 1; long 2 ]);
        let one = long 1 in
        check "not alike" false (list [ one; one ]) (list [ long 1; long 2 ]));
    case "how many parts there are" (fun () ->
        let x = list [ Integer 1; Map [ ("k", list [ Null ]) ] ] in
        Alcotest.(check (list bool)) "of 5" [ false; true ] [ Value.has_at_most 4 x; Value.has_at_most 5 x ];
        Alcotest.(check bool) "of many" false (Value.has_at_most 1_000_000 (doubled Null))) ]

(* {1 Elements that are looked at} *)

let steps source = List.length (run source) - List.length (run "message 1") + 1

let many n body = Printf.sprintf "xs = (1..%d).toList()\nfor (i in 1..100) { %s }\nmessage xs.size()" n body

let list_of = list

let in_sets =
  let open QCheck2.Gen in
  let integer = map (fun i : Core.value -> Integer i) (int_range 0 3) in
  let number = oneof [ integer; map (fun i : Core.value -> Number (Stdlib.float i)) (int_range 0 3) ] in
  let map_of = map2 (fun x is_reversed : Core.value ->
      let entries = [ ("a", x); ("b", Core.Integer 1) ] in
      Map (if is_reversed then List.rev entries else entries)) in
  let long = map (fun x -> list_of (List.init 1_100 (fun _ -> x))) number in
  let value =
    frequency
      [ (6, number); (2, map list_of (list_size (int_range 0 3) number)); (2, map_of number bool); (2, long) ] in
  let print (x, ys) = Value.to_string (list_of [ x; list_of ys ]) in
  Property.case ~count:500 "as equality has it" ~print (pair value (list_size (int_range 0 8) value)) (fun (x, ys) ->
      let set = List.fold_left (fun set y -> Equal_values.add y set) Equal_values.empty ys in
      Equal_values.mem x set = List.exists (Value.equals x) ys)

let elements =
  let takes name least most source =
    case name (fun () ->
        let n = steps source in
        if n < least || n > most then Alcotest.failf "%d steps, %d to %d expected" n least most)
  in
  [ takes "of a short list" 1 3 (many 900 "ys = xs.sort()");
    takes "that are sorted" 20 40 (many 2_000 "ys = xs.sort()");
    takes "that are compared" 10 20 (many 100_000 "ys = xs.reverse() == xs");
    takes "that are copied, as several are added" 4 8 (many 100_000 "ys = xs + [1, 2]");
    takes "by index, and one more at the end" 1 3 (many 100_000 "xs << xs[i] + xs.size()");
    case "in code inside of a task" (fun () ->
        let source = many 200_000 "message xs.size()" in
        Alcotest.(check string) "few" "completed" (Pure_run.ending (run source));
        let endless = "xs = (1..200000).toList()\nexecute action { while (true) { xs = xs.sort() } }" in
        let ending = Pure_run.ending (run endless) in
        let part = Str.regexp_string "does not come to an end" in
        Alcotest.(check bool) ending true (try Str.search_forward part ending 0 > 0 with Not_found -> false));
    case "of which equal ones are left out" (fun () ->
        let numbers = "(1..100000).toList()" in
        strings "said" [ "100000, 1" ]
          (Pure_run.said
             (run
                (Printf.sprintf "xs = %s + %s\nys = xs.unique()\nmessage(\"${ys.size()}, ${(ys + [0] - xs).size()}\")"
                   numbers numbers)))) ]

let () =
  Alcotest.run "language"
    [ ( "without end",
        [ case "a script takes SCRIPT steps" endless_script; case "a long script" long_script;
          case "it can be interrupted" interrupted_script;
          case "it can be interrupted on its way home, once" on_the_way ] );
      ("answers", answers);
      ("picks", picks);
      ("tuples", tuples);
      ("unknown", unknown);
      ("elements", elements);
      ("sets of equal values", [ in_sets ]);
      ("moments", moments);
      ("equality", equality) ]
