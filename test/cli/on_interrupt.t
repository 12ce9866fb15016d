What an interruption executes.

  $ cp ../../examples/home.dol ../../examples/home.fleet .
  $ explore() { dolphin explore "$@" > result; status=$?; sed 's/, [0-9.]* s, [0-9]* MiB//' result; return $status; }

All come home, whenever it comes, and whatever fails.

  $ explore home.dol --faults interrupt,loss=1 --ltl 'G (interrupt & bound(x8-02) -> F (done(home, x8-02) | fail(home, x8-02)))'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  formula G (interrupt & bound(x8-02) -> F (done(home, x8-02) | fail(home, x8-02))): holds
  867 states, 2461 transitions, depth 23; 867 states for formulas
  $ explore home.dol | tail -1
  16 states, 15 transitions, depth 15; reduced by partial order, symmetry, symmetry of vehicles

Each of its lines matters. A failure on the way home that nobody watches stops the others.

  $ sed "s/attempt(\(task('home')[^)]*\))/\1/" home.dol > unwatched.dol
  $ diff home.dol unwatched.dol
  14,15c14,15
  <     def all = attempt(task('home')[vs[0]])
  <     for (v in vs.tail()) { all = all | attempt(task('home')[v]) }
  ---
  >     def all = task('home')[vs[0]]
  >     for (v in vs.tail()) { all = all | task('home')[v] }
  [1]
  $ explore unwatched.dol --fleet home.fleet --faults interrupt,loss=1 | grep -B 1 -A 30 'no unhandled error: a'
  
  no unhandled error: a shortest run with 1 fault in which an unhandled error ends the program
      program                                   noptilus-1                      where
  1   pick(3 vehicles of type 'UUV')                                            unwatched.dol:19
  2   picks noptilus-1, noptilus-2, noptilus-3                                  unwatched.dol:19
  3   interrupt                                                                 unwatched.dol:13
  4   execute                                                                   unwatched.dol:13
  5                                             starts home                     unwatched.dol:14
  6                                             fails in home: connection lost  unwatched.dol:14

One task of all vehicles is done by one of them.

  $ sed '/for (v in/d; s/vs\[0\]/vs/' home.dol > one.dol
  $ explore one.dol --fleet home.fleet --faults interrupt --ltl 'G (interrupt & bound(x8-02) -> F done(home, x8-02))' | grep ^formula
  formula G (interrupt & bound(x8-02) -> F done(home, x8-02)): violated after 9 steps: it does not hold
  formula G (interrupt & bound(x8-02) -> F done(home, x8-02)): a shortest run in which it does not hold

A way home that has no value yet when it is wanted.

  $ cat > late.dol <<'EOF'
  > onInterrupt home
  > v = pick { type 'UUV' }
  > home = task('home')[v]
  > execute task('survey')[v]
  > EOF
  $ explore late.dol --fleet home.fleet --faults interrupt | grep -A 9 'no unhandled error: a'
  no unhandled error: a shortest run in which an unhandled error ends the program
      program                         where
  1   pick(1 vehicle of type 'UUV')   late.dol:2
  2   picks noptilus-1                late.dol:2
  3   interrupt                       late.dol:1
  4   fault('home' has no value yet)  late.dol:1
  $ dolphin explore late.dol --fleet home.fleet | grep unhandled
  no unhandled error: holds

A run of the explorer can be followed; it can be walked, too.

  $ dolphin explore home.dol --faults interrupt --ltl 'G !(interrupt & bound(x8-02))' --trace cut.run > result
  [1]
  $ dolphin exec home.dol --follow cut.run
  breaks: formula G !(interrupt & bound(x8-02))
     2  program     picks noptilus-1, noptilus-2, noptilus-3
     4  program     picks x8-02
     5  program     is interrupted: executes onInterrupt
     7  noptilus-1  starts home
     8  noptilus-2  starts home
     9  noptilus-3  starts home
    10  x8-02       starts home
    11  noptilus-1  ends home
    12  noptilus-2  ends home
    13  noptilus-3  ends home
    14  x8-02       ends home
    15  program     releases noptilus-1, noptilus-2, noptilus-3, x8-02
    15  program     is interrupted
  [130]

At a signal the run goes on with it, and has been interrupted. SIGHUP may be ignored where tests run, as by `nohup`.

  $ cat > long.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > plan 'survey', { duration 2.hours }
  > plan 'home', { duration 5.seconds }
  > EOF
  $ cat > long.dol <<'EOF'
  > onInterrupt task('home') >> action { message 'home' }
  > v = pick { type 'UUV' }
  > execute task('survey')
  > EOF
  $ signal() {  # SIGNAL PATTERN FILE: signals $run once FILE has PATTERN, and waits for its end
  >   until grep -qs -e "$2" "$3" || ! kill -0 $run; do sleep 0.05; done; kill -$1 $run; wait $run
  > }
  $ env --default-signal=HUP dolphin exec long.dol --fleet long.fleet --speed 5 --journal one.run > log.txt & run=$!
  $ signal HUP 'starts survey' log.txt
  [130]
  $ cut -c 10- log.txt
  program     picks a
  a           starts survey
  program     is interrupted: executes onInterrupt
  a           stops survey
  a           starts home
  a           ends home
  program     says: home
  program     releases a
  program     is interrupted
  $ dolphin trace check long.dol one.run | sed 's/ in .*;/;/'
  one.run: a run, of 10 transitions; interrupted

