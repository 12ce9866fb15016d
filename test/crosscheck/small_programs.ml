module Environment = Dolphin_environment.Environment
module World = Dolphin_semantics.World
module Generate = Test_support.Generate
open Case

let program ?failures ?(world = Generate.world) name source =
  of_text name source world (Environment.failing ?failures answering)

let two = "a = pick { id 'a' }; b = pick { id 'b' }\n"

let tasks =
  program "at most one failure" ~failures:1
    (two ^ "execute watch (task('p')[a] >> task('q')[b]) onError { ignore() }\nexecute task('p')[a]")
  :: List.map
    (fun (name, source) -> program name source)
    [ ("vehicles that a failure stops are free again",
       two ^ "execute (watch (task('p')[a] | task('q')[b]) onError { ignore() }) >> (task('q')[a] | task('p')[b])");
      ("a fault of an until's condition stops vehicles",
       two ^ "execute watch (until { 1 / 0 > 1 } run task('p')[a]) onError { ignore() }");
      ("a guard does not take a part",
       "post x: 1\nexecute condition { consume x: 1, y: 1 } | action { post y: 1 } >> condition { consume x: 1 }");
      ("faulty code leaves nothing",
       "x = 0\nexecute watch (action { post k: 1; x = 1; y = 1 / 0 }) onError { ignore() }\n\
        if (poll(k: 1) || x == 1) { message 'left' }");
      ("a handler that breaks leaves nothing",
       two ^ "execute watch (watch task('p')[a] onError { post k: 1; 1 / 0 }) onError { ignore() }\n\
              if (poll(k: 1)) { message 'left' }");
      ("faulty code keeps its messages",
       "execute watch (action { message 'a'; post k: 1; 1 / 0 }) onError { message 'b'; ignore() }");
      ("a guard that is false did nothing",
       "post k: 1\nexecute condition { consume k: 1; false } | condition { poll k: 1 }");
      ("patterns take the oldest that satisfies them",
       "post x: 3, x: 1, x: 2, y: 'a'\n\
        execute waitFor { consume x: { it < 3 }, y: 'a' } then action { message count(x: _) }\n\
        execute waitFor { poll(x: { it > 2 }) && consume(x: { k -> k != 3 }) } then action { message count(x: { it == 3 }) }\n\
        if (consume(x: { it > 3 })) { message 'never' }");
      ("patterns of two that wait, and a part",
       "post x: 1, x: 2\n\
        execute (condition { consume x: { it > 1 } } | condition { consume x: _ } | action { post x: 3 }) \
        >> condition { count(x: _) == 1 }");
      ("keys that are computed",
       "for (i in 1..2) { post \"r$i\": i, ('x'): i }\npost([a: 1, b: 2])\nk = 'r2'\n\
        execute condition { consume((k): 2, ('x'): 1) } >> action { message poll((k): _) }\n\
        z = null\nexecute watch action { post((z): 1) } onError { e -> message e; ignore() }\n\
        f = { it > 1 }\nexecute watch action { consume(x: f) } onError { e -> message e; ignore() }");
      ("areas with corners",
       "b = polygon([location(0, 0), location(0, 0.1), location(0.1, 0)], holes: [[location(0.01, 0.01), \
        location(0.01, 0.02), location(0.02, 0.01)]])\nc = polygon([location(0, 0), location(0, 0.1), location(0.1, 0)])\n\
        for (p in [location(0.03, 0.03), location(0, 0), location(0.1, 0.1), location(0.012, 0.012)]) {\n\
        message \"${p in b} ${c.contains(p)}\" }\nmessage \"$b $c ${b == c}\"\n\
        execute watch action { message c.radius } onError { e -> message e; ignore() }");
      ("what ?: takes",
       "a = pick { id 'a' }\nfor (x in [null, false, 0, 0.5, '', [], [:], a - a, a]) { post y: (x ?: 'other') }\n\
        b = battery(a) ?: 1\nif (b < 0.3) { message 'low' }");
      ("until stops what runs, or what did not start",
       two ^ "execute (until { poll x: 1 } run (task('p')[a] >> task('q')[a])) | action { post x: 1 }");
      ("assure stops what runs, or what did not start, and fails",
       two ^ "execute watch ((assure { !poll(x: 1) } run (task('p')[a] >> task('q')[a])) | action { post x: 1 })\n\
              onError { why -> message why; ignore() }");
      ("effects of a violated assure condition are undone",
       "post x: 1\nexecute watch (assure { consume x: 1; false } run idle(1.seconds)) onError { ignore() }\n\
        if (poll(x: 1)) { message 'there' }");
      ("code makes tasks of what was taken, and they compete for two vehicles",
       two ^ "post goal: 1, goal: 2\n\
              execute (waitFor { consume goal: _ } then { g -> task(\"p$g\") }) | (waitFor { consume goal: _ } then { g -> task(\"p$g\") })\n\
              | task('q')[a]");
      ("a task that was made holds its vehicle until it ends",
       two ^ "execute ({ task('p') >> action { post x: 1 } >> idle(1.seconds) })[a] | ({ task('q') })[a]");
      ("a task to come holds its vehicle",
       two ^ "execute (idle(1.seconds) >> task('p')[a]) | { task('q') | task('r') } | condition { idle(a).isEmpty() }");
      ("who runs: not before the start, not between two tasks, not after an error",
       two ^ "execute watch ((task('p')[a] >> idle(1.seconds) >> task('p')[a]) | (condition { running(a) } \
              >> condition { !running(a) } >> task('q')[b])) onError { message \"${running(a)} ${running(b)}\"; ignore() }\n\
              message running(a)");
      ("a violated assure stops running vehicles before handlers ask",
       two ^ "execute watch (assure { !running(b) } run (task('p')[a] | task('q')[b])) onError { \
              if (!running(a) && !running(b)) { message 'stopped' }\nignore() }\n\
              execute watch action { running(a + b) } onError { e -> message e; ignore() }");
      ("no vehicle can ever run the made task", two ^ "execute watch ({ task('p') | task('q') }[b]) onError { ignore() }");
      ("code that makes a task does something",
       "def f() { post x: 1; idle(1.seconds) }\nexecute watch { f() } onError { why -> message why; ignore() }");
      ("timers of tasks that are made", two ^ "execute (idle(1.seconds) within 5.seconds) | { idle(2.seconds) | ({ idle(3.seconds) } within 4.seconds) }");
      ("a question lets a vehicle start, and another one works meanwhile",
       two ^ "execute watch ((confirm('go?') >> task('p')[a]) | task('q')[b]) onError { why -> message why; ignore() }");
      ("a question that is withdrawn, in rounds",
       two ^ "execute repeat 2, watch ((confirm('go?') | { confirm(\"go $a?\") }) within 5.seconds) onError { ignore() }");
      ("a question beside a timer, both in a task that is made",
       two ^ "execute watch { confirm('go?') | idle(1.seconds) } onError { e -> confirm(e) >> task('p')[a] }");
      ("two rounds of whoever comes, beside a task that waits for a vehicle",
       "a = pick { id 'a' }\n\
        execute repeat 2, watch recruit { type 'UUV' } then { v -> task('p')[v] } onError { ignore() } | { task('q') }");
      ("no vehicle is recruited twice, and a cut-off releases the recruited one",
       "execute (recruit { } then { task('p') } | recruit { type 'UUV' } then { idle(2.seconds) }) within 5.seconds");
      ("what is made runs on its own vehicle only, its timers and recruits are new",
       "a = pick { id 'a' }\n\
        execute watch { recruit { id 'b' } then { (task('p') >> idle(1.seconds)) | task('q') } } onError { why -> message why; ignore() }\n\
        | { recruit { type 'UAV' } then { idle(1.seconds) } }");
      ("only a recruited vehicle is stopped, and the task of an interruption has it",
       "onInterrupt task('q')\na = pick { id 'a' }\nexecute task('p')[a] >> recruit { id 'b' } then { task('q') }");
      ("whom a task recruited is free for the next one",
       "a = pick { id 'a' }\nexecute (recruit { id 'b' } then { task('p') }) >> recruit { id 'b' } then { task('q') }\nrelease a");
      ("two races of the same tasks at once, one of which has an error",
       two ^ "def race(t) { fresh { k -> until { consume((k): 1) } run t >> action { post((k): 1) } } }\n\
              execute (watch race(task('p')[a]) onError { ignore() }) | (idle(1.seconds) >> race(task('q')[b]))");
      ("fresh keys in rounds that are cut off, and no pair is left of a round before",
       "execute repeat 2, fresh { k -> (action { post((k): 1) } >> idle(1.seconds) >> action { post((k): 1, x: 1) }) | idle(2.seconds) } \
        during 3.seconds\nif (consume(x: 1)) { message 'one' }");
      ("a task with two fresh keys is tried again, beside one that is made of them",
       two ^ "def t(n) { fresh { k, l -> (action { post((k): n) } >> { fresh { m -> condition { poll((k): n) } >> action { post((m): n) } >> task('p')[a] } }) \
              | action { post((l): n) } } }\n\
              execute (watch t(1) >> action { post again: 1 } onError { poll('again') ? retry() : ignore() }) | { t(2)[b] within 2.seconds }");
      ("a task whose keys are new each time that it is tried, while another is made",
       two ^ "execute { (watch fresh { k -> action { post((k): 1) } >> task('p')[a] } onError { consume(again: 1) ? retry() : ignore() }) \
              | (task('q')[b] >> { fresh { k -> condition { !poll((k): 1) } >> idle(1.seconds) } }) } | action { post again: 1 }");
      ("the oldest pair of a fresh key is taken, beside another key; what is left of both is forgotten",
       "execute fresh { k, l -> (action { post((k): 2, (l): 2, x: 2) } >> action { post((k): 1, (l): 1, x: 1) }) \
        | (waitFor { consume((k): _) } then { n -> action { post x: 10 + n } }) }\n\
        execute waitFor { poll(x: { it > 10 }) && consume(x: 12) } then action { message count(x: _) }");
      ("the oldest pair of a key that is computed otherwise",
       "post x: 2, x: 1, y: 3\nks = ['x', 'y']\n\
        execute (condition { consume((ks[0]): _) } | action { post y: 4 }) >> condition { consume((ks[1]): { it < 5 }) }");
      ("code of fresh that fails, and that does something",
       "def f() { post x: 1; idle(1.seconds) }\n\
        execute watch { fresh { k -> 1 / 0 } } onError { e -> message e; fresh { k -> f() } }");
      ("ensured deeds: at the end, by an error beside it, a time, a condition",
       two ^ "n = 0\nexecute watch ((task('p')[a] ensure { post x: 1; n = 1 }) | (task('q')[b] ensure { post x: 2 } ensure { n = 2 })) \
              onError { ignore() }\nmessage \"$n ${count(x: _)}\"\n\
              execute ((idle(2.seconds) ensure { post y: 1 }) during 1.seconds >> (idle(1.seconds) ensure { post y: 2 }) | condition { consume(y: 1) }) \
              until { consume(y: 2) }");
      ("a pair that is used is given back by failures and cuts, before its task is made and after",
       two ^ "post lift: 'e', lift: 'w'\n\
              execute (using lift: _ run { l -> task(\"p$l\")[a] }) during 1.seconds | (watch using lift: 'w' run task('q')[b] onError { ignore() })\n\
              message count(lift: _)");
      ("an interruption does ensured deeds before its own task begins",
       "onInterrupt { vs -> waitFor { consume x: 1 } then idle(1.seconds) }\na = pick { id 'a' }\nexecute task('p')[a] ensure { post x: 1 }");
      ("within a time, and not",
       two ^ "execute watch ((task('p')[a] | task('q')[b]) within 10.seconds) onError { why -> message why; ignore() }");
      ("rounds by number, of parts that run together",
       two ^ "execute repeat 2, (task('p')[a] | (task('q')[b] >> idle(1.seconds)))");
      ("rounds until a condition holds, which takes what it asks for",
       "execute repeat (action { post k: 1 } >> idle(1.seconds)) until { consume k: 1, k: 1 }\n\
        if (poll(k: 1)) { message 'left' }");
      ("a limited number of rounds, and a condition not evaluated after the last",
       "execute repeat 2, (idle(1.seconds) >> action { post k: 1 }) until { consume k: 1, k: 1 }\n\
        if (poll(k: 1)) { message 'left' }");
      ("rounds at most so many, and a condition that breaks",
       "execute watch (repeat 3, (idle(1.seconds) >> action { post k: 1 }) until { consume(k: 1, k: 1) ? 1 / 0 : false })\n\
        onError { ignore() }");
      ("endless rounds that a time ends, with errors inside",
       two ^ "execute during 9.seconds run repeat ((watch task('p')[a] onError { ignore() }) | task('q')[b])");
      ("no rounds, or half a one",
       "n = 0\nif (poll(k: 1)) { execute repeat n, idle(1.seconds) }\nexecute repeat n + 0.5, idle(1.seconds)");
      ("a task is tried again, as long as there is a pair",
       two ^ "post again: 1, again: 2\n\
              execute watch (task('p')[a] | idle(1.seconds)) onError { e -> if (consume(again: _)) retry() else ignore() }");
      ("a task that is tried again takes what is free",
       two ^ "execute (watch { task('p') } onError { e -> post lost: e.vehicle; retry() })[a + b] | task('q')[b] \n\
              if (poll(lost: a)) { message 'a failed' }");
      ("a failed vehicle is dismissed, and another one takes over",
       two ^ "execute watch { task('p') } onError { e -> dismiss e.vehicle; retry() }");
      ("a vehicle needed elsewhere is not dismissed",
       two ^ "execute watch (task('p')[a] | task('q')[b] >> watch { task('r') } onError { e -> dismiss a; retry() })\n\
              onError { e -> dismiss e.vehicle; if (e.vehicle == a) dismiss b; ignore() }\n\
              execute watch (repeat 2, watch task('p')[a] onError { e -> dismiss e.vehicle; ignore() })\n\
              onError { e -> message e; ignore() }\nrelease a");
      ("a vehicle needed later is not dismissed",
       two ^ "execute watch ((watch task('p')[a] onError { dismiss a; ignore() }) >> task('q')[a]) onError { e ->\n\
              message e; ignore() }");
      ("a task that was made dismisses whom it holds",
       two ^ "execute { watch task('p')[a] onError { dismiss a; ignore() } } | { watch task('q')[b] onError { dismiss b } }");
      ("a task in the place of another, of which the error tells",
       two ^ "execute watch task('p')[a] onError { e -> e.task == 'p' ? task('q')[b] >> idle(1.seconds) : idle(2.seconds) }");
      ("code that fails, and an error of no vehicle",
       two ^ "execute watch action { fail 'no' } onError { e -> e.vehicle ? task('p') : action { post k: 1 } }");
      ("tasks in the place of tasks, timers in them",
       two ^ "def deep(n) { watch (task('p') within 5.seconds) onError { n > 0 ? deep(n - 1) : idle(1.seconds) } }\n\
              execute deep(2) | idle(3.seconds)");
      ("within a time given by code", "execute idle(1.seconds) within { post asked: 1; consume asked: 1; 3 }");
      ("an error skips the rest",
       two ^ "execute watch (task('p')[a] >> task('q')[b] >> task('q')[a]) onError { ignore() }");
      ("a handler that does nothing propagates", two ^ "execute watch task('p')[a] onError { post k: 1 }");
      ("a condition that breaks", "execute watch condition { 1 / 0 } onError { ignore() }");
      ("a guard that breaks", "execute watch (oneOf { when { 1 / 0 } then idle(1.seconds) }) onError { ignore() }");
      ("one of two guards that breaks",
       "execute watch (allOf { when { 1 / 0 } then idle(1.seconds)\n when { poll x: 1 } then idle(2.seconds) })\n\
        onError { ignore() }");
      ("a script that breaks", "x = 1\npost k: x\nx / 0");
      ("a script that computes for long", "x = 0\nwhile (x < 2000) { x = x + 1 }\npost k: x");
      ("the oldest pair", "post k: 1\npost k: 2\nexecute condition { consume k: _ } >> condition { consume k: 2 }");
      ("a pair twice is there twice",
       "post k: 1\npost k: 1\nexecute condition { consume k: 1 } >> condition { consume k: 1 }");
      ("equal values are one pair",
       two ^ "post team: a + b, of: [k: b + a, l: 1], of: [l: 2]\n\
              execute condition { consume team: b + a } | condition { consume of: [l: 1.0, k: a + b] }\n\
              if (!poll('team')) { post team: b + a }");
      ("equal values in a queue",
       two ^ "post team: a + b, team: a\n\
              execute condition { consume team: b + a } >> condition { consume team: _ } | condition { poll team: a }");
      ("a handler's deeds",
       two ^ "execute watch task('p')[a] onError { post failed: 1; ignore() }\n\
              if (consume(failed: 1)) { message 'seen' }");
      ("pairs taken by a false condition are there again",
       "post k: 1\nexecute repeat idle(1.seconds) until { consume(k: 1) && poll(y: 1) }");
      ("a handler's halt", two ^ "execute (watch task('p')[a] onError { halt 'enough' }) | task('q')[b]");
      ("three branches, one at a time",
       two ^ "execute allOf { when { true } then task('p')[a] \n when { true } then task('q')[b] \n\
             \ when { poll x: 1 } then action { post y: 1 } } | action { post x: 1 }");
      ("a timer that is not needed any more", two ^ "execute (during 10.seconds run task('p')[a]) >> idle(5.seconds)");
      ("code that computes the time", "execute during { post asked: 1; 3 } run condition { consume asked: 1 }");
      ("released, and picked again", two ^ "release a\nc = pick { id 'a' }\nexecute task('p')[c] | task('q')[b]");
      ("a handler tells of it, and what stops has been told to",
       two ^ "execute watch (task('p')[a] | task('q')[b] | idle(5.seconds)) onError { message 'x'; ignore() }");
      ("a handler prints something, and so does another one",
       two ^ "execute watch (watch task('p')[a] onError { message 'x' }) onError { message 'y'; ignore() }");
      ("a handler's halt, and timers that run or are cancelled",
       two ^ "execute (watch (during 5.seconds run task('p')[a]) onError { halt 'x' }) | idle(5.seconds)");
      ("timeouts of one vehicle, and of all",
       two ^ "setConnectionTimeout b, 10\nexecute action { setConnectionTimeout 20; setConnectionTimeout a, 30 }");
      ("which two of three", "v = pick { count 2 }\nexecute task('p') | task('q')");
      ("not enough for all", "v = pick { id 'a' }\nexecute task('p') | task('q')");
      ("an assertion that no watch sees",
       two
       ^ "execute watch (assert({ poll x: 1 }, 'x is there') | action { post x: 1 } | task('p')[a]) \
          onError { ignore() }") ]

