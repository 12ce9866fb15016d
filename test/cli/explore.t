The time and the memory that an exploration takes are not the same twice.

  $ explore() { dolphin explore "$@" > result; status=$?; sed 's/, [0-9.]* s, [0-9]* MiB//' result; return $status; }

A program whose every run is sound. Without reduction every state is looked at.

  $ explore ../../examples/rendezvous.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  36 states, 35 transitions, depth 35; reduced by partial order, symmetry
  $ explore ../../examples/rendezvous.dol --reduction none
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  2198 states, 7139 transitions, depth 35

The same, if a plan may fail once.

  $ explore ../../examples/rendezvous.dol --faults fail=1
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 10 steps, with 1 fault: an unhandled error ends the program
    also at ../../examples/rendezvous.dol:20:9: sk1 failed on noptilus-1: failure
    also at ../../examples/rendezvous.dol:37:26: rv3 failed on x8-02: failure
    also at ../../examples/rendezvous.dol:33:26: rv1 failed on x8-02: failure
    also at ../../examples/rendezvous.dol:35:26: rv2 failed on x8-02: failure
  assertions: holds
  vehicles for all tasks: holds
  41 states, 50 transitions, depth 35; reduced by partial order, symmetry
  
  no unhandled error: a shortest run with 1 fault in which an unhandled error ends the program
       program                                   noptilus-1                 where              variables
   1   ask(Radius of operation area? (km))                                  rendezvous.dol:2
   2   answer(2)                                                            rendezvous.dol:2
   3   pick(3 vehicles of type 'UUV' with payload DVL, Sidescan in region (41.185000, -8.706200) ^ 2000 m)                             rendezvous.dol:5   r = 2, APDL = (41.185000, -8.706200) ^ 2000 m
   4   picks noptilus-1, noptilus-2, noptilus-3                             rendezvous.dol:5
   5   pick(1 vehicle of type 'UAV' in region (41.185000, -8.706200) ^ 2000 m)                             rendezvous.dol:11  UUVs = [noptilus-1, noptilus-2, noptilus-3]
   6   picks x8-02                                                          rendezvous.dol:11
   7   setConnectionTimeout noptilus-1, noptilus-2, noptilus-3, 120                             rendezvous.dol:15  UAV = x8-02
   8   execute                                                              rendezvous.dol:26
   9                                             starts survey1             rendezvous.dol:18
  10                                             fails in survey1: failure  rendezvous.dol:18
  [1]

A program that may wait for ever.

  $ cat > deadlock.dol <<'END'
  > v = pick { type 'UUV' }
  > execute (imcPlan('a') >> action { post left: 1 } >> condition { consume right: 1 }) | condition { consume right: 1 }
  > END
  $ explore deadlock.dol
  no deadlock: violated after 6 steps: nothing can happen any more, and the program has not ended
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  7 states, 6 transitions, depth 6; reduced by partial order, symmetry of vehicles
  
  no deadlock: a shortest run in which nothing can happen any more, and the program has not ended
      program                        noptilus-1  where           variables
  1   pick(1 vehicle of type 'UUV')              deadlock.dol:1
  2   picks noptilus-1                           deadlock.dol:1
  3   execute                                    deadlock.dol:2  v = noptilus-1
  4                                  starts a    deadlock.dol:2
  5                                  ends a      deadlock.dol:2
  6   act(post left:1)                           deadlock.dol:2
  tuples then: {left:1}
  waits for the condition at deadlock.dol:2:65, consume right: 1
  waits for the condition at deadlock.dol:2:99, consume right: 1
  [1]

