What the world leaves open is explored: what sensors show, lost connections, and who comes when.

  $ explore() { dolphin explore "$@" > result; status=$?; sed 's/, [0-9.]* s, [0-9]* MiB//' result; return $status; }

Of a comparison with a sensor both outcomes are possible. A counter-example says which one it takes.

  $ cat > charge.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > execute imcPlan('survey')[v] / { battery(v) < 0.3 }
  > if (battery(v) < 0.1) { halt 'too late' }
  > END
  $ explore charge.dol --strict
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: violated after 5 steps: the program halts
  no leftover tuples: holds
  all code reached: holds
  8 states, 9 transitions, depth 5; reduced by partial order
  
  no halt: a shortest run in which the program halts
      program                               where         variables
  1   pick(1 vehicle with id 'noptilus-1')  charge.dol:1
  2   picks noptilus-1                      charge.dol:1
  3   execute                               charge.dol:2  v = noptilus-1
  4   cut                                   charge.dol:2
      if battery(noptilus-1) < 0.3 is true
  5   halt(too late)
      if battery(noptilus-1) < 0.1 is true
  [1]

Values that the fleet gives are all that there are.

  $ cat > charge.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV'; battery 100.percent, 20.percent }
  > END
  $ explore charge.dol --strict
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  7 states, 8 transitions, depth 5; reduced by partial order
  $ sed -i 's/20.percent/5.percent/' charge.fleet
  $ explore charge.dol --strict --trace charge.run > shown
  [1]
  $ tail -n +2 charge.run
  {"label":"pick(1 vehicle with id 'noptilus-1')","choice":0}
  {"label":"bind(noptilus-1)","choice":0}
  {"label":"execute","choice":0}
  {"label":"cut","choice":0,"assumed":[{"battery":"noptilus-1","is":0.05}]}
  {"label":"halt(too late)","choice":0,"assumed":[{"battery":"noptilus-1","is":0.05}]}
  $ dolphin exec --follow charge.run charge.dol
  breaks: no halt
     2  program     picks noptilus-1
     4  program     sees that the condition of until holds
        if battery(noptilus-1) is 0.05
     5  program     releases noptilus-1
     5  program     halts: too late
        if battery(noptilus-1) is 0.05
  [1]
  $ dolphin explore charge.dol --strict --json | grep -o '"assumptions".*' | cut -c1-120
  "assumptions":[{"step":4,"assumed":["battery(noptilus-1) is 0.05"]},{"step":5,"assumed":["battery(noptilus-1) is 0.05"]}

The simulator shows the one of them that is nearest.

  $ cat > nearest.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV'; battery 60.percent, 20.percent; drain 40.percent; at Location.APDL; at 41.2, -8.7 }
  > plan 'hour', { duration 1.hour }
  > END
  $ cat > nearest.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > message "${battery(v)} ${position(v)}"
  > execute imcPlan('hour')[v]
  > message "${battery(v)} ${position(v)}"
  > END
  $ dolphin exec nearest.dol | grep says
     0:00  program     says: 0.6 (41.185242, -8.704803)
  1:00:00  program     says: 0.2 (41.185242, -8.704803)

What is more than compared cannot be explored, unless the fleet says what it may be.

  $ cat > level.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > post level: battery(v)
  > END
  $ explore level.dol | grep deadlock
  no deadlock: inconclusive, level.dol:2:1: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  $ explore level.dol > shown
  [3]
  $ dolphin lts level.dol
  level.dol:2:1: error: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
    2 | post level: battery(v)
      | ^^^^^^^^^^^^^^^^^^^^^^
  [3]
  $ cat > level.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV'; battery 100.percent, 20.percent }
  > END
  $ dolphin lts level.dol
  des (0, 6, 7)
  (0,"pick(1 vehicle with id 'noptilus-1')",1)
  (1,"bind(noptilus-1)",2)
  (2,"post level:1",3)
  (2,"post level:0.2",4)
  (3,"end",5)
  (4,"end",6)

Vehicles may be late or missing: those that join, leave or drop, or if the fleet has none, all.

  $ cat > late.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV'; joins 20.seconds }
  > END
  $ cat > late.dol <<'END'
  > vs = pick { count _ ; type 'UUV' }
  > if (vs.size() == 1) { halt 'alone' }
  > END
  $ explore late.dol --strict
  dolphin: by the fleet these join late: b; here they are there from the start, unless --faults has join
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  4 states, 3 transitions, depth 3; reduced by partial order, symmetry of vehicles
  $ explore late.dol --strict --faults join --trace late.run
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: violated after 3 steps, with 1 fault: the program halts
  no leftover tuples: holds
  all code reached: holds
  6 states, 5 transitions, depth 3; reduced by partial order
  
  no halt: a shortest run with 1 fault in which the program halts
      program                           where       variables
  1   pick(all vehicles of type 'UUV')  late.dol:1
  2   picks a                           late.dol:1
      if b is missing
  3   halt(alone)                                   vs = a
  [1]
  $ tail -2 late.run
  {"label":"bind(a)","event":"timer","timer":0,"assumed":[{"missing":"b"}]}
  {"label":"halt(alone)","choice":0}
  $ dolphin exec --follow late.run late.dol
  breaks: no halt
     2  program     picks a
        if b is missing
     3  program     releases a
     3  program     halts: alone
  [1]
  $ dolphin lts late.dol --faults join
  des (0, 5, 6)
  (0,"pick(all vehicles of type 'UUV')",1)
  (1,"bind(a, b)",2)
  (1,"bind(a)",3)
  (2,"end",4)
  (3,"halt(alone)",5)

A lost vehicle stays bound. It is not there for a pick until something is heard of it.

  $ cat > lost.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > execute watch imcPlan('survey')[v] onError { ignore() }
  > release v
  > w = pick { id 'noptilus-1' }
  > END
  $ explore lost.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: all code reached: violated: no run reaches onError at lost.dol:2:9
  10 states, 9 transitions, depth 9; reduced by partial order
  $ explore lost.dol --faults loss=1
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all picks: violated after 8 steps, with 1 fault: vehicles are missing
  vehicles for all tasks: holds
  16 states, 15 transitions, depth 9; reduced by partial order
  
  vehicles for all picks: a shortest run with 1 fault in which vehicles are missing
      program                                   noptilus-1                        where       variables
  1   pick(1 vehicle with id 'noptilus-1')                                        lost.dol:1
  2   picks noptilus-1                                                            lost.dol:1
  3   execute                                                                     lost.dol:2  v = noptilus-1
  4                                             starts survey                     lost.dol:2
  5                                             fails in survey: connection lost  lost.dol:2
  6   release noptilus-1                                                          lost.dol:3
  7   pick(1 vehicle with id 'noptilus-1')                                        lost.dol:4
  8   no-vehicles(could not pick 1 vehicle with id 'noptilus-1': noptilus-2 has another id; noptilus-3 has another id; x8-02 has another id; noptilus-1 is not connected)                                    lost.dol:4
      if noptilus-1 is missing
  [1]

Faults have names and numbers.

  $ explore late.dol --strict --faults fail=1,join=0 | head -1
  dolphin: by the fleet these join late: b; here they are there from the start, unless --faults has join
  no deadlock: holds
  $ explore late.dol --strict --faults all=0 | head -1
  dolphin: by the fleet these join late: b; here they are there from the start, unless --faults has join
  no deadlock: holds
  $ explore late.dol --faults jion
  dolphin: option '--faults': unknown fault 'jion': did you mean join?
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
  $ explore late.dol --faults fail=often
  dolphin: option '--faults': 'often' is not a number of faults, as in fail=1
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
  $ explore late.dol --faults fail=1=2
  dolphin: option '--faults': 'fail=1=2' is not as in fail or fail=1
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]