(* In a world where the batteries of a and c are open, b's is 1 or 0.2, and c is in one of two places; their other
   sensors are open too. *)
let sensors =
  let one ?(world = Generate.open_world) (name, source) = program ~world ("sensors: " ^ name) source in
  let three = two ^ "c = pick { id 'c' }\n" and low = "battery(a) < 0.3" and charged = "battery(a) >= 0.3" in
  List.map (fun case -> one case)
    [ ("a guard", two ^ "execute (waitFor { " ^ low ^ " } then task('p')[a]) | task('q')[b]");
      ("until", two ^ "execute (task('p')[a] / { " ^ low ^ " }) | condition { " ^ charged ^ " }");
      ("an assertion", two ^ "execute task('p')[a] | assert({ battery(a) > 0.1 }, 'low')");
      ("a time", two ^ "execute during { " ^ low ^ " ? 5 : 10 } run task('p')[a]");
      ("one battery against another",
       three ^ "message battery(a) < battery(c)\nmessage (battery(a) < battery(b) && battery(c) > battery(a))");
      ("of two batteries one is low", three ^ "if (" ^ low ^ " && battery(c) >= 0.3) { halt 'a is low' }");
      ("the same comparison again", two ^ "message ((" ^ low ^ ") == (" ^ low ^ "))");
      ("a comparison and its opposite", two ^ "message (" ^ low ^ " && " ^ charged ^ ")");
      ("the same at another step", two ^ "execute condition { " ^ low ^ " } >> condition { " ^ charged ^ " }");
      ("kept, and compared later",
       two ^ "h = battery(a)\npost x: 1\nif (h < 0.3 && " ^ charged ^ ") { halt 'charged' }");
      ("kept twice", two ^ "h = battery(a)\npost x: 1\ni = battery(a)\npost x: 1\nif (h < 0.3 && i >= 0.3) { halt h }");
      ("kept by a task",
       two ^ "h = 1\nexecute (action { h = battery(a) }) >> condition { h < 0.3 && " ^ charged ^ " }");
      ("kept by a local",
       two ^ "def f(l) { post x: 1; return l < 0.3 && " ^ charged ^ " }\nif (f(battery(a))) { halt 'charged' }");
      ("kept by a caller",
       two ^ "def g() { post x: 1; return 1 }\ndef f(l) { y = g(); message l; return y }\nmessage f(battery(a)) + 1");
      ("kept by an argument",
       two ^ "def f(l, x, m) { message l; return l < m && " ^ charged ^ " }\n"
       ^ "post x: 1\nif (f(battery(a), consume(x: 1), 0.3)) { halt 'charged' }");
      ("told of",
       two ^ "message \"${(battery(a) * 100 - 1).round()} percent\"\nmessage 'at ' + position(a)\n\
              message(-battery(a))");
      ("computed with",
       two
       ^ "message Math.max(battery(a), 0.5) > 0.7 && position(a).distance(Location.APDL) / 2 < 100 \
          && Location.APDL in (position(a) ^ 10)");
      ("equal", two ^ "message battery(a) == 1\nmessage battery(a) != 'x'\nmessage position(a).equals(Location.APDL)");
      ("in an area",
       two
       ^ "execute waitFor { position(a) in (Location.APDL ^ 150) || position(b) in (Location.APDL ^ 150) } \
          then task('p')[a]");
      ("outcomes that are one",
       two ^ "execute action { if (" ^ low ^ ") { post x: 1 } else { post x: 1 } }\nif (" ^ low
       ^ ") { post y: 1 } else { post y: 1 }");
      ("one outcome, by two rules",
       two ^ "execute watch (watch task('p')[a] onError { if (" ^ low ^ ") { ignore() } }) onError { ignore() }");
      ("a handler sees what the code saw",
       two ^ "execute watch (action { if (" ^ low ^ ") { 1 / 0 } else { 2 / 0 } }) onError { if (" ^ low
       ^ ") { post x: 1; ignore() } }");
      ("a handler sees what another one saw",
       two ^ "execute watch (watch task('p')[a] onError { if (" ^ low
       ^ ") { post x: 1 } }) onError { if (" ^ charged ^ ") { ignore() } }");
      ("kept by one handler, and compared by another",
       two ^ "h = battery(a)\n\
              execute watch (watch task('p')[a] onError { if (h < 0.3) { post low: 1; h = battery(a) } }) \
              onError { if (h >= 0.3) { post high: 1 } ; ignore() }");
      ("a link", three ^ "execute (task('p')[a] / { !connected(a) }) | waitFor { connected(c) } then task('q')[b]");
      ("a link seen twice in one step", two ^ "message connected(a)\nif (connected(a) && !connected(a)) { halt 'both' }");
      ("speeds", two ^ "s = speed(b)\npost x: 1\nmessage s > speed(b)\nmessage speed(a) == 0");
      ("measurements",
       three ^ "execute waitFor { reading(a, 'T') < 15 } then task('p')[b]\nmessage reading(c, 'T')\n\
                message reading(c, 'T') + reading(a, 'T') > 30 || reading(b, 'T') == 12");
      ("the date: open at each step, and one thing within a step",
       two ^ "execute waitFor { now() >= 5 && consume(x: 1) } then task('p')[a] | action { post x: 1 }\n\
              if (now() < 5 && now() >= 5) { halt 'both' }\nmessage now()\nmessage \"${now() + 1} s\"");
      ("the time of day: open at each step, and one thing within a step",
       two ^ "execute waitFor { timeOfDay() >= timeOfDay('21:30') && consume(x: 1) } then task('p')[a] | action \
              { post x: 1 }\nif (timeOfDay() < 5 && timeOfDay() > 6) { halt 'both' }\nmessage \"${timeOfDay() + 1} s\"");
      ("comparisons with several numbers in one step",
       two ^ "if (now() != 0) { message 'a' } else if (now() > 5) { halt 'both' }\n\
              if (battery(a) < 0.3 && 0.5 < battery(a)) { halt 'both' } else if (battery(a) >= 0.3) { message 'b' }");
      ("the date, kept and compared later",
       two ^ "h = now()\nexecute task('p')[a] until { now() - h > 3 }\nif (h == 2 || 2 * now() <= h) { message h }");
      ("a loop that looks again and again", two ^ "while (battery(a) >= 0.3) { pause 5 }");
      ("one of several values",
       two ^ "message battery(b)\nif (battery(b) == 1 && battery(b) < 0.3) { halt 'both' }\nmessage battery(b)");
      ("several values of two sensors",
       three ^ "if (battery(b) < 0.3) { message position(c) in (Location.APDL ^ 1.km) }");
      ("picked where it is seen",
       "v = pick { id 'c'; region Location.APDL, 1.km }\nrelease v\nv = pick { id 'c'; region Location.APDL, 1.km }");
      ("beside one that is bound",
       "c = pick { id 'c' }\nv = pick { count _; region Location.APDL, 1.km }\n\
        w = pick { id 'c'; region Location.APDL, 1.km }");
      ("all that are seen there", "v = pick { count _; region Location.APDL, 1.km }");
      ("picked in a place, and seen in another one",
       "v = pick { id 'c'; region Location.APDL, 1.km }\nmessage position(v)");
      ("the nearer one",
       three ^ "t = imcPlan { planName 'q'\n locate 41.2032, -8.7048\n goTo() }\nexecute t\nexecute t | t");
      ("the nearer one, as was seen in this step",
       three ^ "if (position(c) in (Location.APDL ^ 1.km)) {\nexecute imcPlan { planName 'q'\n\
               \ locate 41.2032, -8.7048\n goTo() }\n}") ]
  @ [ one ~world:(World.open_position "c" [] Generate.open_world)
        ("coordinates",
         two
         ^ "if (position(a).latitude > 41 && position(a).bearing(Location.APDL) < 90) \
            { message position(a).longitude - 1 }");
      { (program ~world:Generate.open_world "sensors: an answer"
           "a = pick { id 'a' }\nh = ask 'how many?'\npost x: 1\nif (h < 0.3 && battery(a) >= 0.3) { halt h }\n\
            message ask('how many?') < 0.3 && battery(a) < 0.3")
        with prompts = [ "how many?" ];
             environment =
               (let rounds = [ [ "battery(a)" ]; [ "battery(a) < 0.3 ? battery(a) : 1 / 0"; "1 / 0" ] ] in
                { answering with answers = (fun _ -> rounds) }) } ]