In a wide terminal the log's words stand beside what conditions and timers do. In a narrow one texts are cut.

  $ COLUMNS=120 explore deadlock.dol | tail -n +9
      program                        noptilus-1  where           variables       in words
  1   pick(1 vehicle of type 'UUV')              deadlock.dol:1
  2   picks noptilus-1                           deadlock.dol:1
  3   execute                                    deadlock.dol:2  v = noptilus-1
  4                                  starts a    deadlock.dol:2
  5                                  ends a      deadlock.dol:2
  6   act(post left:1)                           deadlock.dol:2                  posts left:1
  tuples then: {left:1}
  waits for the condition at deadlock.dol:2:65, consume right: 1
  waits for the condition at deadlock.dol:2:99, consume right: 1
  $ cat > narrow.dol <<'END'
  > vehicle = pick { type 'UUV'; payload 'DVL' }
  > execute action { post position: 'north of the second buoy' } | condition { !poll(position: _) } | condition { poll(position: _) || false } | condition { poll(never: 1) }
  > END
  $ COLUMNS=60 explore narrow.dol | tail -n +8
  no deadlock: a shortest run in which nothing can happen
    any more, and the program has not ended
      program                                     where
  1   pick(1 vehicle of type 'UUV' with paylo...  narrow.dol:1
  2   picks noptilus-1                            narrow.dol:1
  3   execute                                     narrow.dol:2
      vehicle = noptilus-1
  4   act(post position:'north of the second ...  narrow.dol:2
  5   check                                       narrow.dol:2
  tuples then: {position:'north of the second buoy'}
  waits for the condition at narrow.dol:2:76, !poll(position: _)
  waits for the condition at narrow.dol:2:154, poll(never: 1)
  $ COLUMNS=200 explore narrow.dol | tail -n +8
  no deadlock: a shortest run in which nothing can happen any more, and the program has not ended
      program                                         where         variables             in words
  1   pick(1 vehicle of type 'UUV' with payload DVL)  narrow.dol:1
  2   picks noptilus-1                                narrow.dol:1
  3   execute                                         narrow.dol:2  vehicle = noptilus-1
  4   act(post position:'north of the second buoy')   narrow.dol:2                        posts position:'north of the second buoy'
  5   check                                           narrow.dol:2                        sees that poll(position: _) || false holds
  tuples then: {position:'north of the second buoy'}
  waits for the condition at narrow.dol:2:76, !poll(position: _)
  waits for the condition at narrow.dol:2:154, poll(never: 1)

The step that decides a formula is marked. Variables stand beside the steps that change them, or below where they do
not fit. The place of an error that a handler takes is that of the code that broke.

  $ cat > decided.dol <<'END'
  > count = 0
  > v = pick { type 'UUV' }
  > half = { x -> x / count }
  > execute watch (task('p')[v] >> action {
  >   count = half(1)
  > }) onError { ignore() } | (
  >   action { count = count + 1 } >> idle(3))
  > END
  $ COLUMNS=60 explore decided.dol --ltl 'G !done(p)' | tail -n +8
  
  formula G !done(p): a shortest run in which it does not
    hold
       program                       noptilus-1  where
   1   pick(1 vehicle of type 'U...              decided.dol:2
       count = 0
   2   picks noptilus-1                          decided.dol:2
   3   execute                                   decided.dol:4
       v = noptilus-1
   4                                 starts p    decided.dol:4
   5                                 ends p      decided.dol:4
       decides the formula: the rest of the run does not matter
   6   broken(division by zero)                  decided.dol:4
   7   act                                       decided.dol:7
       count = 1
   8   timeout                                   decided.dol:7
   9   end
  $ COLUMNS=100 explore decided.dol --ltl 'G !done(p)' | tail -n +8
  
  formula G !done(p): a shortest run in which it does not hold
       program                        noptilus-1  where          variables
   1   pick(1 vehicle of type 'UUV')              decided.dol:2  count = 0
   2   picks noptilus-1                           decided.dol:2
   3   execute                                    decided.dol:4  v = noptilus-1
   4                                  starts p    decided.dol:4
   5                                  ends p      decided.dol:4
       decides the formula: the rest of the run does not matter
   6   broken(division by zero)                   decided.dol:4
   7   act                                        decided.dol:7  count = 1
   8   timeout                                    decided.dol:7
   9   end
  $ COLUMNS=200 explore decided.dol --ltl 'G !done(p)' | tail -n +8
  
  formula G !done(p): a shortest run in which it does not hold
       program                        noptilus-1  where          variables       in words
   1   pick(1 vehicle of type 'UUV')              decided.dol:2  count = 0
   2   picks noptilus-1                           decided.dol:2
   3   execute                                    decided.dol:4  v = noptilus-1
   4                                  starts p    decided.dol:4
   5                                  ends p      decided.dol:4
       decides the formula: the rest of the run does not matter
   6   broken(division by zero)                   decided.dol:4
   7   act                                        decided.dol:7  count = 1
   8   timeout                                    decided.dol:7                  idled long enough
   9   end
  $ explore decided.dol --ltl 'G !done(p)' --json | python3 -c 'import json, sys; print([v["decided"] for v in json.load(sys.stdin)["verdicts"] if "decided" in v])'
  [5]

A program that may never end.

  $ cat > round.dol <<'END'
  > x = 0
  > while (true) { x = 1 - x; pause 1.seconds }
  > END
  $ explore round.dol
  no deadlock: holds
  termination: violated: after 1 step, 4 steps that can repeat without end
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  5 states, 5 transitions, depth 4; reduced by partial order
  
  termination: a run in which the program may never end
      program   where        variables
  1   pause(1)  round.dol:2  x = 1
  and from there, again and again:
      program   where        variables
  2   resume    round.dol:2
  3   pause(1)  round.dol:2  x = 0
  4   resume    round.dol:2
  5   pause(1)  round.dol:2  x = 1
  [1]

Code that nothing reaches is only worth a note, unless one asks for more.

  $ cat > unreached.dol <<'END'
  > post a: 1
  > if (poll(b: 1)) { message 'never' }
  > END
  $ explore unreached.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: no leftover tuples: violated after 2 steps: tuples are left when the program completes
  note: all code reached: violated: no run reaches message at unreached.dol:2:19
  3 states, 2 transitions, depth 2; reduced by partial order
  $ explore --strict unreached.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: violated after 2 steps: tuples are left when the program completes
  all code reached: violated: no run reaches message at unreached.dol:2:19
  3 states, 2 transitions, depth 2; reduced by partial order
  
  no leftover tuples: a shortest run in which tuples are left when the program completes
      program   where
  1   post a:1  unreached.dol:1
  2   end
  tuples then: {a:1}
  
  all code reached: no run reaches
    unreached.dol:2:19: message
  [1]

An assertion that some run breaks.

  $ cat > assertion.dol <<'END'
  > v = pick { type 'UUV' }
  > assert { 1 + 1 == 2 }, 'arithmetic'
  > execute watch (imcPlan('a') | action { post alarm: 1 }
  >   | assert { !poll(alarm: _) }) onError { ignore() }
  > consume alarm: 1
  > END
  $ explore assertion.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: violated after 5 steps: assertion.dol:4:5: assertion failed
  vehicles for all tasks: holds
  note: all code reached: violated: no run reaches onError at assertion.dol:3:9
  12 states, 11 transitions, depth 9; reduced by partial order, symmetry of vehicles
  
  assertions: a shortest run in which an assertion fails
      program                        where            variables
  1   pick(1 vehicle of type 'UUV')  assertion.dol:1
  2   picks noptilus-1               assertion.dol:1
  3   execute                        assertion.dol:3  v = noptilus-1
  4   act(post alarm:1)              assertion.dol:3
  5   broken(assertion failed)       assertion.dol:4
  tuples then: {alarm:1}
  [1]

Invariants.

  $ cat > counting.dol <<'END'
  > n = 0
  > v = pick { type 'UUV' }
  > execute (imcPlan('a') >> action { n = n + 1; post done: n }) | action { n = n + 1 }
  > consume done: _
  > END
  $ explore counting.dol --invariant 'n <= 2' --invariant "!(running('a') && n > 0)" --invariant '!poll(done: 2)' --invariant "!running('a', 'x8-02')"
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  invariant n <= 2: holds
  invariant !(running('a') && n > 0): violated after 5 steps: it does not hold
  invariant !poll(done: 2): violated after 7 steps: it does not hold
  invariant !running('a', 'x8-02'): holds
  14 states, 16 transitions, depth 9; reduced by symmetry of vehicles
  
  invariant !(running('a') && n > 0): a shortest run in which it does not hold
      program                        noptilus-1  where           variables
  1   pick(1 vehicle of type 'UUV')              counting.dol:2  n = 0
  2   picks noptilus-1                           counting.dol:2
  3   execute                                    counting.dol:3  v = noptilus-1
  4                                  starts a    counting.dol:3
  5   act                                        counting.dol:3  n = 1
  
  invariant !poll(done: 2): a shortest run in which it does not hold
      program                        noptilus-1  where           variables
  1   pick(1 vehicle of type 'UUV')              counting.dol:2  n = 0
  2   picks noptilus-1                           counting.dol:2
  3   execute                                    counting.dol:3  v = noptilus-1
  4                                  starts a    counting.dol:3
  5                                  ends a      counting.dol:3
  6   act                                        counting.dol:3  n = 1
  7   act(post done:2)                           counting.dol:3  n = 2
  tuples then: {done:2}
  [1]
  $ explore counting.dol --invariant '1 / n > 0' --invariant 'bound("noptilus-1") || n == 0'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  invariant 1 / n > 0: inconclusive, the condition cannot be evaluated: division by zero
  invariant bound("noptilus-1") || n == 0: violated after 4 steps: it does not hold
  26 states, 31 transitions, depth 9; reduced by symmetry of vehicles
  
  invariant bound("noptilus-1") || n == 0: a shortest run in which it does not hold
      program                        where           variables
  1   pick(1 vehicle of type 'UUV')  counting.dol:2  n = 0
  2   picks noptilus-2               counting.dol:2
  3   execute                        counting.dol:3  v = noptilus-2
  4   act                            counting.dol:3  n = 1
  [1]
  $ explore counting.dol --invariant 'm > 0'
  dolphin: --invariant 'm > 0': unknown name 'm'
  [2]
  $ explore counting.dol --invariant 'bound(v)'
  dolphin: --invariant 'bound(v)': bound takes the name of a vehicle, as in bound('noptilus-1')
  [2]
  $ explore counting.dol --invariant 'n = 2'
  dolphin: --invariant 'n = 2': this cannot be assigned to
  [2]

Formulas of temporal logic.

  $ explore ../../examples/rendezvous.dol --ltl 'G (start(survey1) -> F done(survey1))' --ltl 'F ended' --ltl '!start(survey1) W bind(x8-02)'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  formula G (start(survey1) -> F done(survey1)): holds
  formula F ended: holds
  formula !start(survey1) W bind(x8-02): holds
  36 states, 35 transitions, depth 35; reduced by partial order, symmetry; 4589 states for formulas
  $ cat > again.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > n = 0
  > while (n == 0) {
  >   execute watch imcPlan('a') onError { post failed: 1; ignore() }
  >   if (poll(failed: 1)) { consume failed: 1 } else { n = 1; message 'done' }
  > }
  > END
  $ explore again.dol --faults fail --ltl 'G (start(a) -> F (done(a) | fail(a, noptilus-1)))' --ltl 'G F {n == 1}' --ltl 'message("done") R !end' --ltl 'G (fail -> X consume(failed: 1))'
  no deadlock: holds
  termination: violated, with 1 fault: after 3 steps, 4 steps that can repeat without end; holds with --fairness strong
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  formula G (start(a) -> F (done(a) | fail(a, noptilus-1))): holds
  formula G F {n == 1}: violated, with 1 fault: after 3 steps, 4 steps that can repeat without end
  formula message("done") R !end: holds
  formula G (fail -> X consume(failed: 1)): holds
  10 states, 10 transitions, depth 7; reduced by partial order; 38 states for formulas
  
  termination: a run with 1 fault in which the program may never end
      program                               where        variables
  1   pick(1 vehicle with id 'noptilus-1')  again.dol:1
  2   picks noptilus-1                      again.dol:1
  3   execute                               again.dol:4  v = noptilus-1, n = 0
  and from there, again and again:
      program           noptilus-1           where
  4                     starts a             again.dol:4
  5                     fails in a: failure  again.dol:4
  6   consume failed:1                       again.dol:5
  7   execute                                again.dol:4
  
  formula G F {n == 1}: a run with 1 fault in which it does not hold
      program                               where        variables
  1   pick(1 vehicle with id 'noptilus-1')  again.dol:1
  2   picks noptilus-1                      again.dol:1
  3   execute                               again.dol:4  v = noptilus-1, n = 0
  and from there, again and again:
      program           noptilus-1           where
  4                     starts a             again.dol:4
  5                     fails in a: failure  again.dol:4
  6   consume failed:1                       again.dol:5
  7   execute                                again.dol:4
  [1]
  $ explore again.dol --faults fail=1 --ltl 'F ended' --ltl 'F (done(a) & running(a))' | grep formula
  formula F ended: holds
  formula F (done(a) & running(a)): violated after 7 steps, without a fault: it does not hold
  15 states, 14 transitions, depth 11; reduced by partial order; 24 states for formulas
  formula F (done(a) & running(a)): a shortest run without a fault in which it does not hold
      decides the formula: the rest of the run does not matter
  $ explore deadlock.dol --ltl 'F ended' | grep violated
  no deadlock: violated after 6 steps: nothing can happen any more, and the program has not ended
  formula F ended: violated after 6 steps: it does not hold

Beside a violation that a reduced search has found.

  $ explore ../../examples/rendezvous.dol --faults fail --ltl 'F ended' --ltl 'G !error' | grep -e '^[a-z ]*: ' -e '^formula.*: [hv]'
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 10 steps, with 1 fault: an unhandled error ends the program
  assertions: holds
  vehicles for all tasks: holds
  formula F ended: holds
  formula G !error: violated after 10 steps, with 1 fault: it does not hold
  no unhandled error: a shortest run with 1 fault in which an unhandled error ends the program
       decides the formula: the rest of the run does not matter

What has been violated stays so: not all states need be seen. What nobody can list is not followed where it cannot matter.

  $ explore again.dol --faults fail --ltl 'G !start(a)' --ltl 'X X X X running(a)' | grep -e '^formula.*violated' -e 'for formulas'
  formula G !start(a): violated after 4 steps, without a fault: it does not hold
  10 states, 10 transitions, depth 7; reduced by partial order; 9 states for formulas
  $ cat > unlisted.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > message 'go'
  > post b: battery(v)
  > END
  $ explore unlisted.dol --ltl 'G !message' --ltl '!bind W pick' | grep formula
  formula G !message: inconclusive, unlisted.dol:3:1: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  formula !bind W pick: holds
  4 states, 3 transitions, depth 3; reduced by partial order; 1 states for formulas
  $ explore again.dol --ltl 'G (strat(a))'
  dolphin: --ltl 'G (strat(a))': unknown proposition 'strat' (did you mean start?)
  [2]
  $ explore again.dol --ltl 'G (start(a)'
  dolphin: --ltl 'G (start(a)': a ')' is missing
  [2]
  $ explore again.dol --ltl 'F {m > 0}'
  dolphin: --ltl 'F {m > 0}': unknown name 'm'
  [2]

A run to follow.

  $ explore again.dol --faults fail --trace again.run > shown
  [1]
  $ tail -n 4 again.run
  {"label":"start(noptilus-1, a)","choice":0}
  {"label":"fail(noptilus-1, a, failure)","event":"failed","vehicle":"noptilus-1","why":"failure"}
  {"label":"consume failed:1","choice":0}
  {"label":"execute","choice":0}
  $ dolphin exec again.dol --follow again.run
  breaks: termination
     2  program     picks noptilus-1
  and from there, again and again:
     4  noptilus-1  starts a
     5  noptilus-1  fails in a: failure
     6  program     consumes failed:1
  $ explore assertion.dol --trace assertion.run > shown
  [1]
  $ dolphin exec assertion.dol --follow assertion.run
  breaks: assertions
     2  program     picks noptilus-1
     4  program     posts alarm:1
     5  program     has an error in a task: assertion failed
     5  program     releases noptilus-1
     5  program     fails: assertion failed
  assertion.dol:4:5: error: assertion failed
    4 |   | assert { !poll(alarm: _) }) onError { ignore() }
      |     ^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]
  $ explore deadlock.dol --trace deadlock.run > shown
  [1]
  $ dolphin exec deadlock.dol --follow deadlock.run
  breaks: no deadlock
     2  program     picks noptilus-1
     4  noptilus-1  starts a
     5  noptilus-1  ends a
     6  program     posts left:1
        here the recorded run stops

It is drawn, too, by the steps that it has: both ways the same.

  $ explore deadlock.dol --draw deadlock.svg > shown
  [1]
  $ dolphin exec deadlock.dol --follow deadlock.run --draw followed.svg > shown
  $ for file in deadlock.svg followed.svg; do
  >   grep -o '>[^<>]*steps[^<>]*<\|>noptilus-1 runs [^<]*\|>counterexample: [a-z ]*' $file | sort -u
  > done
  >1 vehicle  ·  6 steps, without times  ·  the built-in fleet<
  >counterexample: no deadlock
  >noptilus-1 runs a from step 4 to step 5: done
  >1 vehicle  ·  6 steps, without times  ·  the built-in fleet<
  >counterexample: no deadlock
  >noptilus-1 runs a from step 4 to step 5: done
  $ echo "message 'hello'" > sound.dol
  $ explore sound.dol --draw nothing.svg > shown; ls nothing.svg
  ls: cannot access 'nothing.svg': No such file or directory
  [2]
  $ explore deadlock.dol --draw deadlock.png
  dolphin: option '--draw': 'deadlock.png' ends neither in .svg nor in .html
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
  $ explore deadlock.dol --draw none/deadlock.svg > shown
  dolphin: the picture cannot be written: none/deadlock.svg: No such file or directory
  [3]

The same in the Informal Trace Format: from the last state back to state 3.

  $ explore again.dol --faults fail --trace again.itf.json > shown
  [1]
  $ python3 - << 'END'
  > import json
  > trace = json.load(open("again.itf.json"))
  > print(trace["vars"], "loop:", trace["loop"], trace["#meta"]["back"])
  > for state in trace["states"]:
  >     print(state["#meta"], state["control"]["state"], state["A"], state["B"], state["N"])
  > END
  ['control', 'A', 'B', 'N', 'store'] loop: 3 {'label': 'execute', 'rules': ['EXECUTE']}
  {'index': 0} script {'#map': []} [] {'#map': []}
  {'index': 1, 'label': "pick(1 vehicle with id 'noptilus-1')", 'rules': ['PICK']} waiting {'#map': []} [] {'#map': []}
  {'index': 2, 'label': 'bind(noptilus-1)', 'rules': ['PICK-BIND']} script {'#map': []} ['noptilus-1'] {'#map': []}
  {'index': 3, 'label': 'execute', 'rules': ['EXECUTE']} executing {'#map': []} ['noptilus-1'] {'#map': []}
  {'index': 4, 'label': 'start(noptilus-1, a)', 'rules': ['START', 'WATCH-1']} executing {'#map': [['noptilus-1', 'a']]} ['noptilus-1'] {'#map': []}
  {'index': 5, 'label': 'fail(noptilus-1, a, failure)', 'rules': ['FAIL', 'WATCH-IGNORE', 'EXECUTE-DONE']} script {'#map': []} ['noptilus-1'] {'#map': [['failed', [{'#bigint': '1'}]]]}
  {'index': 6, 'label': 'consume failed:1', 'rules': ['CONSUME']} script {'#map': []} ['noptilus-1'] {'#map': []}

Where states stand for others that are alike, runs have the names that the program gives.

  $ cat > alike.dol << 'END'
  > vs = pick { count 3; type 'UUV' }
  > def T(i) { imcPlan('a' + i) >> action { post ready:i } }
  > execute (T(1) | T(2) | T(3) | waitFor { consume ready:_ } then idle(1)) >> condition { !poll(ready:2) }
  > END
  $ explore alike.dol --reduction symmetry --trace alike.run | tail -n 20
  106 states, 231 transitions, depth 16; reduced by symmetry, symmetry of vehicles
  
  no deadlock: a shortest run in which nothing can happen any more, and the program has not ended
       program                                   noptilus-1  noptilus-2  noptilus-3  where        variables
   1   pick(3 vehicles of type 'UUV')                                                alike.dol:1
   2   picks noptilus-1, noptilus-2, noptilus-3                                      alike.dol:1
   3   execute                                                                       alike.dol:3  vs = [noptilus-1, noptilus-2, noptilus-3]
   4                                             starts a1                           alike.dol:2
   5                                             ends a1                             alike.dol:2
   6   act(post ready:1)                                                             alike.dol:2
   7                                                         starts a2               alike.dol:2
   8                                                         ends a2                 alike.dol:2
   9   act(post ready:2)                                                             alike.dol:2
  10                                                                     starts a3   alike.dol:2
  11                                                                     ends a3     alike.dol:2
  12   act(post ready:3)                                                             alike.dol:2
  13   check(consume ready:1)                                                        alike.dol:3
  14   timeout                                                                       alike.dol:3
  tuples then: {ready:2, ready:3}
  waits for the condition at alike.dol:3:88, !poll(ready:2)
  $ dolphin exec alike.dol --follow alike.run
  breaks: no deadlock
     2  program     picks noptilus-1, noptilus-2, noptilus-3
     4  noptilus-1  starts a1
     5  noptilus-1  ends a1
     6  program     posts ready:1
     7  noptilus-2  starts a2
     8  noptilus-2  ends a2
     9  program     posts ready:2
    10  noptilus-3  starts a3
    11  noptilus-3  ends a3
    12  program     posts ready:3
    13  program     consumes ready:1
    14  program     idled long enough
        here the recorded run stops
  $ explore alike.dol --reduction none | grep depth
  187 states, 406 transitions, depth 16

It does not fit another program, and no other file is one.

  $ dolphin exec deadlock.dol --follow assertion.run
     2  program     picks noptilus-1
  dolphin: assertion.run: deadlock.dol does not fit, at step 4: the program has no such choice there (act(post alarm:1))
  [2]
  $ dolphin exec deadlock.dol --follow deadlock.dol
  dolphin: deadlock.dol: line 1 is not JSON
  [2]
  $ dolphin exec assertion.dol --follow assertion.run --journal assertion.journal
  dolphin: a recorded run (--follow) takes a program, a fleet, --draw and --layer, and no other options
  [2]
  $ dolphin exec deadlock.dol --follow missing.run
  dolphin: missing.run: No such file or directory
  [2]

Which of several runs is written can be chosen, also one that is only noted.

  $ cat > several.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > execute imcPlan('a')
  > post left: 1
  > END
  $ several() { explore several.dol --faults fail --invariant '!poll(left: 1)' "$@" | grep violated; }
  $ several --trace several.run
  no unhandled error: violated after 5 steps, with 1 fault: an unhandled error ends the program
  note: no leftover tuples: violated after 7 steps, without a fault: tuples are left when the program completes
  invariant !poll(left: 1): violated after 6 steps, without a fault: it does not hold
  $ dolphin exec several.dol --follow several.run 2>&1 | head -n 1
  breaks: no unhandled error
  $ several --trace several.run --violation 'invariant !poll(left: 1)' > shown
  $ dolphin exec several.dol --follow several.run 2>&1 | head -n 1
  breaks: invariant !poll(left: 1)
  $ several --trace several.run --draw several.svg --violation 'no leftover tuples' > shown
  $ dolphin exec several.dol --follow several.run 2>&1 | head -n 1
  breaks: no leftover tuples
  $ grep -c 'no leftover tuples: tuples are left when the program completes' several.svg
  1
  $ explore several.dol --faults fail --trace other.run --violation terminaton > shown
  dolphin: --violation 'terminaton': there is no such property; the properties are no deadlock, termination, no unhandled error, assertions, vehicles for all picks, vehicles for all tasks, no halt, no leftover tuples, all code reached
  [2]
  $ explore several.dol --faults fail --trace other.run --violation 'no deadlock' > shown
  dolphin: --violation 'no deadlock': no run that violates it is known; these have one: no unhandled error, no leftover tuples
  [2]
  $ tail -n 1 shown; test -e other.run
  5                                         fails in a: failure  several.dol:2
  [1]
  $ explore ../../examples/rendezvous.dol --trace other.run --violation termination > shown
  dolphin: --violation 'termination': no run that violates it is known; no property has a run that violates it
  [2]
  $ explore several.dol --violation 'no leftover tuples'
  dolphin: --violation chooses the run of --trace and --draw: give one of these too
  [2]

A run to follow, or a graph, whose brackets nest too deep is an error.

  $ head -c 1000000 /dev/zero | tr '\0' '[' > deep.run; cp deep.run deep.json
  $ dolphin exec several.dol --follow deep.run
  dolphin: deep.run: line 1 is not JSON
  [2]
  $ dolphin lts deep.json
  dolphin: deep.json: this is not JSON: it is nested too deep
  [2]

That a file cannot be written is known before anything is explored.

  $ explore deadlock.dol --trace missing/deadlock.run
  dolphin: missing/deadlock.run: No such file or directory
  [3]
  $ explore deadlock.dol --trace .
  dolphin: .: this is a directory, not a file
  [3]

A bound that is met leaves the answer open.

  $ explore ../../examples/rendezvous.dol --reduction none --max-states 100
  no deadlock: inconclusive, the bound on states was met
  termination: inconclusive, the bound on states was met
  no unhandled error: inconclusive, the bound on states was met
  assertions: inconclusive, the bound on states was met
  vehicles for all tasks: inconclusive, the bound on states was met
  101 states, 176 transitions, depth 13
  [3]

Of vehicles that are alike it does not matter which are picked. A run that is shown names vehicles of the fleet.

  $ for i in 1 2 3 4 5 6 7 8 9; do for j in 1 2 3 4 5; do echo "vehicle 'uuv-$i$j', { type 'UUV'; at 41.$i$j, -8.70 }"; done; done > teams.fleet
  $ cat > teams.dol << 'END'
  > for (i in 1..2) {
  >   a = pick { count 3; type 'UUV' }
  >   b = pick { count 3; type 'UUV' }
  >   execute (task('p')[a] | task('q')[a] | task('r')[a]) | task('s')[b]
  >   release a
  >   message "${b} go home"
  >   release b
  > }
  > END
  $ explore teams.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  34 states, 33 transitions, depth 33; reduced by partial order, symmetry, symmetry of vehicles
  $ explore teams.dol --faults fail=1,loss --trace teams.run | grep -E 'violated|states|fails'
  no unhandled error: violated after 7 steps, with 1 fault: an unhandled error ends the program
  42 states, 49 transitions, depth 33; reduced by partial order, symmetry of vehicles
  7                                   fails in p: failure  teams.dol:4
  $ dolphin exec teams.dol --follow teams.run | tail -n 4
  teams.dol:4:12: error: p failed on uuv-11: failure
    4 |   execute (task('p')[a] | task('q')[a] | task('r')[a]) | task('s')[b]
      |            ^^^^^^^^^
     6  uuv-11      starts p
     7  uuv-11      fails in p: failure
     7  program     releases uuv-11, uuv-12, uuv-13, uuv-14, uuv-15, uuv-21
     7  program     fails: p failed on uuv-11: failure
  $ explore teams.dol --invariant "!poll('x')" --invariant "!bound('uuv-95')" | grep -E 'invariant|states|uuv-95'
  invariant !poll('x'): holds
  invariant !bound('uuv-95'): violated after 2 steps: it does not hold
  514 states, 1341 transitions, depth 33; reduced by symmetry of vehicles
  invariant !bound('uuv-95'): a shortest run in which it does not hold
  2   picks uuv-11, uuv-12, uuv-95    teams.dol:2
  $ (cat teams.dol; echo 'if (a[0].id == b[0].id) { post x: 1 }') > named.dol
  $ explore named.dol --fleet teams.fleet --max-states 100 | grep states
  no deadlock: inconclusive, the bound on states was met
  termination: inconclusive, the bound on states was met
  no unhandled error: inconclusive, the bound on states was met
  assertions: inconclusive, the bound on states was met
  vehicles for all tasks: inconclusive, the bound on states was met
  101 states, 1 transitions, depth 1; reduced by partial order

The orders in which vehicles come are counted out one after another, also by a process that has little stack.

  $ for i in 1 2 3 4 5 6 7 8 9; do echo "vehicle 'uuv-$i', { type 'UUV' }"; done > nine.fleet
  $ echo 'v = pick { count 9 }' > nine.dol
  $ (ulimit -s 512; explore nine.dol --fleet nine.fleet --faults join --reduction por --max-states 3000 | grep -v inconclusive)
  vehicles for all picks: violated after 2 steps, with 1 fault: vehicles are missing
  3001 states, 1 transitions, depth 1; reduced by partial order
  
  vehicles for all picks: a shortest run with 1 fault in which vehicles are missing
      program                                   where
  1   pick(9 vehicles)                          nine.dol:1
  2   no-vehicles(could not pick 9 vehicles: uuv-2 fits; uuv-3 fits; uuv-4 fits; uuv-5 fits; uuv-6 fits; uuv-7 fits; uuv-8 fits; uuv-9 fits; and 1 more)  nine.dol:1
      if uuv-1 is missing

When the process can have no more memory, it says so. (OCaml 5 reserves at its start what 128 domains take, without d=1.)

  $ cat > large.dol << 'END'
  > vs = pick { count 9 }
  > def T(i) { imcPlan('a' + i) >> action { post ready:i } >> imcPlan('b' + i) }
  > execute T(1) | T(2) | T(3) | T(4) | T(5) | T(6) | T(7) | T(8) | T(9)
  > END
  $ for i in 1 2 3 4 5 6 7 8 9; do echo "vehicle 'u$i', { type 'UUV'; at 41.18$i, -8.70 }"; done > large.fleet
  $ (export OCAMLRUNPARAM=d=1; ulimit -v 60000; dolphin explore large.dol --reduction none > result 2> progress; echo status $?; head -n 2 result)
  status 3
  no deadlock: inconclusive, the machine has no more memory for it
  termination: inconclusive, the machine has no more memory for it

For machines.

  $ dolphin explore --json round.dol | tr ',' '\n' | grep -E 'states|verdict'
  {"states":5
  "formula_states":0
  "verdicts":[{"property":"no deadlock"
  "verdict":"holds"}
  "verdict":"violated"
  "verdict":"holds"}
  "verdict":"holds"}
  "verdict":"holds"}
  "verdict":"holds"}
  "verdict":"holds"}
  "verdict":"holds"}
  "verdict":"holds"}]}

