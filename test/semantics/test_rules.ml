open Dolphin_semantics
open Test_support

(* Somewhere in the program's state graph there is this transition. *)
type example = {
  rule : Rule.t;
  shows : string;
  source : string;
  label : string;
  derivation : string;
  next : string;  (* the rest of the execution, or the step of the script *)
  effects : string list;
}

let pick_v = "v = pick { id 'noptilus-1' }\n"
let pick_both = pick_v ^ "w = pick { id 'noptilus-2' }\n"

(* [%p] is a platform task of vehicle [v], [%q] one of [w]. *)
let task text =
  let replace target by text = String.concat by (Str.split_delim (Str.regexp_string target) text) in
  pick_both ^ "execute(" ^ replace "%p" "task('p')[v]" (replace "%q" "task('q')[w]" text) ^ ")"

let released = "release noptilus-1, noptilus-2"

let example rule shows source label derivation next effects =
  { rule; shows; source; label; derivation; next; effects }

let tasks : example list =
  [ example Start "a vehicle begins" (task "%p") "start(noptilus-1, p)" "START" "p[noptilus-1]..."
      [ "start p on noptilus-1" ];
    example Done "a vehicle ends its task" (task "%p") "done(noptilus-1, p)" "DONE, EXECUTE-DONE" "script" [];
    example Fail "a vehicle fails" (task "%p") "fail(noptilus-1, p, broken)" "FAIL, EXECUTE-ERR"
      "failed: p failed on noptilus-1: broken"
      [ released; "end: p failed on noptilus-1: broken" ];
    example Action "code runs in one step" (task "action { post a: 1; post b: 2 } >> idle(1)") "act(post a:1; post b:2)"
      "ACTION, SEQ-2" "idle(1)" [ "set timer 1 to 1 s" ];
    example Action_err "code breaks" (task "action { post a: 1; 1 / 0 }") "broken(division by zero)"
      "ACTION-ERR, EXECUTE-ERR" "failed: division by zero" [ released; "end: division by zero" ];
    example Action_err "what it said stays said" (task "action { message 'a'; post a: 1; message 'b'; 1 / 0 }")
      "broken(division by zero)" "ACTION-ERR, EXECUTE-ERR" "failed: division by zero"
      [ "say a"; "say b"; released; "end: division by zero" ];
    example Condition_err "what it said stays said"
      (task "watch (condition { message 'a'; 1 / 0 } | during 5 run %q) onError { message 'b'; 1 / 0 }")
      "broken(division by zero)" "CONDITION-ERR, PAR-ERR, WATCH-PROPAGATE, EXECUTE-ERR" "failed: division by zero"
      [ "say a"; "cancel timer 1"; "say b"; released; "end: division by zero" ];
    example Assert_err "what was said before stays said" (task "action { message 'a'; assert { false } }")
      "broken(assertion failed)" "ASSERT-ERR" "failed: assertion failed"
      [ "say a"; released; "end: assertion failed" ];
    example Condition "true at last" (task "condition { poll(a: 1) } | action { post a: 1 }") "check"
      "CONDITION, EXECUTE-DONE" "script" [];
    example Condition_err "its code breaks" (task "condition { 1 / 0 }") "broken(division by zero)"
      "CONDITION-ERR, EXECUTE-ERR" "failed: division by zero" [ released; "end: division by zero" ];
    example Assert_err "nothing handles it" (task "watch (%p | assert { false }) onError { ignore() }")
      "broken(assertion failed)" "ASSERT-ERR" "failed: assertion failed" [ released; "end: assertion failed" ];
    example Assert_err "in any code of a task, its text computed then"
      (task "watch (condition { x = 3; assert { x < 2 }, \"x is $x\" } | during 5 run %q) onError { ignore() }")
      "broken(assertion failed: x is 3)" "ASSERT-ERR" "failed: assertion failed: x is 3"
      [ "cancel timer 1"; released; "end: assertion failed: x is 3" ];
    example Seq_1 "the first part goes on" (task "%p >> idle(1)") "start(noptilus-1, p)" "START, SEQ-1"
      "(p[noptilus-1]... >> idle(1))" [ "start p on noptilus-1" ];
    example Seq_2 "the first part ends, the next is active" (task "%p >> idle(1)") "done(noptilus-1, p)" "DONE, SEQ-2"
      "idle(1)" [ "set timer 1 to 1 s" ];
    example Seq_err "what follows a failure never starts"
      (task "(watch (%p >> idle(1)) onError { ignore() }) >> idle(2)")
      "fail(noptilus-1, p, broken)" "FAIL, SEQ-ERR, WATCH-IGNORE, SEQ-2" "idle(2)" [ "set timer 2 to 2 s" ];
    example Par_1 "the left goes on" (task "%p | %q") "start(noptilus-1, p)" "START, PAR-1"
      "(p[noptilus-1]... | q[noptilus-2])" [ "start p on noptilus-1" ];
    example Par_1 "the right goes on" (task "%p | %q") "start(noptilus-2, q)" "START, PAR-1"
      "(p[noptilus-1] | q[noptilus-2]...)" [ "start q on noptilus-2" ];
    example Par_2 "one branch is left" (task "%p | %q") "done(noptilus-2, q)" "DONE, PAR-2" "p[noptilus-1]..." [];
    example Par_err "the sibling is stopped" (task "watch (%p | (during 5 run %q)) onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "cancel timer 1"; "stop noptilus-2" ];
    example Par_err "the sibling that has not started is forgotten" (task "watch (%p | %q) onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Par_err "what stops inside comes before what is cancelled around it"
      (task "watch (during 60 run (%p | %q)) onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, DURING-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "stop noptilus-2"; "cancel timer 1" ];
    example Allof_when "any ready branch"
      (task "allOf { when { poll(a: _) } then idle(1)\nwhen { true } then idle(2) }")
      "check" "ALLOF-WHEN" "allOf { idle(2); when { when } then idle(1) }" [ "set timer 2 to 2 s" ];
    example Allof_1 "the branch goes on" (task "allOf { when { false } then idle(1)\nwhen { true } then %p }")
      "start(noptilus-1, p)" "START, ALLOF-1" "allOf { p[noptilus-1]...; when { when } then idle(1) }"
      [ "start p on noptilus-1" ];
    example Allof_2 "the branch ends, the others are left"
      (task "allOf { when { false } then idle(1)\nwhen { true } then %p }")
      "done(noptilus-1, p)" "DONE, ALLOF-2" "oneOf { when { when } then idle(1) }" [];
    example Allof_err "the branch fails, the others never start"
      (task "watch (allOf { when { false } then idle(1)\nwhen { true } then %p }) onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, ALLOF-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Allof_err "a guard breaks" (task "allOf { when { 1 / 0 } then idle(1)\nwhen { true } then %p }")
      "broken(division by zero)" "ALLOF-ERR, EXECUTE-ERR" "failed: division by zero"
      [ released; "end: division by zero" ];
    example Oneof_when "the guard's deeds are part of the step"
      ("post a: 1\n" ^ task "oneOf { when { consume a: 1 } then idle(1)\nwhen { true } then idle(2) }")
      "check(consume a:1)" "ONEOF-WHEN" "idle(1)" [ "set timer 1 to 1 s" ];
    example Oneof_when "any of the ready branches"
      ("post a: 1\n" ^ task "oneOf { when { consume a: 1 } then idle(1)\nwhen { true } then idle(2) }")
      "check" "ONEOF-WHEN" "idle(2)" [ "set timer 2 to 2 s" ];
    example Oneof_err "a guard breaks" (task "oneOf { when { 1 / 0 } then idle(1)\nwhen { true } then idle(2) }")
      "broken(division by zero)" "ONEOF-ERR, EXECUTE-ERR" "failed: division by zero"
      [ released; "end: division by zero" ];
    example Until_cut "what runs is stopped"
      (task "(until { consume a: 1 } run during 5 run %p) | action { post a: 1 }")
      "cut(consume a:1)" "UNTIL-CUT, EXECUTE-DONE" "script" [ "cancel timer 1"; "stop noptilus-1" ];
    example Until_cut "before anything started" (task "until { true } run %p") "cut"
      "UNTIL-CUT, EXECUTE-DONE" "script" [];
    example Assure_cut "what runs is stopped, and it fails"
      (task "(assure { !poll(a: 1) } run during 5 run %p) | action { post a: 1 }")
      "cut" "ASSURE-CUT, EXECUTE-ERR" "failed: assure: { !poll(a: 1) } does not hold"
      [ "cancel timer 1"; "stop noptilus-1"; released; "end: assure: { !poll(a: 1) } does not hold" ];
    example Assure_cut "what its condition did is undone"
      ("post a: 1\n" ^ task "watch (assure { message 'm'; consume(a: 1) && false } run %p) onError { ignore() } >> condition { consume a: 1 }")
      "cut" "ASSURE-CUT, WATCH-IGNORE, SEQ-2" "condition { condition }" [];
    example Assure_cut "before anything started" (task "watch (assure { 1 > 2 } run %p) onError { ignore() }") "cut"
      "ASSURE-CUT, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Assure_cut "by a return" (task "watch (assure { if (2 > 1) { return false }; true } run %p) onError { ignore() }")
      "cut" "ASSURE-CUT, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Until_1 "an assured task goes on" (task "assure { 2 > 1 } run %p") "start(noptilus-1, p)" "START, UNTIL-1"
      "assure { 2 > 1 } run p[noptilus-1]..." [ "start p on noptilus-1" ];
    example Until_2 "an assured task ends by itself" (task "assure { true } run %p") "done(noptilus-1, p)"
      "DONE, UNTIL-2, EXECUTE-DONE" "script" [];
    example Until_err "the condition of assure breaks, the task is stopped"
      (task "watch (assure { 1 / 0 } run %p) onError { ignore() }")
      "broken(division by zero)" "UNTIL-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "stop noptilus-1" ];
    example Until_1 "the task goes on" (task "until { false } run %p") "start(noptilus-1, p)" "START, UNTIL-1"
      "until { until } run p[noptilus-1]..." [ "start p on noptilus-1" ];
    example Until_2 "the task ends by itself" (task "until { false } run %p") "done(noptilus-1, p)"
      "DONE, UNTIL-2, EXECUTE-DONE" "script" [];
    example Until_err "the task fails" (task "until { false } run %p") "fail(noptilus-1, p, broken)"
      "FAIL, UNTIL-ERR, EXECUTE-ERR" "failed: p failed on noptilus-1: broken"
      [ released; "end: p failed on noptilus-1: broken" ];
    example Until_err "the condition breaks, the task is stopped"
      (task "watch (until { 1 / 0 } run %p) onError { ignore() }")
      "broken(division by zero)" "UNTIL-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "stop noptilus-1" ];
    example Make "code gives a task, with what its guard took"
      ("post a: 7\n" ^ task "waitFor { consume a: _ } then { x -> task(\"p$x\")[v] }")
      "make" "MAKE" "unallocated task('p7')[noptilus-1]" [];
    example Make "its turn comes after the part before" (task "%p >> { %q }") "make" "MAKE"
      "unallocated task('q')[noptilus-2]" [];
    example Make_err "it does not only compute"
      ("def f(t) { post a: 1; t }\n" ^ task "watch { f(%p) } onError { message it; ignore() }")
      "broken({ f task('p')[v] } makes a task, so it may only compute: it must not post, consume, assign or print)"
      "MAKE-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "say { f task('p')[v] } makes a task, so it may only compute: it must not post, consume, assign or print" ];
    example Make_err "it gives no task" (task "watch { 7 } onError { message it; ignore() }")
      "broken({ 7 }: expected a task, found a number, 7)" "MAKE-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "say { 7 }: expected a task, found a number, 7" ];
    example Make_err "it takes what nobody gives" (task "[{ x -> %p }][0]")
      "broken({ closure } takes 1 value, and its guard took none)" "MAKE-ERR, EXECUTE-ERR"
      "failed: { closure } takes 1 value, and its guard took none"
      [ released; "end: { closure } takes 1 value, and its guard took none" ];
    example Allocate "vehicles that nobody holds" (task "{ task('a') } | %p") "allocate(noptilus-2)" "ALLOCATE, PAR-1"
      "(holding noptilus-2 a[noptilus-2] | p[noptilus-1])" [];
    example Allocate "what a task holds is there for what it makes" (task "{ %p >> { task('b') } }")
      "allocate(noptilus-1)" "ALLOCATE, HOLD-1" "holding noptilus-1 holding noptilus-1 b[noptilus-1]" [];
    example Allocate "what a task was given it holds until it ends" (task "{ task('a') >> idle(3) } | { task('b') }")
      "allocate(noptilus-2)" "ALLOCATE, PAR-1" "(holding noptilus-1 idle(3) | holding noptilus-2 b[noptilus-2])" [];
    example Allocate "timers start, with numbers that are not used" (task "idle(3) | { idle(1) }") "allocate()"
      "ALLOCATE, PAR-1" "(idle(3) | idle(1))" [ "set timer 1000002 to 1 s" ];
    example Allocate_err "none can ever fit" (task "watch ({ task('a')[v] }[w]) onError { ignore() }")
      "cannot-execute(no vehicle can run task 'a': the vehicle set given to it is empty)"
      "ALLOCATE-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Allocate_err "neither now nor later" (task "%p | { task('a') | task('b') | task('c') }")
      "cannot-execute(tasks 'a', 'b', 'c' run side by side and need different vehicles, but there is only noptilus-1, \
       noptilus-2)"
      "ALLOCATE-ERR, PAR-ERR, EXECUTE-ERR"
      "failed: tasks 'a', 'b', 'c' run side by side and need different vehicles, but there is only noptilus-1, \
       noptilus-2"
      [ released;
        "end: tasks 'a', 'b', 'c' run side by side and need different vehicles, but there is only noptilus-1, noptilus-2" ];
    example Hold_1 "it holds on" (task "{ %p }") "start(noptilus-1, p)" "START, HOLD-1"
      "holding noptilus-1 p[noptilus-1]..." [ "start p on noptilus-1" ];
    example Hold_2 "it ends, and holds no longer" (task "{ %p }") "done(noptilus-1, p)" "DONE, HOLD-2, EXECUTE-DONE"
      "script" [];
    example Hold_err "it fails, and holds no longer" (task "watch { %p } onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, HOLD-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Recruit "whoever fits, and nobody of B" (task "recruit { type 'UUV' } then { x -> task('a') } | %p")
      "recruit(noptilus-3)" "RECRUIT, PAR-1" "(recruited noptilus-3 { task 'a' } | p[noptilus-1])"
      [ "bind noptilus-3" ];
    example Recruit "nobody twice"
      (task "recruit { type 'UAV' } then { idle(1) } | recruit { } then { idle(2) }")
      "recruit(noptilus-3)" "RECRUIT, PAR-1" "(recruited x8-02 idle(1) | recruited noptilus-3 { idle 2 })"
      [ "bind noptilus-3" ];
    example Allocate "of a task that recruited, its own vehicle"
      (task "recruit { type 'UAV' } then { x -> task('a') >> task('b')[x] } | { task('c') }") "allocate(x8-02)"
      "ALLOCATE, RECRUIT-1, PAR-1"
      "(recruited x8-02 holding x8-02 (a[x8-02] >> b[x8-02]) | { task 'c' })" [];
    example Allocate_err "nobody is given whom another task recruited"
      (task "recruit { type 'UAV' } then { task('a') } | { task('c') | task('d') | task('e') }")
      "cannot-execute(tasks 'c', 'd', 'e' run side by side and need different vehicles, but there is only noptilus-1, \
       noptilus-2)"
      "ALLOCATE-ERR, PAR-ERR, EXECUTE-ERR"
      "failed: tasks 'c', 'd', 'e' run side by side and need different vehicles, but there is only noptilus-1, \
       noptilus-2"
      [ "release x8-02"; released;
        "end: tasks 'c', 'd', 'e' run side by side and need different vehicles, but there is only noptilus-1, noptilus-2" ];
    example Recruit_1 "its vehicle works" (task "recruit { type 'UAV' } then { task('a') }") "start(x8-02, a)"
      "START, HOLD-1, RECRUIT-1" "recruited x8-02 holding x8-02 a[x8-02]..." [ "start a on x8-02" ];
    example Recruit_2 "its vehicle is released" (task "(recruit { type 'UAV' } then { task('a') }) >> idle(1)")
      "done(x8-02, a)" "DONE, HOLD-2, RECRUIT-2, SEQ-2" "idle(1)" [ "release x8-02"; "set timer 3 to 1 s" ];
    example Recruit_err "its vehicle is released before the handler runs"
      (task "watch recruit { type 'UAV' } then { task('a') } onError { message 'm'; ignore() }")
      "fail(x8-02, a, broken)" "FAIL, HOLD-ERR, RECRUIT-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "release x8-02"; "say m" ];
    example During_cut "whom a task recruited is released with it"
      (task "during 60 run (recruit { type 'UAV' } then { task('a') } | idle(9))") "timeout" "DURING-CUT, EXECUTE-DONE"
      "script" [ "cancel timer 4"; "stop x8-02"; "release x8-02" ];
    example Interrupt "whom a task recruited is released at the end" "execute(recruit { } then { task('a') })" "interrupt"
      "INTERRUPT" "interrupted" [ "stop noptilus-3"; "release noptilus-3"; "end: interrupted" ];
    example On_interrupt "whom a task recruited is brought home as well"
      "onInterrupt { vs -> task('home') }\nexecute(recruit { id 'noptilus-3' } then { task('a') })" "interrupt"
      "ON-INTERRUPT" "script" [ "stop noptilus-3" ];
    example Fresh_1 "it has keys of its own, from left to right" (task "fresh { k -> %p } | fresh { k, l -> idle(1) }")
      "start(noptilus-1, p)" "START, FRESH-1, PAR-1" "(fresh #1 p[noptilus-1]... | fresh #2, #3 idle(1))"
      [ "start p on noptilus-1" ];
    example Fresh_1 "its keys are known to the code of its task" (task "fresh { k -> action { post((k): 7) } >> idle(1) }")
      "act(post #1:7)" "ACTION, SEQ-2, FRESH-1" "fresh #1 idle(1)" [ "set timer 2 to 1 s" ];
    example Fresh_2 "it is done" (task "fresh { k -> %p } >> idle(1)") "done(noptilus-1, p)" "DONE, FRESH-2, SEQ-2"
      "idle(1)" [ "set timer 2 to 1 s" ];
    example Fresh_err "it fails" (task "watch fresh { k -> %p } onError { ignore() }") "fail(noptilus-1, p, broken)"
      "FAIL, FRESH-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Allocate "keys in a task that is made are new" (task "fresh { k -> idle(3) } | { fresh { k -> idle(1) } }")
      "allocate()" "ALLOCATE, PAR-1" "(fresh #1 idle(3) | fresh #1000003 idle(1))" [ "set timer 2000003 to 1 s" ];
    example Alloc_err "code of fresh is faulty" (task "fresh { k -> 1 / 0 }") "cannot-execute(division by zero)"
      "ALLOC-ERR" "failed: division by zero" [ released; "end: division by zero" ];
    example Allocate_err "code of fresh does more than compute"
      ("def f(t) { post a: 1; t }\n" ^ task "watch { fresh { k -> f(%p) } } onError { ignore() }")
      "cannot-execute({ f task('p')[v] } makes a task, so it may only compute: it must not post, consume, assign or print)"
      "ALLOCATE-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Ensure_1 "it goes on" (task "%p ensure { post x: 1 }") "start(noptilus-1, p)" "START, ENSURE-1"
      "p[noptilus-1]... ensure { post x: 1 }" [ "start p on noptilus-1" ];
    example Ensure_2 "its end does the ensured deeds" (task "%p ensure { post x: 1 } >> condition { poll x: 1 }")
      "done(noptilus-1, p)" "DONE, ENSURE-2, SEQ-2" "condition { condition }" [];
    example Ensure_err "so does its error, before the handler"
      (task "watch (%p ensure { post x: 1 }) onError { message poll(x: 1); ignore() }") "fail(noptilus-1, p, broken)"
      "FAIL, ENSURE-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "say true" ];
    example Idle_end "the time is up" (task "idle(5) >> idle(1)") "timeout" "IDLE-END, SEQ-2" "idle(1)"
      [ "set timer 2 to 1 s" ];
    example Confirm_yes "somebody says yes" (task "confirm('go?') >> idle(1)") "answer(yes)" "CONFIRM-YES, SEQ-2" "idle(1)"
      [ "set timer 2 to 1 s" ];
    example Confirm_yes "a vehicle works meanwhile" (task "(%p >> confirm('one?')) | confirm('two?')") "answer(yes)"
      "CONFIRM-YES, PAR-2" "(p[noptilus-1]... >> confirm('one?'))" [];
    example Confirm_no "somebody says no" (task "watch (confirm('go?') >> %p) onError { e -> message e; ignore() }")
      "answer(no)" "CONFIRM-NO, SEQ-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "say 'go?' was answered no" ];
    example Confirm_no "nobody handles a no, and what runs beside stops" (task "confirm('go?') | during 5 run %p")
      "answer(no)" "CONFIRM-NO, PAR-ERR, EXECUTE-ERR" "failed: 'go?' was answered no"
      [ "cancel timer 2"; released; "end: 'go?' was answered no" ];
    example Within_cut "a question that is not answered in time is withdrawn" (task "confirm('go?') within 60") "timeout"
      "WITHIN-CUT, EXECUTE-ERR" "failed: not done within 60 s"
      [ "withdraw question 2"; released; "end: not done within 60 s" ];
    example Seq_2 "a question is put when its turn comes" (task "%p >> confirm('go?')") "done(noptilus-1, p)"
      "DONE, SEQ-2" "confirm('go?')" [ "put question 1: go?" ];
    example During_set "code gives the time when the task starts" (task "during { 2 * 30 } run %p") "set-time(60)"
      "DURING-SET" "during 60 run p[noptilus-1]" [ "set timer 1 to 60 s" ];
    example During_cut "what runs is stopped" (task "during 60 run %p") "timeout" "DURING-CUT, EXECUTE-DONE" "script"
      [ "stop noptilus-1" ];
    example During_cut "inner timers are cancelled" (task "during 60 run (%p | idle(5))") "timeout"
      "DURING-CUT, EXECUTE-DONE" "script" [ "cancel timer 2"; "stop noptilus-1" ];
    example Within_cut "what runs is stopped, and it fails" (task "(%p | idle(5)) within 60") "timeout"
      "WITHIN-CUT, EXECUTE-ERR" "failed: not done within 60 s"
      [ "cancel timer 2"; "stop noptilus-1"; released; "end: not done within 60 s" ];
    example Within_cut "a time given by code" (task "watch (%p within { 2 * 30 }) onError { error -> message error; ignore() }")
      "timeout" "WITHIN-CUT, WATCH-IGNORE, EXECUTE-DONE" "script" [ "stop noptilus-1"; "say not done within 60 s" ];
    example During_set "code says within which time" (task "within { 2 * 30 } run %p") "set-time(60)"
      "DURING-SET" "within 60 run p[noptilus-1]" [ "set timer 1 to 60 s" ];
    example During_2 "the task ends within its time" (task "%p within 60") "done(noptilus-1, p)"
      "DONE, DURING-2, EXECUTE-DONE" "script" [ "cancel timer 1" ];
    example During_err "code gives no time to be done within"
      (task "watch (within { 'soon' } run %p) onError { ignore() }")
      "broken(within takes a time of 0 seconds or more, this code gives soon)"
      "DURING-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example During_1 "the task goes on" (task "during 60 run %p") "start(noptilus-1, p)" "START, DURING-1"
      "during 60 run p[noptilus-1]..." [ "start p on noptilus-1" ];
    example During_2 "the task ends in time" (task "during 60 run %p") "done(noptilus-1, p)"
      "DONE, DURING-2, EXECUTE-DONE" "script" [ "cancel timer 1" ];
    example During_err "the task fails in time" (task "watch (during 60 run %p) onError { ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, DURING-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "cancel timer 1" ];
    example During_err "code gives no time, and leaves no effect but what it said"
      (task "watch (during { message 'm'; 'soon' } run %p) onError { ignore() }")
      "broken(during takes a time of 0 seconds or more, this code gives soon)"
      "DURING-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [ "say m" ];
    example Watch_1 "the task goes on" (task "watch %p onError { }") "start(noptilus-1, p)" "START, WATCH-1"
      "watch p[noptilus-1]..." [ "start p on noptilus-1" ];
    example Watch_2 "the task ends well" (task "watch %p onError { }")
      "done(noptilus-1, p)" "DONE, WATCH-2, EXECUTE-DONE"
      "script" [];
    example Watch_ignore "siblings inside stop, the handler runs, what follows starts: in one step"
      (task "(watch (%p | %q) onError { message it; ignore() }) >> idle(1)")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, WATCH-IGNORE, SEQ-2" "idle(1)"
      [ "stop noptilus-2"; "say p failed on noptilus-1: broken"; "set timer 1 to 1 s" ];
    example Watch_ignore "vehicles of what the error cut off are idle to the handler"
      (task "watch (%p | %q) onError { message idle(v + w).size(); ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "stop noptilus-2"; "say 2" ];
    example Watch_ignore "those of what is beside the watch are not"
      (task "(watch (%p | idle(5)) onError { message idle(v + w).size(); ignore() }) | %q")
      "fail(noptilus-1, p, broken)" "FAIL, PAR-ERR, WATCH-IGNORE, PAR-2" "q[noptilus-2]"
      [ "cancel timer 1"; "say 1" ];
    example Watch_propagate "the error climbs to the next watch"
      (task "watch (watch %p onError { message 'in' }) onError { message 'out'; ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-PROPAGATE, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "say in"; "say out" ];
    example Watch_propagate "a handler that breaks is an error itself, and leaves no effect but what it said"
      (task "watch (watch %p onError { message 'in'; ignore(); 1 / 0 }) onError { message it; ignore() }")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-PROPAGATE, WATCH-IGNORE, EXECUTE-DONE" "script"
      [ "say in"; "say division by zero" ];
    example Watch_propagate "tasks in the place of others nest too deep"
      (pick_both ^ "def t() { watch action { 1 / 0 } onError { t() } }\nexecute t()") "broken(division by zero)"
      "ACTION-ERR, WATCH-PROPAGATE, EXECUTE-ERR"
      "failed: tasks in the place of tasks that failed nest more than 100 deep"
      [ released; "end: tasks in the place of tasks that failed nest more than 100 deep" ];
    example Watch_halt "the program ends" (task "(watch (during 5 run %p) onError { message 'm'; halt 'enough' }) | %q")
      "fail(noptilus-1, p, broken)" "FAIL, DURING-ERR, WATCH-HALT" "halted: enough"
      [ "cancel timer 1"; "say m"; "stop noptilus-2"; released; "end: halted enough" ];
    example Watch_retry "the task runs anew, allocated anew, what ran beside it is stopped"
      (task "watch (%p | %q) onError { retry() }") "fail(noptilus-2, q, broken)" "FAIL, PAR-ERR, WATCH-RETRY"
      "watch unallocated task('p')[noptilus-1] | task('q')[noptilus-2]" [ "stop noptilus-1" ];
    example Watch_retry "only if the handler says so"
      (task "watch %p onError { e -> message \"${e.task} of ${e.vehicle}: ${e.message}\"; if (e.task == 'p') retry() }")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-RETRY" "watch unallocated task('p')[noptilus-1]"
      [ "say p of noptilus-1: p failed on noptilus-1: broken" ];
    example Watch_retry "a vehicle is dismissed, which ran beside"
      (task "watch (%p | %q) onError { e -> dismiss e.vehicle; retry() }") "fail(noptilus-2, q, broken)"
      "FAIL, PAR-ERR, WATCH-RETRY" "watch unallocated task('p')[noptilus-1] | task('q')[noptilus-2]"
      [ "stop noptilus-1"; "release noptilus-2" ];
    example Watch_ignore "who is not bound is not dismissed twice"
      (task "watch watch %p onError { e -> dismiss e.vehicle } onError { e -> dismiss e.vehicle; ignore() } >> idle(5)")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-PROPAGATE, WATCH-IGNORE, SEQ-2" "idle(5)"
      [ "release noptilus-1"; "set timer 1 to 5 s" ];
    example Watch_propagate "nobody dismisses whom a task beside is to run on"
      (task "watch (watch %p onError { post k: 1; dismiss v + w } | %q) onError { e -> e.contains('dismissed') ? idle(5) : null }")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-PROPAGATE, PAR-ERR, WATCH-INSTEAD" "unallocated idle(5.seconds)" [];
    example Watch_propagate "nor whom one after it is to run on"
      (task "watch (watch %p onError { e -> dismiss e.vehicle; ignore() } >> %p) onError { e -> idle(5) }")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-PROPAGATE, SEQ-ERR, WATCH-INSTEAD" "unallocated idle(5.seconds)" [];
    example Watch_instead "another task in its place" (task "(watch %p onError { task('r') }) >> idle(5)")
      "fail(noptilus-1, p, broken)" "FAIL, WATCH-INSTEAD, SEQ-1" "(unallocated task('r') >> idle(5))" [];
    example Watch_instead "an error of code is of no vehicle"
      (task "watch action { fail 'no' } onError { e -> e.vehicle ? %p : idle(e.task ? 1 : 5) }") "broken(no)"
      "ACTION-ERR, WATCH-INSTEAD" "unallocated idle(5.seconds)" [];
    example Allocate_err "of a task that runs anew: the handler's again"
      (task "watch ({ task('a')[v - v] }) onError { e -> e.contains('empty') ? idle(5) : retry() }")
      "cannot-execute(no vehicle can run task 'a': the vehicle set given to it is empty)" "ALLOCATE-ERR, WATCH-INSTEAD"
      "unallocated idle(5.seconds)" [];
    example Repeat_1 "the round goes on" (task "repeat 2, %p") "start(noptilus-1, p)" "START, REPEAT-1"
      "repeat (p[noptilus-1]...; 1, p[noptilus-1])" [ "start p on noptilus-1" ];
    example Repeat_2 "the next round begins in the same step, with its timers" (task "repeat %p")
      "done(noptilus-1, p)" "DONE, REPEAT-2" "repeat (p[noptilus-1]; p[noptilus-1])" [];
    example Repeat_2 "each round counts once" (task "repeat 3, idle(5)") "timeout" "IDLE-END, REPEAT-2"
      "repeat (idle(5); 1, idle(5))" [ "set timer 1 to 5 s" ];
    example Repeat_2 "the last round is no repeat any more" (task "repeat 2, idle(5)") "timeout" "IDLE-END, REPEAT-2"
      "idle(5)" [ "set timer 1 to 5 s" ];
    example Repeat_2 "the condition is to be asked" (task "repeat %p until { poll a: 1 }") "done(noptilus-1, p)"
      "DONE, REPEAT-2" "repeat (p[noptilus-1] until { repeat })" [];
    example Repeat_until "what the condition did remains"
      (task "repeat action { post a: 1 } until { consume a: 1 }") "check(consume a:1)"
      "REPEAT-UNTIL, EXECUTE-DONE" "script" [];
    example Repeat_again "what the condition did is undone"
      (task "repeat idle(5) until { message 'm'; consume(a: 1) }") "check" "REPEAT-AGAIN"
      "repeat (idle(5); idle(5) until { repeat })" [ "set timer 1 to 5 s" ];
    example Repeat_err "the round fails" (task "watch (repeat %p) onError { ignore() }") "fail(noptilus-1, p, broken)"
      "FAIL, REPEAT-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [];
    example Repeat_err "the condition breaks" (task "watch (repeat %p until { 1 / 0 }) onError { ignore() }")
      "broken(division by zero)" "REPEAT-ERR, WATCH-IGNORE, EXECUTE-DONE" "script" [] ]

let nothing_there =
  "could not pick 1 vehicle of type 'ROV': noptilus-1 is a UUV; noptilus-2 is a UUV; noptilus-3 is a UUV; \
   x8-02 is a UAV"

let too_few = "tasks 'p', 'q' run side by side and need different vehicles, but there is only noptilus-1"

let script : example list =
  [ example Script "a script that computes for long lets others go on" "while (true) { }" "script" "SCRIPT" "script" [];
    example Post "pairs go to N" "post a: 1, b: 'x'" "post a:1, b:'x'" "POST" "script" [];
    example Consume "the oldest pair" "post a: 2, a: 1\nconsume a: _" "consume a:2" "CONSUME" "script" [];
    example Message "told to the user" "message \"${1 + 1} boats\"" "message '2 boats'" "MESSAGE" "script"
      [ "say 2 boats" ];
    example Release "vehicles leave B" (pick_both ^ "release v") "release noptilus-1" "RELEASE" "script"
      [ "release noptilus-1" ];
    example Set_timeout "of some vehicles" (pick_v ^ "setConnectionTimeout v, 2.min")
      "setConnectionTimeout noptilus-1, 120" "SET-TIMEOUT" "script" [ "connection timeout 120 s for noptilus-1" ];
    example Pick "waits" "v = pick { type 'UAV'; timeout 5.seconds }" "pick(1 vehicle of type 'UAV')" "PICK" "waiting"
      [ "look for 1 vehicle of type 'UAV'" ];
    example Pick_bind "the first choice" "v = pick { count 2; type 'UUV' }" "bind(noptilus-1, noptilus-2)" "PICK-BIND"
      "script" [ "cancel timer 0"; "bind noptilus-1, noptilus-2" ];
    example Pick_bind "the last choice" "v = pick { count 2; type 'UUV' }" "bind(noptilus-2, noptilus-3)" "PICK-BIND"
      "script" [ "cancel timer 0"; "bind noptilus-2, noptilus-3" ];
    example Pick_bind "all that are there when the time is up" "v = pick { count _; type 'UUV' }"
      "bind(noptilus-1, noptilus-2, noptilus-3)" "PICK-BIND" "script" [ "bind noptilus-1, noptilus-2, noptilus-3" ];
    example Pick_err "nothing fits when the time is up" "v = pick { type 'ROV' }" ("no-vehicles(" ^ nothing_there ^ ")")
      "PICK-ERR" ("failed: " ^ nothing_there) [ "end: " ^ nothing_there ];
    example Pick_else "nothing fits, and the program says what then" "v = pick { type 'ROV' } else { null }"
      ("no-vehicles(" ^ nothing_there ^ ")") "PICK-ELSE" "script" [];
    example Ask "waits" "n = ask 'how many?'" "ask(how many?)" "ASK" "waiting" [ "ask how many?" ];
    example Answer "the expression's value" "n = ask 'how many?'" "answer(1)" "ANSWER" "script" [];
    example Answer_err "nobody answers" "n = ask 'how many?'" "no-answer" "ANSWER-ERR"
      "failed: no answer to 'how many?': end of input" [ "end: no answer to 'how many?': end of input" ];
    example Pause "waits" "pause 2.seconds" "pause(2)" "PAUSE" "waiting" [ "set timer 0 to 2 s" ];
    example Resume "the time is up" "pause 2.seconds" "resume" "RESUME" "script" [];
    example Call "asks the host" "s = getSupplier()" "call(getSupplier)" "CALL" "waiting" [ "call getSupplier" ];
    example Reply "goes on with the reply" "s = getSupplier()" "reply(null)" "REPLY" "script" [];
    example Call_err "the host fails" "s = getSupplier()" "no-reply(gone)" "CALL-ERR" "failed: getSupplier: gone"
      [ "end: getSupplier: gone" ];
    example Execute "the task is active, its timers run" (task "idle(3) | %p") "execute" "EXECUTE"
      "(idle(3) | p[noptilus-1])" [ "set timer 1 to 3 s" ];
    example Execute_done "the script goes on" (task "%p") "done(noptilus-1, p)" "DONE, EXECUTE-DONE" "script" [];
    example Execute_err "an error that nobody handles" (task "%p | %q") "fail(noptilus-2, q, broken)"
      "FAIL, PAR-ERR, EXECUTE-ERR" "failed: q failed on noptilus-2: broken"
      [ "stop noptilus-1"; released; "end: q failed on noptilus-2: broken" ];
    example Alloc_err "too few vehicles" (pick_v ^ "execute task('p') | task('q')") ("cannot-execute(" ^ too_few ^ ")")
      "ALLOC-ERR" ("failed: " ^ too_few) [ "release noptilus-1"; "end: " ^ too_few ];
    example End "B is released" pick_v "end" "END" "completed" [ "release noptilus-1"; "end" ];
    example Halt "by the script" (pick_v ^ "halt 'enough'") "halt(enough)" "HALT" "halted: enough"
      [ "release noptilus-1"; "end: halted enough" ];
    example Halt "by code inside of a task, whatever runs" (task "%p | action { message 'm'; halt 'enough' }")
      "halt(enough)" "HALT" "halted: enough"
      [ "say m"; "stop noptilus-1"; released; "end: halted enough" ];
    example Fault "the script breaks" (pick_v ^ "x = 1 / 0") "fault(division by zero)" "FAULT"
      "failed: division by zero"
      [ "release noptilus-1"; "end: division by zero" ];
    example Input "at any moment" ("input 'a'\n" ^ task "during 5 run %p") "input a:1" "INPUT"
      "during 5 run p[noptilus-1]..." [];
    example Input "while it waits" "input 'a'\npause 3" "input a:1" "INPUT" "waiting" [];
    example Interrupt "at any moment" (task "during 5 run %p") "interrupt" "INTERRUPT" "interrupted"
      [ "cancel timer 1"; "stop noptilus-1"; released; "end: interrupted" ];
    example Interrupt "nobody is bound" "onInterrupt task('home')\npause 3" "interrupt" "INTERRUPT" "interrupted"
      [ "cancel timer 0"; "end: interrupted" ];
    example On_interrupt "what runs is cut off"
      ("onInterrupt { vs -> task('home')[vs] }\n" ^ task "during 5 run %p")
      "interrupt" "ON-INTERRUPT" "script" [ "cancel timer 1"; "stop noptilus-1" ];
    example On_interrupt "while it waits" ("onInterrupt task('home')\n" ^ pick_v ^ "pause 3") "interrupt" "ON-INTERRUPT"
      "script" [ "cancel timer 0" ] ]

let examples = tasks @ script

(* {1 Looking for the transition} *)

let next_of (c : Configuration.t) =
  match c.control with
  | Script _ -> "script"
  | Waiting _ -> "waiting"
  | Executing (_, r) -> Format.asprintf "%a" Residual.pp r
  | Ended Completed -> "completed"
  | Ended Interrupted -> "interrupted"
  | Ended (Halted message) -> "halted: " ^ message
  | Ended (Failed fault) -> "failed: " ^ fault.message

let text label derivation next effects =
  Printf.sprintf "%s by %s to %s; %s" label derivation next (String.concat "; " effects)

let text_of (t : Transition.t) =
  let effects = List.map (Format.asprintf "%a" Effect.pp) t.effects in
  text (Format.asprintf "%a" Label.pp t.label) (Pure_run.rules t) (next_of t.next) effects

let holds e () =
  let program = Pure_run.compile_exn e.source in
  match Graph.explore ~limit:400 program Pure_run.fleet with
  | None -> Alcotest.fail "more than 400 states"
  | Some graph ->
    let leaving = Graph.outcomes ~interruption:true program Pure_run.fleet in
    let all = List.concat_map leaving (Array.to_list graph.states) in
    let by_rule = List.filter (fun (t : Transition.t) -> List.mem e.rule t.rules) all in
    let found = List.sort_uniq String.compare (List.map text_of by_rule) in
    let expected = text e.label e.derivation e.next e.effects in
    if not (List.mem expected found) then
      Alcotest.failf "expected\n%s\nfound\n%s" expected (String.concat "\n" found)

(* {1 The rules have the same names everywhere} *)

let read file =
  let channel = open_in_bin file in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

(* A rule's name stands in brackets after the line between premises and conclusion: [---- [SEQ-1]]. *)
let documented () =
  let rule = Str.regexp "^ *---+ *\\[\\([A-Z0-9-]+\\)\\]" in
  List.filter_map
    (fun line -> if Str.string_match rule line 0 then Some (Str.matched_group 1 line) else None)
    (String.split_on_char '\n' (read "../../docs/semantics.md"))

let names = List.map Rule.name Rule.all
let sorted = List.sort String.compare

let are_documented () =
  Alcotest.(check (list string)) "each rule once in docs/semantics.md" (sorted names) (sorted (documented ()))

(* An operator of its own in the specification, spelt [SEQ_1], or [ACTION_] where TLA+ has reserved the word. *)
let in_specification file pattern =
  let definition = Str.regexp pattern in
  List.filter_map
    (fun line -> if Str.string_match definition line 0 then Some (Str.matched_group 1 line) else None)
    (String.split_on_char '\n' (read ("../../spec/" ^ file)))

let specified () = in_specification "Dolphin.tla" "^\\([A-Z][A-Z0-9_]+\\)\\((.*)\\)? =="
let actions () = in_specification "DolphinChecking.tla" "^Take_\\([A-Z0-9_]+(ts) == .*\\)$"
let disjuncts () = in_specification "DolphinChecking.tla" {r|^     \(\\/ Take_.*\)$|r}

let are_specified () =
  let spelt name = String.map (function '-' -> '_' | c -> c) name in
  let is_of name operator = operator = spelt name || operator = spelt name ^ "_" in
  let rules = List.map (fun operator -> List.find_opt (fun name -> is_of name operator) names) (specified ()) in
  Alcotest.(check (list string)) "each operator of this spelling is a rule, and each rule is one operator" (sorted names)
    (sorted (List.map (Option.value ~default:"no rule") rules));
  let action name = Printf.sprintf {|%s(ts) == \E j \in Taking("%s", ts) : Unmarked(ts[j])|} (spelt name) name in
  Alcotest.(check (list string)) "each rule has an action" (List.map action names) (actions ());
  let words = List.concat_map (String.split_on_char ' ') (disjuncts ()) in
  let taken = List.filter (fun word -> word <> "" && word <> "\\/") words in
  Alcotest.(check (list string)) "NextByRule takes each" (List.map (fun name -> "Take_" ^ spelt name ^ "(ts)") names) taken

let are_tested () =
  let tested = List.sort_uniq String.compare (List.map (fun e -> Rule.name e.rule) examples) in
  Alcotest.(check (list string)) "each rule has an example" (sorted names) tested

let are_spelt () =
  let again = List.map (fun name -> Option.map Rule.name (Rule.of_name name)) names in
  Alcotest.(check (list (option string))) "of_name undoes name" (List.map Option.some names) again;
  Alcotest.(check int) "no name twice" (List.length names) (List.length (List.sort_uniq String.compare names))

let case name f = Alcotest.test_case name `Quick f
let rule_case e = case (Printf.sprintf "%s: %s" (Rule.name e.rule) e.shows) (holds e)

let () =
  Alcotest.run "rules"
    [ ( "names",
        [ case "are spelt once" are_spelt; case "are documented" are_documented; case "are specified" are_specified;
          case "are tested" are_tested ] );
      ("tasks", List.map rule_case tasks);
      ("script", List.map rule_case script) ]