let supplied = "s = getSupplier()\n"

(* Calls of the supplier that [Calls] stands in for. *)
let calls =
  List.map
    (fun (name, source) -> program name (supplied ^ source))
    [ ("replies that differ from one call to the next", "x = s.level\ny = s.level\nz = s.level\npost k: y");
      ("a call for which there is no reply", two ^ "x = s.level\ny = s.nothing(x)");
      ("a reply that fails the second time", two ^ "s.next()\nexecute s.next()");
      ("replies of two objects", "t = s.self\nx = s.level + t.level\nt = s.self\nx = t.level");
      ("what a host object is", "t = s.self\nif (s == t) { post same: t } else { post other: t }\nm = [a: s, b: [t]]\n\
                                 if (s && s in m.b) { message \"${m} ${s}\" }\nconsume other: t\nmessage s[0]");
      ("wrong uses of a host object", "x = s + 1");
      ("methods of an object with names of the language", "s.add(1)\nmessage s\ns.ready()\nmessage s.size()");
      ("calls that differ in their arguments", "x = s.level(ask 'how many?', [s])");
      ("calls in code of tasks",
       two
       ^ "h = s.self\nt = watch action { post x: 1; y = h.level } onError { e -> message e; ignore() }\n\
          execute t >> watch condition { h.ready(1) } onError { e -> message e; ignore() }");
      ("tasks of a supplier, executed twice",
       two ^ "t = s.next()\nexecute watch (t[a] | t[b]) onError { ignore() }\nexecute t >> s.self.next()");
      ("an object in a closure", "f = { s.level }\nx = f() + f()\nexecute watch action { f() } onError { ignore() }");
      ("asked again and again", "while (s.ready()) { message 'on' }") ]