Hundreds of actions side by side that can change places.

  $ awk 'BEGIN { printf "n = 0\nexecute action { n = n + 1 }"; for (i = 1; i < 800; i++) printf " | action { n = n + 1 }" }' > beside.dol
  $ touch beside.fleet; dolphin explore beside.dol --max-states 3 2> progress | tail -n 1 | sed 's/, depth.*; /; /'
  4 states, 801 transitions; reduced by partial order, symmetry

What cannot be explored.

  $ dolphin explore missing.dol
  dolphin: missing.dol: No such file or directory
  [2]
  $ dolphin explore round.dol --faults lost=1
  dolphin: option '--faults': unknown fault 'lost': did you mean loss?
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin explore round.dol --trace round.svg
  dolphin: option '--trace': 'round.svg' is the name of a picture, but JSON
           would be written
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]

For whatever collects results of tests, and for code hosts and editors.

  $ cat > reports.dol <<'END'
  > v = pick { type 'UUV' }
  > assert { 1 < 2 }
  > execute imcPlan('a & b') >> assert({ poll(done: 1) }, 'it is done')
  > END
  $ explore reports.dol --junit reports.xml --sarif reports.sarif > /dev/null
  [1]
  $ sed 's/time="[^"]*"/time="T"/' reports.xml
  <?xml version="1.0" encoding="UTF-8"?>
  <testsuites tests="9" failures="1" errors="0" time="T">
    <testsuite name="reports.dol" tests="9" failures="1" errors="0" time="T">
      <testcase classname="reports.dol" name="no deadlock"/>
      <testcase classname="reports.dol" name="termination"/>
      <testcase classname="reports.dol" name="no unhandled error"/>
      <testcase classname="reports.dol" name="assertions">
        <failure message="assertions: violated after 6 steps: reports.dol:3:29: assertion failed: it is done" type="assertions">
          
      program                               noptilus-1    where          variables
  1   pick(1 vehicle of type 'UUV')                       reports.dol:1
  2   picks noptilus-1                                    reports.dol:1
  3   execute                                             reports.dol:3  v = noptilus-1
  4                                         starts a &amp; b  reports.dol:3
  5                                         ends a &amp; b    reports.dol:3
  6   broken(assertion failed: it is done)                reports.dol:3
  
        </failure>
      </testcase>
      <testcase classname="reports.dol" name="vehicles for all picks"/>
      <testcase classname="reports.dol" name="vehicles for all tasks"/>
      <testcase classname="reports.dol" name="no halt"/>
      <testcase classname="reports.dol" name="no leftover tuples"/>
      <testcase classname="reports.dol" name="all code reached"/>
    </testsuite>
  </testsuites>
  $ cat > results.py <<'END'
  > import json
  > log = json.load(open('reports.sarif'))
  > [run] = log['runs']
  > print(log['version'], run['tool']['driver']['name'], [rule['id'] for rule in run['tool']['driver']['rules']])
  > for result in run['results']:
  >     place = result['locations'][0]['physicalLocation']
  >     print(result['ruleId'], result['kind'], result['level'], place['artifactLocation']['uri'], place.get('region'))
  >     for flow in result.get('codeFlows', []):
  >         for step in flow['threadFlows'][0]['locations']:
  >             print('  ', step['location']['message']['text'])
  > END
  $ python3 results.py
  2.1.0 dolphin explore ['no-deadlock', 'termination', 'no-unhandled-error', 'assertions', 'vehicles-for-all-picks', 'vehicles-for-all-tasks', 'no-halt', 'no-leftover-tuples', 'all-code-reached']
  no-deadlock pass none reports.dol None
  termination pass none reports.dol None
  no-unhandled-error pass none reports.dol None
  assertions fail error reports.dol {'startLine': 3, 'startColumn': 29, 'endLine': 3, 'endColumn': 68}
     program: pick(1 vehicle of type 'UUV')
     program: picks noptilus-1
     program: execute
     noptilus-1: starts a & b
     noptilus-1: ends a & b
     program: broken(assertion failed: it is done)
  vehicles-for-all-picks pass none reports.dol None
  vehicles-for-all-tasks pass none reports.dol None
  no-halt pass none reports.dol None
  no-leftover-tuples pass none reports.dol None
  all-code-reached pass none reports.dol None
  $ explore reports.dol --strict --max-states 2 --junit bound.xml --sarif bound.sarif > /dev/null
  [3]
  $ grep -c 'type="inconclusive"' bound.xml
  9
  $ grep -c '"kind": "open"' bound.sarif
  9
  $ explore reports.dol --sarif -
  dolphin: option '--sarif': '-' is not a file name
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
  $ explore reports.dol --junit nowhere/reports.xml
  dolphin: nowhere/reports.xml: No such file or directory
  [3]

