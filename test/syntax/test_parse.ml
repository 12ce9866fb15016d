(* The meaning of a text, given as another text whose meaning is beyond doubt. *)

open Dolphin_syntax

let all name pairs =
  let check (source, other) = Alcotest.check Support.same source (Support.parse other) (Support.parse source) in
  [ Alcotest.test_case name `Quick (fun () -> List.iter check pairs) ]

let precedence =
  all "precedence"
    [ "a * b + c ** d", "(a * b) + (c ** d)";
      "a + b * c - d", "(a + (b * c)) - d";
      "a ** b ** c", "(a ** b) ** c";
      "-a ** b", "-(a ** b)";
      "-a * !b", "(-a) * (!b)";
      "-a.b[c]", "-((a.b)[c])";
      "a >> b | c >> d", "(a >> b) | (c >> d)";
      "a | b & c ^ d", "a | ((b & c) ^ d)";
      "a && b || c && d | e", "(a && b) || (c && (d | e))";
      "a + b >> c + d", "(a + b) >> (c + d)";
      "a << b + 1", "a << (b + 1)";
      "1..n - 1", "1..(n - 1)";
      "a < b == c >= d", "(a < b) == (c >= d)";
      "a in b + c", "a in (b + c)";
      "a == b & c != d", "(a == b) & (c != d)";
      "a ? b : c ? d : e", "a ? b : (c ? d : e)";
      "a ?: b ?: c", "a ?: (b ?: c)";
      "a || b ? c : d", "(a || b) ? c : d";
      "a / b / c % d", "((a / b) / c) % d";
      "t / { c }", "t / ({ c })";
      "x = a + -1", "x = a + (-1)";
      "a - ++b", "a - (++b)";
      "a++ + b", "(a++) + b";
      "+a", "a";
      "a >> b >> c", "(a >> b) >> c" ]

let newlines =
  all "newlines"
    [ "a\nb", "a; b"; "a\n+b", "a; +b"; "a +\nb", "a + b"; "a\n\n// c\n>> b", "a >> b"; "a\n| b\n| c", "a | b | c";
      "a\n.b()\n?.c", "a.b()?.c"; "a\n-b", "a; -b"; "f(a\n, b\n-c)", "f(a, b - c)"; "[a,\n b,\n]", "[a, b]";
      "a\n[b]", "a; ([b])";
      "a\n(b)", "a; (b)"; "x =\n 1", "x = 1"; "x = a ?\n b\n : c", "x = (a ? b : c)"; "f a,\n b", "f(a, b)";
      "f k:\n 1", "f(k: 1)";
      "f\n{ a }", "f; { a }"; "pick\n{ a }", "pick { a }"; "if (a)\n{ b }\n\nelse\n{ c }", "if (a) { b } else { c }";
      "if (a)\n b\nelse if (c)\n d\nelse\n e", "if (a) { b } else { if (c) { d } else { e } }";
      "while (a)\n b", "while (a) { b }";
      "for (i in a)\n{ b }", "for (i in a) { b }"; "def f(a,\n b)\n{\n}", "def f(a, b) { }";
      "if (a) { b } c", "if (a) { b }; c";
      "when { a }\n\n then b", "when { a } then b"; "waitFor\n{ a }\n// c\n run b", "waitFor { a } then b";
      "watch\n(a)\nonError\n{ b }", "watch a onError { b }";
      "until { a }\nrun\nb", "until { a } run b"; "x++\ny", "x++; y"; "++x\n--y", "++x; --y"; "return\na", "return; a";
      ";;a;;b;;", "a; b";
      "a /* c\n */ b", "a; b"; "a /* c */ + b", "a + b"; "xs.each { v ->\n a\n b\n}", "xs.each({ v -> a; b })";
      "{ a }\n{ b }", "{ a }; { b }";
      "if (a) b; else c", "if (a) { b } else { c }";
      "v = pick { a }\nelse { b }\nc", "v = pick { a } else { b }; c";
      "if (a) v = pick { b } else c", "if (a) { v = pick { b } } else { c }";
      "if (a) v = pick { b } else v = pick { c } else { d }", "if (a) { v = pick { b } } else { v = pick { c } else { d } }";
      "if (a) { pick { b } else { c } } else d", "if (a) { (pick { b } else { c }) } else { d }";
      "f(pick { a } else { b }.c, [pick { a } else { b }])", "f((pick { a } else { b }).c, [(pick { a } else { b })])"; "x = t\nuntil { a } run b", "x = t; until { a } run b";
      "x = (t\nuntil { a })", "x = until { a } run t"; "a\r\nb\r\n", "a; b" ]

(* A brace at the start of a statement opens a closure if it has parameters, and a block otherwise. *)
let closures =
  all "closures at the start of a statement"
    [ "f = { b -> { c -> } }", "f = { b -> ({ c -> }) }"; "f = { { c, d -> c } }", "f = { ({ c, d -> c }) }";
      "{ a -> b }", "({ a -> b })"; "def f() { a; { -> b } }", "def f() { a; ({ -> b }) }";
      "{ a -> b }.call(1); c", "({ a -> b }).call(1); c"; "a\n{ b -> c }\nd", "a; ({ b -> c }); d";
      "f = { a -> { b } }", "f = { a -> { b; } }" ]

let commands =
  all "commands"
    [ "message 'x'", "message('x')"; "pause 12.seconds", "pause(12.seconds)"; "post again: i", "post(again: i)";
      "move 200,0", "move(200, 0)";
      "goTo payload:[[name:'Sidescan', Range: 50]]", "goTo(payload: [[name: 'Sidescan', Range: 50]])";
      "region APDL, 2.km", "region(APDL, 2.km)";
      "q.add x", "q.add(x)"; "a?.b.c x, y", "a?.b.c(x, y)"; "location 41.18500, -8.70620", "location(41.185, -8.7062)";
      "message (v1+v2)", "message(v1 + v2)";
      "move (-30,-50)", "move(-30, -50)"; "f (x) + y", "(f(x)) + y"; "f [x]", "(f)[x]"; "f -1", "f - 1";
      "f { a }", "f({ a })"; "f(x) { a }", "f(x, { a })";
      "f x, { a }", "f(x, { a })"; "f x { a }", "f(x({ a }))"; "xs.each { v -> a }", "xs.each({ v -> a })";
      "count _", "count(_)"; "consume k:_", "consume(k: _)"; "poll _: 1", "poll(_: 1)"; "f 'k': 1", "f(k: 1)";
      "execute v1: task 'a', v2: task 'b'", "execute(v1: task('a'), v2: task('b'))";
      "message ask 'b?'", "message(ask('b?'))"; "t = task 'a'", "t = task('a')";
      "def t = task 'a', 2", "def t = task('a', 2)"; "return task 'a', 2", "return task('a', 2)";
      "x = (location 1, -2) ^ r.km", "x = location(1, -2) ^ r.km"; "f a ? b : c", "f(a ? b : c)"; "f !a", "f(!a)";
      "f null", "f(null)"; "f \"$a\"", "f(\"${a}\")";
      "f watch a onError { b }", "f(watch a onError { b })"; "f until { a } run b", "f(until { a } run b)";
      "f during 1.min run b", "f(during 1.min run b)";
      "f pick { a }", "f(pick { a })"; "f(g 1, 2)", "f(g(1), 2)"; "[g 1, 2]", "([g(1), 2])";
      "when { poll a: 1 } then task 'b'", "when { poll(a: 1) } then task('b')";
      "f run: 1, if: 2", "f('run': 1, 'if': 2)"; "imcPlan 'x'", "imcPlan('x')"; "f a.b { c }", "f(a.b({ c }))";
      "f x - 1", "f(x - 1)" ]

let tasks =
  all "tasks"
    [ "t1 = task 't1' during 2.seconds", "t1 = during 2.seconds run task('t1')";
      "execute t until { c }", "execute(until { c } run t)";
      "execute v: a until { c }, w: b during 2", "execute(v: until { c } run a, w: during 2 run b)";
      "a during 1 during 2", "during 2 run (during 1 run a)";
      "a >> waitFor { c } then b | d", "a >> (waitFor { c } then (b | d))";
      "waitFor { c } then a until { d }", "waitFor { c } then (until { d } run a)";
      "waitFor { c } run a", "waitFor { c } then a"; "during { d } run a >> b", "during { d } run (a >> b)";
      "watch a >> b onError { c } | d", "(watch (a >> b) onError { c }) | d";
      "execute ( idle(5.seconds)  until {  ++x == 100 } )", "execute(until { ++x == 100 } run idle(5.seconds))";
      "T[a] >> T[b]", "(T[a]) >> (T[b])"; "execute task('t')[v1] | t2", "execute((task('t')[v1]) | t2)";
      "choose { a }", "oneOf { a }";
      "pick { type: 'UAV' }", "pick {\n type: 'UAV'\n}"; "pick { run: 1; then: 2 }", "pick {\nrun: 1\nthen: 2\n}" ]

(* A suffix of a task binds tighter than every operator; so do its time and its condition. *)
let limits =
  all "limits behind tasks"
    [ "execute a during 5.min | b", "execute((during 5.min run a) | b)";
      "a within d >> b", "(within d run a) >> b"; "a >> b within d", "a >> (within d run b)";
      "a until { c } | b", "(until { c } run a) | b"; "a >> b until { c }", "a >> (until { c } run b)";
      "a assure { c } & b during 1", "(assure { c } run a) & (during 1 run b)";
      "a during 2 * n", "(during 2 run a) * n"; "a during (2 * n)", "during (2 * n) run a";
      "a during f(x)[1].min | b", "(during (f(x)[1].min) run a) | b"; "a during { d } | b", "(during { d } run a) | b";
      "!a during 1", "!(during 1 run a)"; "a.b[c](d) within 1", "within 1 run (a.b[c](d))";
      "c ? a during 1 : b during 2", "c ? (during 1 run a) : (during 2 run b)";
      "task 'a' during 1 | b", "task((during 1 run 'a') | b)"; "confirm 'a' within 1", "within 1 run confirm('a')";
      "execute a until { c } | during 3 run b", "execute((until { c } run a) | (during 3 run b))";
      "watch a onError { c } during 1 >> b", "(during 1 run (watch a onError { c })) >> b";
      "a | watch b onError { c } until { d }", "a | (until { d } run (watch b onError { c }))";
      "recruit { a } then { b } during 1 | c", "(during 1 run (recruit { a } then { b })) | c";
      "waitFor { c } then a | b during 1", "waitFor { c } then (a | (during 1 run b))";
      "during 1 run a | b during 2", "during 1 run (a | (during 2 run b))" ]

let rounds =
  all "until behind rounds"
    [ "repeat a until { c }", "(repeat a until { c })"; "x | repeat a >> b until { c }", "x | (repeat a >> b until { c })";
      "repeat waitFor { c } then { a } until { d }", "(repeat (waitFor { c } then { a }) until { d })";
      "repeat 2, during 1 run a | b until { d }", "(repeat 2, (during 1 run (a | b)) until { d })";
      "repeat (a until { c }) >> b until { d }", "(repeat ((until { c } run a) >> b) until { d })";
      "repeat a during 1 until { c }", "(repeat (during 1 run a) until { c })";
      "repeat a until { c } during 1", "during 1 run (repeat a until { c })";
      "repeat a until { c } until { d }", "until { d } run (repeat a until { c })";
      "repeat repeat a until { c } until { d }", "(repeat (repeat a until { c }) until { d })";
      "repeat watch a until { c } onError { d }", "repeat (watch (until { c } run a) onError { d })";
      "repeat f(a until { c }) until { d }", "(repeat f(until { c } run a) until { d })";
      "repeat a assure { c }", "repeat (assure { c } run a)"; "repeat a >> b during 1", "repeat (a >> (during 1 run b))";
      "(a | repeat b) during 1", "during 1 run (a | (repeat b))";
      "repeat task 'a' until { c }", "(repeat task('a') until { c })" ]

let limits_on_lines =
  all "limits on lines of their own"
    [ "execute a\nuntil { c }\nexecute b", "execute(until { c } run a); execute(b)";
      "x = a\n  during 5.min\n  assure { c }\ny", "x = (assure { c } run (during 5.min run a)); y";
      "x = a\nwithin d\n| b", "x = (within d run a) | b"; "x = a >>\n b\n during 1", "x = a >> (during 1 run b)";
      "x = a\nuntil { c } run b", "x = a; until { c } run b"; "x = a\nduring 5.min run b", "x = a; during 5.min run b";
      "x = a\nuntil { c } | during 3.min run b", "x = (until { c } run a) | (during 3.min run b)";
      "x = a\nduring d | during 3.min run b", "x = (during d run a) | (during 3.min run b)";
      "x = a\n\nduring d\nduring e run b", "x = during d run a; during e run b";
      "a\nduring x.until[1] run b", "a; during x.until[1] run b"; "a\nwithin x?.watch run b", "a; within x?.watch run b";
      "a\nduring x.run.min", "during x.run.min run a"; "a\nduring x\n.repeat run b", "a; during x.repeat run b";
      "f a, during x.then.within run b", "f(a, during x.then.within run b)";
      "a\nduring d & e run b", "a; during (d & e) run b"; "a\nwithin c >> d\n| e run b", "a; within (c >> d | e) run b";
      "f { a\n until { c } }", "f { until { c } run a }"; "repeat a\n until { c }", "(repeat a until { c })" ]

let words =
  all "words and numbers"
    [ "x.run.then.if", "x\n.run\n.then\n.if"; "pick = 1; pick + pos", "(pick) = 1; (pick) + (pos)";
      "2.km + 10.percent", "(2).km + (10).percent"; "1..3", "1 .. 3";
      "0..<n", "0 ..< n"; "1.5e3.m", "(1500.0).m"; "5L + 5G + 2d + 1.5f", "5 + 5 + 2.0 + 1.5"; "1_000", "1000";
      "0x1F", "31"; "'a\\u00e9\\n'", "'''aé\n'''"; "'\\ud83d\\udc2c'", "'🐬'";
      "\"a $b.c d ${e + \"f$g\"}\"", "\"a ${b.c} d ${e + \"f${g}\"}\""; "\"$5 $. $\"", "'$5 $. $'";
      "'a $b ${c}'", "'a $b ${c}'"; "\"\"\"a \"b\" ${c}\"\"\"", "\"a \\\"b\\\" ${c}\"";
      "\"${xs.collect {\n it }}\"", "\"${xs.collect { it }}\""; "[:]", "[ : ]";
      "[(a): 1, 'b': 2, 3: 4]", "[(a): 1, b: 2, (3): 4]"; "[a ? b : c]", "[(a ? b : c)]";
      "x = { -> a }()", "x = ({ -> a })()";
      "f({ a })", "f { a }"; "f { a } { b }", "f({ a }, { b })"; "f(a: 1,)", "f(a: 1)";
      "#!/usr/bin/env dolphin\na", "a" ]

let good path =
  Alcotest.test_case path `Quick (fun () ->
      let program = Support.parse (Support.read_file path) in
      let text = Support.printed program in
      Alcotest.check Support.same "printed and read again" program (Support.parse text);
      Alcotest.(check string) "printing is canonical" text (Support.printed (Support.parse text)))

let answers =
  let read source = Result.map Erase.expression (Parse.expression ~file:"answer" source) in
  let same (source, other) =
    match read source, read other with
    | Ok e, Ok e' -> Alcotest.(check bool) source true (e = e')
    | (Ok _ | Error _), (Ok _ | Error _) -> Alcotest.fail source in
  let refused source = Alcotest.(check bool) source true (Result.is_error (read source)) in
  [ Alcotest.test_case "answers" `Quick (fun () ->
        List.iter same [ " 2.5 ", "2.5"; "(location 1, 2)\n", "location(1, 2)"; "3.km", "(3).km" ];
        List.iter refused [ ""; "1 2"; "x = 1"; "a; b"; "\000"; "("; "'" ]) ]

let suite =
  List.concat
    [ precedence; newlines; closures; commands; tasks; limits; rounds; limits_on_lines; words; answers;
      List.map good [ "good/paper_one.dol"; "good/paper_two.dol"; "good/snippets.dol" ] ]