An answer that is refused is asked for again.

  $ cat > again.dol <<'END'
  > message ask('How many?')
  > END
  $ cat > again.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > answer 'How many?', many, 2
  > END
  $ dolphin lts again.dol
  des (0, 4, 5)
  (0,"ask(How many?)",1)
  (1,"answer(2)",2)
  (2,"message '2'",3)
  (3,"end",4)

A file that says less than it must is refused.

  $ dolphin explore charge.dol --strict --trace charge.run > shown
  [1]
  $ sed -i 's/,"assumed":.*}$/}/' charge.run
  $ dolphin exec --follow charge.run charge.dol 2>&1 | tail -1
  dolphin: charge.run: charge.dol does not fit, at step 5: the program does end there, and not halt(too late)
  $ cat > level.run <<'END'
  > {"format":"dolphin-course","version":1,"program":{"path":"p","md5":""},"fleet":null,"property":"x","steps":3,"cycle":0}
  > {"label":"pick(1 vehicle with id 'noptilus-1')","choice":0}
  > {"label":"bind(noptilus-1)","choice":0}
  > {"label":"post level:1","choice":0}
  > END
  $ rm level.fleet
  $ dolphin exec --follow level.run level.dol
     2  program     picks noptilus-1
  dolphin: level.run: level.dol does not fit, at step 3: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  [2]

The programs that ran did what the semantics allows.

  $ check-journals
