A pair that a task uses is given back, however the task ends.

Two vehicles that each have a corridor and wait for the other's: a deadlock, which the times of the fleet avoid.

  $ dolphin explore ../../examples/corridors.dol | head -n 6
  no deadlock: violated after 21 steps: nothing can happen any more, and the program has not ended
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: no leftover tuples: violated after 29 steps: tuples are left when the program completes
  $ dolphin explore ../../examples/corridors.dol | tail -n 2
  tuples then: {lift:'b', lift:'a'}
  waits for the condition at ../../examples/corridors.dol:9:71, using (second): 'free' run task('cross')
  $ dolphin time ../../examples/corridors.dol | head -n 1
  completed: 4:00 at the earliest, 5:00 at the latest

Whatever fails, both cabins and both corridors are there at each end of a run.

  $ ENDS="G (end -> poll(lift: 'a') && poll(lift: 'b') && poll(north: 'free') && poll(south: 'free'))"
  $ dolphin explore ../../examples/corridors.dol --faults all --ltl "$ENDS" | grep '^formula' | sed 's/.*: //'
  holds

The log has what the end of a task gives back.

  $ dolphin exec ../../examples/corridors.dol | grep 'as ensured'
     0:30  program     posts lift:'b', as ensured
     1:00  program     posts lift:'a', as ensured
     2:00  program     posts north:'free', south:'free', as ensured
     4:00  program     posts north:'free', south:'free', as ensured

A lock that actions give back is lost when the task is cut off.

  $ cp ../../examples/corridors.fleet by_hand.fleet
  $ cat > by_hand.dol <<'END'
  > post lift: 'a'
  > porter = pick { id 'porter-1' }
  > nurse = pick { id 'nurse-1' }
  > def ride(v) {
  >   waitFor { consume lift: 'a' } then
  >     (watch task('ride_a')[v] >> action { post lift: 'a' } onError { post lift: 'a' })
  > }
  > execute (ride(porter) during 1.minute) | ride(nurse)
  > END
  $ dolphin explore by_hand.dol | head -n 1
  no deadlock: violated after 8 steps: nothing can happen any more, and the program has not ended

With using it is neither lost nor doubled, under every fault: both consume at the end go on, and nothing is left.

  $ cp by_hand.fleet both.fleet
  $ cat > both.dol <<'END'
  > post lift: 'a', lift: 'b'
  > porter = pick { id 'porter-1' } else { halt 'no porter' }
  > nurse = pick { id 'nurse-1' } else { halt 'no nurse' }
  > def ride() { using lift: _ run { cabin -> task("ride_$cabin") } }
  > execute watch (ride()[porter] during 1.minute) | ride()[nurse] | ride() within 2.minutes onError { ignore() }
  > consume lift: 'a'
  > consume lift: 'b'
  > END
  $ dolphin explore both.dol --faults all --ltl 'G (end -> !poll(lift: _))' | sed '/ states, /d'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: no halt: violated after 4 steps, with 1 fault: the program halts
  formula G (end -> !poll(lift: _)): holds

Deeds of an end that may fail, or depend on the moment, are refused.

  $ cat > wrong.dol <<'END'
  > n = 0
  > execute task('a') ensure { n = n + 1; consume x: 1 }
  > END
  $ dolphin check wrong.dol
  wrong.dol:2:32: error: the values of ensure are known when its task is made: 'n' is a global variable, which may change
    2 | execute task('a') ensure { n = n + 1; consume x: 1 }
      |                                ^
      hint: a function that makes the task takes it as a parameter: def f(n) { return T ensure { ... } }
  wrong.dol:2:39: error: ensure only posts pairs and assigns global variables: nothing in it can fail
    2 | execute task('a') ensure { n = n + 1; consume x: 1 }
      |                                       ^^^^^^^^^^^^
      hint: write post key: value, or x = value; anything else is an action { ... } before the end of the task
  wrong.dol: 2 errors
  [2]

The formatter keeps both words.

  $ cat > rough.dol <<'END'
  > execute (  using   a:1,b : _   run task( 'p' )) ensure{ post   x:1
  >    n=2 }
  > END
  $ dolphin fmt rough.dol && cat rough.dol
  rough.dol
  execute (using a: 1, b: _ run task('p')) ensure {
      post x: 1
      n = 2
  }

The programs that ran did what the semantics allows.

  $ check-journals