What was found is kept, and used again if nothing has changed.

  $ export XDG_CACHE_HOME=$PWD/kept
  $ cp reports.dol kept.dol
  $ echo "vehicle 'a', { type 'UUV' }" > kept.fleet
  $ verdict() { dolphin explore kept.dol --cache "$@" 2> notes > result; echo "$?, $(cat notes)"; }
  $ verdict; cp result first
  1, 
  $ verdict --trace again.run; cmp result first
  1, dolphin: nothing has changed: these are the stored verdicts
  $ dolphin explore kept.dol --trace once.run > /dev/null; cmp once.run again.run
  $ find kept -type f | wc -l
  1
  $ verdict --faults fail
  1, 
  $ verdict --faults fail
  1, dolphin: nothing has changed: these are the stored verdicts
  $ echo "vehicle 'b', { type 'UUV' }" >> kept.fleet
  $ verdict
  1, 
  $ echo "post done: 1" > kept.dol
  $ verdict
  0, 
  $ verdict
  0, dolphin: nothing has changed: these are the stored verdicts

Not if it is inconclusive, if the file is not as it was written, or where no file can be written.

  $ rm -r kept
  $ verdict --max-states 2
  3, 
  $ find kept -type f 2> none | wc -l
  0
  $ verdict
  0, 
  $ kept=$(find kept -type f)
  $ cp $kept whole; { head -c 60 whole; printf x; tail -c +62 whole; } > $kept; verdict
  0, 
  $ head -c 60 whole > $kept; verdict
  0, 
  $ : > $kept; verdict
  0, 
  $ verdict
  0, dolphin: nothing has changed: these are the stored verdicts
  $ touch file; XDG_CACHE_HOME=$PWD/file verdict
  0, dolphin: $TESTCASE_ROOT/file/dolphin: Not a directory