(* Programs at rest in each way in which they can wait, and at work. *)
let interruptions =
  let programs =
    [ ("interrupted while vehicles run",
       two ^ "post k: 1\nexecute (task('p')[a] >> task('q')[a]) | task('q')[b] | idle(5.seconds)");
      ("interrupted while it waits",
       "v = pick { count _ }\nx = ask 'how many?'\npause 3.seconds\n" ^ supplied ^ "post k: s.level\nrelease v");
      ("interrupted where it is stuck", "v = pick { id 'a' }\nexecute condition { consume k: 1 }");
      ("interrupted within an until, and a handler",
       two
       ^ "t = until { poll x: 1 } run (task('p')[a] | during 2.seconds run task('q')[b])\n\
          execute watch t onError { post x: 1; ignore() }");
      ("interrupted again and again", "while (true) { post k: 1; consume k: 1 }");
      ("interrupted, and the picked vehicles go home",
       "onInterrupt { vs -> def t = task('p')[vs[0]] within 1.seconds; if (vs.size() > 1) { t = t | task('q')[vs[1]] }; t }\n"
       ^ two ^ "execute during 2.seconds run (task('q')[a] | idle(5.seconds))");
      ("interrupted before there is a way home", "onInterrupt home[a]\n" ^ two ^ "pause 1.seconds\nhome = task('p')");
      ("interrupted, and too few can go home", "onInterrupt { task('p') | task('q') }\na = pick { id 'a' }\npost k: 1");
      ("interrupted, and what is executed halts or waits in vain",
       "onInterrupt oneOf { when { consume k: 1 } then action { halt 'here' }; when { poll k: 2 } then task('p') }\n\
        a = pick { id 'a' }\npost k: 1\nconsume k: 1") ]
  in
  let kinds = [ ("", interrupted answering); (", with all faults once", interrupted all_once) ] in
  let one (name, source) (kind, environment) = { (program (name ^ kind) source) with environment } in
  List.concat_map (fun program -> List.map (one program) kinds) programs