A second one stops it.

  $ sed -i 's/5.seconds/2.hours/' long.fleet
  $ rm log.txt; dolphin exec long.dol --fleet long.fleet --speed 1 --journal two.run > log.txt & run=$!
  $ await() { until grep -qs "$1" log.txt || ! kill -0 $run; do sleep 0.05; done; }
  $ await 'starts survey'; kill -TERM $run; await 'starts home'; kill -INT $run; wait $run
  [130]
  $ cut -c 10- log.txt
  program     picks a
  a           starts survey
  program     is interrupted: executes onInterrupt
  a           stops survey
  a           starts home
  a           stops home
  program     releases a
  program     is interrupted
  $ dolphin trace check long.dol two.run | sed 's/ in .*;/;/'
  two.run: a run, of 8 transitions; interrupted

A third one ends the process at once. Here a supplier that ignores the end of its input keeps the second one waiting;
it is there still when the third one has come.

  $ (echo 'supplier = getSupplier()'; cat long.dol) > supplied.dol
  $ rm log.txt; env --default-signal=HUP dolphin exec supplied.dol --fleet long.fleet --speed 1 \
  >   --supplier 'exec python3 suppliers.py stays' --journal three.run > log.txt & run=$!
  $ await 'starts survey'; kill -HUP $run; await 'starts home'; kill -TERM $run; signal INT 'is interrupted$' log.txt
  [130]
  $ kill -KILL $(cat supplier.pid) && rm supplier.pid
  $ cut -c 10- log.txt
  program     calls getSupplier
  program     is told host object supplier
  program     picks a
  a           starts survey
  program     is interrupted: executes onInterrupt
  a           stops survey
  a           starts home
  a           stops home
  program     releases a
  program     is interrupted
  $ dolphin trace check supplied.dol three.run | sed 's/ in .*;/;/'
  three.run: the beginning of a run, of 10 transitions; it breaks off

So do two requests to stop, by the socket.

  $ rm two.run log.txt; dolphin exec long.dol --fleet long.fleet --speed 1 --journal two.run > log.txt & run=$!
  $ await 'starts survey'; dolphin post two.run --stop; await 'starts home'; dolphin post two.run --stop; wait $run
  [130]
  $ tail -3 log.txt | cut -c 10-
  a           stops home
  program     releases a
  program     is interrupted

A console that dies on the way home is resumed there. The next interruption is then the second one.

  $ rm two.run log.txt; dolphin exec long.dol --fleet long.fleet --speed 1 --journal two.run > log.txt & run=$!
  $ await 'starts survey'; kill -INT $run; await 'starts home'; kill -KILL $run; wait $run 2> /dev/null
  [137]
  $ dolphin exec long.dol --resume two.run > log.txt & run=$!
  $ signal INT '"resumed"' two.run
  [130]
  $ cut -c 10- log.txt
  a           stops home
  program     releases a
  program     is interrupted
  $ dolphin trace check long.dol two.run | sed 's/ in .*;/;/'
  two.run: a run, of 8 transitions; interrupted

A program that is stuck goes home.

  $ cat > stuck.dol <<'EOF'
  > onInterrupt task('home')
  > v = pick { type 'UUV' }
  > execute waitFor { consume never: 1 } then task('survey')
  > EOF
  $ dolphin exec stuck.dol --fleet home.fleet --journal stuck.run
     0:00  program     picks noptilus-1
     0:00  program     is stuck: executes onInterrupt
     0:00  noptilus-1  starts home
     2:00  noptilus-1  ends home
     2:00  program     releases noptilus-1
     2:00  program     is stuck
  stuck.dol:3:9: error: the program is stuck: nothing can make this condition true any more
    3 | execute waitFor { consume never: 1 } then task('survey')
      |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]
  $ dolphin trace check stuck.dol stuck.run
  stuck.run: a run, of 8 transitions in 2:00; stuck

A way home that is stuck has its own end, after a signal too: in the log, in the journal, and where it is resumed.

  $ cat > lost.dol <<'END'
  > onInterrupt task('home') >> condition { poll never: 1 }
  > v = pick { type 'UUV' }
  > execute task('survey')
  > END
  $ sed -i 's/home., { duration 2.hours/home'"'"', { duration 5.seconds/' long.fleet
  $ rm log.txt; dolphin exec lost.dol --fleet long.fleet --speed 5 --journal lost.run > log.txt 2> errors.txt & run=$!
  $ signal INT 'starts survey' log.txt
  [1]
  $ grep -A 9 "ends home" log.txt | cut -c 10-
  a           ends home
  program     releases a
  program     is stuck
  $ cat errors.txt
  lost.dol:1:39: error: the program is stuck: nothing can make this condition true any more
    1 | onInterrupt task('home') >> condition { poll never: 1 }
      |                                       ^^^^^^^^^^^^^^^^^
  $ dolphin trace check lost.dol lost.run | sed 's/ in .*;/;/'
  lost.run: a run, of 9 transitions; stuck
  $ sed '/"stuck":true/,$d' lost.run > cut.run
  $ dolphin exec lost.dol --resume cut.run 2> errors.txt | cut -c 10-; cat errors.txt
  program     releases a
  program     is stuck
  lost.dol:1:39: error: the program is stuck: nothing can make this condition true any more
    1 | onInterrupt task('home') >> condition { poll never: 1 }
      |                                       ^^^^^^^^^^^^^^^^^
  $ tail -1 cut.run | grep -o '"ending".*'
  "ending":"stuck"}