Random walks: the same ones with the same seed. Only where they have been everywhere is something said to hold.

  $ explore ../../examples/rendezvous.dol --reduction none --sample 20 --seed 1
  no deadlock: inconclusive, only random walks were followed
  termination: inconclusive, only random walks were followed
  no unhandled error: inconclusive, only random walks were followed
  assertions: inconclusive, only random walks were followed
  vehicles for all tasks: inconclusive, only random walks were followed
  695 states, 928 transitions, depth 35
  20 random walks (--seed 1): 720 visits to 323 states
  estimated: the next visit is to a new state with a chance of 33.3%; about 1058 states or more
  [3]
  $ explore ../../examples/sequence.dol --sample 20 --seed 1
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  14 states, 13 transitions, depth 13; reduced by partial order
  1 random walk (--seed 1): 14 visits to 14 states
  $ explore deadlock.dol --sample 5 --seed 1 | head -1
  no deadlock: violated after 6 steps: nothing can happen any more, and the program has not ended
  $ dolphin explore ../../examples/sequence.dol --sample 20 --seed 1 --json | grep -o '"sample".*'
  "sample":{"walks":1,"seed":1,"visits":14,"visited":14,"new":0.0,"estimate":14.0}}
  $ dolphin explore ../../examples/sequence.dol --sample 0 2>&1 | head -1
  dolphin: option '--sample': '0' is not a number from 1 on
  $ dolphin explore ../../examples/sequence.dol --sample 3 --ltl 'F ended'
  dolphin: random walks cannot check a formula: give --sample or --ltl, not both
  [2]