(* Programs with pairs from outside at any time; one of them comes for certain. *)
let inputs =
  let posting = { answering with inputs = Test_support.Posts.inputs } in
  let programs =
    [ ("posted while it waits", "input 'x', 'y'\nx = ask 'how many?'\npause 3.seconds\nif (poll(x: 2)) { halt 'two' }");
      ("posted while vehicles run",
       "input 'x', 'y'\n" ^ two ^ "execute until { poll x: 3 } run (task('p')[a] | waitFor { consume y: 1 } then task('q')[b])");
      ("posted, the oldest first",
       "input 'x'\npost x: 9\nexecute condition { consume x: _ } >> condition { consume x: 2 } >> condition { consume x: _ }");
      ("inputs need not come", "input 'x'\nexecute condition { consume x: 1 }");
      ("undeclared keys are not posted", "input 'y'\nexecute condition { consume x: 1 }") ]
  in
  let one (name, source) = { (program name source) with environment = posting } in
  List.map one programs
  @ [ { (program "posted until it is interrupted" "input 'y'\npause 1") with
        environment = interrupted { answering with inputs = Test_support.Posts.inputs } } ]

let failing =
  let always name text = of_text name (two ^ text) Generate.world { answering with endings = (fun _ _ -> Fails) } in
  [ always "a plan that always fails" "execute watch (task('p')[a] | task('q')[b]) onError { ignore() }";
    always "the failed vehicle and task"
      "execute watch task('p')[b] onError { e -> post who: e.vehicle, what: e.task; ignore() }";
    always "another task for the vehicles that were given" "execute (watch action { 1 / 0 } onError { task('q') })[b]" ]

let questions =
  let asking name answers source = { (program name source) with environment = { answering with answers } } in
  [ asking "a question without an answer" (fun _ -> []) "x = ask 'how many?'";
    asking "answers that are refused" (fun _ -> [ [ "y"; "1 / 0" ]; [ "2"; "post(k: 1)" ] ]) "x = ask 'how many?'" ]

(* Some of the transitions of these leave all as it is. *)
let loops =
  let charging = "a = pick { id 'a' }\nwhile (battery(a) >= 0.3) { message 'charging' }" in
  let loop name source = of_text name source Generate.world answering in
  [ loop "the same message again and again" "while (true) { message 'x' }";
    of_text "a message while a sensor shows this" charging Generate.open_world answering;
    loop "a loop that does nothing" "while (true) { }";
    loop "messages by turns" "while (true) { message 'x'; message 'y' }";
    of_text "a message until it is interrupted" "while (true) { message 'x' }" Generate.world (interrupted answering) ]

(* Each waits for something of another kind, which comes. *)
let ends =
  List.map
    (fun (name, source) -> of_text name source Generate.world answering)
    [ ("an answer comes", "x = ask 'how many?'");
      ("a task ends", two ^ "execute task('p')[a] | task('q')[b]");
      ("a timer expires", "execute idle(5.seconds) >> idle(5.seconds)");
      ("a program goes on", "x = 0\nwhile (x < 3) { x = x + 1; message x }");
      ("rounds without end", "execute repeat idle(5.seconds)") ]