States beyond a bound on memory go to disk. Here none do, and nothing is left there.

  $ mkdir disk
  $ explore ../../examples/rendezvous.dol --reduction none --max-memory 8G --spill disk | tail -1
  2198 states, 7139 transitions, depth 35
  $ ls disk
  $ explore ../../examples/rendezvous.dol --spill disk
  dolphin: --spill is for states beyond a bound on memory: give --max-memory too
  [2]
  $ explore ../../examples/rendezvous.dol --max-memory 1G --spill nowhere
  dolphin: --spill nowhere: no such directory
  [2]
  $ explore ../../examples/rendezvous.dol --max-memory 1G --spill deadlock.dol
  dolphin: --spill deadlock.dol: not a directory
  [2]
  $ explore ../../examples/rendezvous.dol --max-memory 1G --spill disk --compress
  dolphin: states on disk are not compressed: give --spill or --compress, not both
  [2]
  $ explore ../../examples/rendezvous.dol --max-memory 1G --spill disk --sample 10
  dolphin: random walks and bitstate hashing keep no states on disk: give --spill without --sample and --bitstate
  [2]

Bitstate hashing: as many states where the bits are many, and nothing is said to hold; a violation is one, with its run.

  $ explore ../../examples/rendezvous.dol --reduction none --bitstate 64K
  no deadlock: inconclusive, a hash may have left out states
  termination: inconclusive, a hash may have left out states
  no unhandled error: inconclusive, a hash may have left out states
  assertions: inconclusive, a hash may have left out states
  vehicles for all tasks: inconclusive, a hash may have left out states
  2198 states, 7139 transitions, depth 35
  bitstate: 3 hashes a state in 65536 bytes, 1.25% of the bits are set
  expected: 0.0011 states left out of those it came to; any at all with a chance of 0.108%
  [3]
  $ explore ../../examples/rendezvous.dol --reduction none --bitstate 256 | tail -3
  849 states, 2566 transitions, depth 35
  bitstate: 3 hashes a state in 256 bytes, 78.6% of the bits are set
  expected: 192 states left out of those it came to; any at all with a chance of 100%
  $ explore deadlock.dol --bitstate 64K
  no deadlock: violated after 6 steps: nothing can happen any more, and the program has not ended
  termination: inconclusive, a hash may have left out states
  no unhandled error: inconclusive, a hash may have left out states
  assertions: inconclusive, a hash may have left out states
  vehicles for all tasks: inconclusive, a hash may have left out states
  7 states, 6 transitions, depth 6; reduced by partial order, symmetry of vehicles
  bitstate: 3 hashes a state in 65536 bytes, 0.00401% of the bits are set
  expected: 8.3e-14 states left out of those it came to; any at all with a chance of 8.26e-12%
  
  no deadlock: a shortest run in which nothing can happen any more, and the program has not ended
      program                        noptilus-1  where           variables
  1   pick(1 vehicle of type 'UUV')              deadlock.dol:1
  2   picks noptilus-1                           deadlock.dol:1
  3   execute                                    deadlock.dol:2  v = noptilus-1
  4                                  starts a    deadlock.dol:2
  5                                  ends a      deadlock.dol:2
  6   act(post left:1)                           deadlock.dol:2
  tuples then: {left:1}
  waits for the condition at deadlock.dol:2:65, consume right: 1
  waits for the condition at deadlock.dol:2:99, consume right: 1
  [1]
  $ explore deadlock.dol --bitstate 64K --trace bitstate.run --junit bitstate.xml > shown
  [1]
  $ dolphin exec deadlock.dol --follow bitstate.run > followed; grep -c testcase bitstate.xml
  18
  $ dolphin explore ../../examples/sequence.dol --bitstate 1M --json | grep -o '"bitstate":{"bytes":[0-9]*,"hashes":[0-9]*'
  "bitstate":{"bytes":1048576,"hashes":3
  $ dolphin explore ../../examples/sequence.dol --bitstate 0 2>&1 | head -1
  dolphin: option '--bitstate': '0' is not a size such as 512M or 8G
  $ dolphin explore ../../examples/sequence.dol --bitstate 1M --ltl 'F ended'
  dolphin: bitstate hashing cannot check a formula: give --bitstate or --ltl, not both
  [2]
  $ dolphin explore ../../examples/sequence.dol --bitstate 1M --sample 3
  dolphin: random walks keep their states: give --sample or --bitstate, not both
  [2]
  $ dolphin explore ../../examples/sequence.dol --bitstate 1M --compress
  dolphin: bitstate hashing keeps no states that could be compressed: give --bitstate or --compress, not both
  [2]
  $ dolphin explore ../../examples/rendezvous.dol --bitstate 1G --max-memory 100M | head -1
  no deadlock: inconclusive, the bound on memory was met

A list in a program may be as long as the program: the machine stops in the midst of it, here 24 times.

  $ (printf 'x = [' && seq -s ', ' 240000 && echo ']' && echo 'message x.size()') > long.dol
  $ dolphin explore long.dol 2>&1 | sed 's/, [0-9.]* s, .*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  27 states, 26 transitions, depth 26

Values that hold their parts many times over are compared part by part once:

  $ cat > shared.dol << 'END'
  > xs = [1]
  > for (i in 1..60) { xs = [xs, xs] }
  > t = task('p')
  > for (i in 1..60) { t = t >> t }
  > m = [a: 1]
  > for (i in 1..60) { m = [a: m, b: m] }
  > c = [t, m]
  > for (i in 1..60) { c = [c, c] }
  > execute action { xs = [xs, xs, c] } >> action { xs = [xs, xs] }
  > message xs
  > END
  $ dolphin explore shared.dol --timeout 10 | grep -e deadlock -e error:
  no deadlock: holds
  no unhandled error: violated after 4 steps: an unhandled error ends the program
  no unhandled error: a shortest run in which an unhandled error ends the program
  $ dolphin explore shared.dol --timeout 10 --reduction none --invariant 'xs == xs' | grep -e deadlock -e error: -e invariant
  no deadlock: holds
  no unhandled error: violated after 4 steps: an unhandled error ends the program
  invariant xs == xs: holds
  no unhandled error: a shortest run in which an unhandled error ends the program
  $ dolphin lts shared.dol --timeout 10 | tail -n 1
  (3,"fault(a value of more than 1000000 parts, each counted as often as it stands there, is too large for this)",4)

A vehicle that may be missing does not hide that a task cannot be executed:

  $ cat > masked.dol << 'END'
  > v = pick { type 'UUV' }
  > execute task('p') | task('q')
  > END
  $ echo "vehicle 'a', { type 'UUV' }" > masked.fleet
  $ dolphin explore masked.dol --faults all | grep '^vehicles.*: violated'
  vehicles for all picks: violated after 2 steps, with 1 fault: vehicles are missing
  vehicles for all tasks: violated after 3 steps, without a fault: a task cannot be executed
  $ dolphin explore masked.dol | grep '^vehicles.*: violated'
  vehicles for all tasks: violated after 3 steps: a task cannot be executed

Of each violation a run with the fewest faults is shown, also where another one is shorter, in reports for programs, for
invariants, and from the middle of a run:

  $ cat > fewest.dol << 'END'
  > v = pick { type 'UUV' }
  > n = 0
  > execute (watch task('p') onError { action { n = 1 / 0 } }) >> task('q') >> action { n = 5 } >> action { x = [1][n] }
  > END
  $ cp masked.fleet fewest.fleet
  $ explore fewest.dol --faults fail | tail -n 11
  no unhandled error: a shortest run without a fault in which an unhandled error ends the program
       program                                   a         where         variables
   1   pick(1 vehicle of type 'UUV')                       fewest.dol:1
   2   picks a                                             fewest.dol:1
   3   execute                                             fewest.dol:3  v = a, n = 0
   4                                             starts p  fewest.dol:3
   5                                             ends p    fewest.dol:3
   6                                             starts q  fewest.dol:3
   7                                             ends q    fewest.dol:3
   8   act                                                 fewest.dol:3  n = 5
   9   broken(index 5 is out of range: a list has 1 elements)            fewest.dol:3
  $ dolphin explore fewest.dol --faults fail,loss --invariant 'n < 1' | grep '^invariant'
  invariant n < 1: violated after 8 steps, without a fault: it does not hold
  invariant n < 1: a shortest run without a fault in which it does not hold
  $ dolphin explore fewest.dol --faults fail --ltl 'G !error' --ltl 'G !fail' | grep '^formula.*: v'
  formula G !error: violated after 9 steps, without a fault: it does not hold
  formula G !fail: violated after 5 steps, with 1 fault: it does not hold
  $ dolphin explore fewest.dol --faults all --json | grep -o '"faults":[0-9]*,"fewest_faults":[a-z]*'
  "faults":0,"fewest_faults":true
  "faults":1,"fewest_faults":true
  $ cat > twice.dol << 'END'
  > v = pick { type 'UUV' }
  > execute watch task('p') onError { watch task('q') onError { action { x = 1 / 0 } } }
  > END
  $ dolphin explore twice.dol --fleet masked.fleet --faults fail | grep ', with'
  no unhandled error: violated after 10 steps, with 2 faults: an unhandled error ends the program
  $ dolphin explore twice.dol --fleet masked.fleet --faults fail=1 | grep ', with'
  [1]

If the searches for fewer faults are cut short, the verdict has that. Of many vehicles any may be late or missing, in
any order:

  $ cat > two.dol << 'END'
  > vs = pick { count 2 }
  > execute task('p')[vs]
  > END
  $ printf "vehicle 'v%d', { type 'UUV' }\n" 1 2 3 > two.fleet
  $ dolphin explore two.dol --faults join --max-states 4 2> errors | grep ', with'
  vehicles for all picks: violated after 2 steps, with 2 faults (perhaps fewer): vehicles are missing
  $ sed -i 's/count 2/count _/' two.dol
  $ seq 1 30 | sed "s/.*/vehicle 'v&', { type 'UUV' }/" > two.fleet
  $ dolphin explore two.dol --faults all | grep ', with'
  no unhandled error: violated after 5 steps, with 1 fault: an unhandled error ends the program
  vehicles for all picks: violated after 2 steps, with 30 faults: vehicles are missing

A step of a task has the place of its own code, and labels are cut only where there is no room:

  $ cat > places.dol << 'END'
  > v = pick { type 'UUV' }
  > t = task('p') >>
  >     action { post x: 1 }
  > execute (until {
  >     poll x: 1
  >   } run repeat idle(5))
  >   | t[v]
  >   >> condition {
  >        consume x: 1 } >> { action {
  >        message 'm' } }
  > assert { false }, 'this text of an assertion is long enough to be cut where cells have forty characters'
  > END
  $ cp masked.fleet places.fleet
  $ dolphin explore places.dol | sed -n '/act(/,$p'
   6   act(post x:1)                                       places.dol:3
   7   cut                                                 places.dol:4
   8   check(consume x:1)                                  places.dol:8
   9   make                                                places.dol:9
  10   allocate()                                          places.dol:4
  11   act(message 'm')                                    places.dol:9
  12   fault(assertion failed: this text of an assertion is long enough to be cut where cells have forty characters)            places.dol:11
  $ COLUMNS=150 dolphin explore places.dol | grep fault
  12   fault(assertion failed: this text of an assertion is long enough to be cut where cells have forty characters)            places.dol:11