let verdicts =
  let is_stuck (c : Case.t) = c.name = "interrupted where it is stuck" in
  let once = { answering with inputs = Test_support.Posts.once } in
  let source = "input 'x'\nexecute condition { consume x: 1 }" in
  let nobody_posts = of_text "inputs need not come, nor can they come twice" source Generate.world once in
  let stuck = nobody_posts :: List.filter is_stuck interruptions in
  List.hd loops :: stuck @ ends @ List.tl loops

(* Questions that are answered by yes or no. *)
let confirmed =
  let asked name source = of_text name source Generate.world { answering with answers = (fun _ -> []) } in
  [ asked "a task goes on if the answer is yes" "execute confirm('go?')";
    asked "an answer of no is an error" "execute watch confirm('go?') onError { why -> message why; ignore() }" ]

let lost_once = "v = pick { id 'a' }\nt = watch task('p')[v] onError { post failed: 1; ignore() }\nexecute t\n"

(* Each with losses and with vehicles that are late, with and without bounds. *)
let faults =
  let programs =
    [ ("a lost vehicle may be lost again, and that is no other loss", lost_once ^ "execute t\nexecute t");
      ("nothing is heard of a lost vehicle when another one is picked", lost_once ^ "w = pick { id 'b' }\nexecute t");
      ("of two vehicles, one after the other",
       two ^ "execute watch (task('p')[a] | task('q')[b]) onError { ignore() }\nexecute task('q')[b] >> task('p')[a]");
      ("a lost vehicle is missing, or is there",
       lost_once ^ "release v\nw = pick { id 'a'; timeout 1.seconds }\nexecute t");
      ("all but the lost one", lost_once ^ "release v\nw = pick { count _ }");
      ("two, less who is lost", lost_once ^ "release v\nw = pick { count 2 }");
      ("late for two picks", "v = pick { count 2; type 'UUV' }\nrelease v\nw = pick { count _ }");
      ("late, or else another one", lost_once ^ "release v\nw = pick { count 2; type 'UUV' } else { pick { count 1 } }\n\
                                                 x = pick { count 2 } else { post k: w; w }\nx = pick { count _ } else { null }\npost k: x\nrelease w\nx = pick { count _ }");
      ("two, or else those that come then",
       "v = pick { count 2; type 'UUV' } else { null }\nw = pick { type 'UUV' } else { null }");
      ("late in a place, or else none",
       "v = pick { region Location.APDL, 150 } else { post k: 1 }\n\
        w = pick { count _; region Location.APDL, 150; timeout 0.seconds } else { post k: 2 }");
      ("late in a place",
       "v = pick { region Location.APDL, 150 }\nw = pick { count _; region Location.APDL, 150; timeout 0.seconds }") ]
  in
  let kinds =
    [ ("with losses", with_losses Any_number); ("with a loss", with_losses (At_most 1));
      ("with latecomers", with_latecomers Any_number); ("with all faults once", all_once) ]
  in
  let one (name, source) (kind, environment) =
    { (program (name ^ ", " ^ kind) source) with environment }
  in
  List.concat_map (fun program -> List.map (one program) kinds) programs

let all = tasks @ failing @ questions @ confirmed @ calls @ inputs @ interruptions @ sensors @ loops @ ends @ faults
