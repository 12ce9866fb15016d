A run by hand: the state, and what may happen next.

  $ cat > relay.dol <<'END'
  > v = pick { type 'UUV' }
  > g = 1
  > execute (watch imcPlan('survey') >> action { post ready: g } onError { ignore() })
  >   | condition { consume ready: 1 }
  > release v
  > END
  $ cat > relay.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > vehicle 'noptilus-2', { type 'UUV' }
  > END
  $ export COLUMNS=60
  $ walk() { dolphin walk relay.dol "$@"; }
  $ printf '1\n2\n1\n1\n2\nvars\nundo\n1\nundo 3\ngoto end\nrun\nwrite by-hand.run\nquit\n' | walk --faults fail
  
  state 0
  A         -
  B         -
  N         -
  script    relay.dol:1
     1  program pick(1 vehicle of type 'UUV') (relay.dol:1)
  0> 1
  
  state 1
  A         -
  B         -
  N         -
  waits for relay.dol:1: 1 vehicle of type 'UUV'
     1  program picks noptilus-1 (relay.dol:1)
     2  program picks noptilus-2 (relay.dol:1)
  1> 2
  
  state 2
  A         -
  B         noptilus-2
  N         -
  script    relay.dol:1
     1  program execute (relay.dol:3)
  2> 1
  
  state 3
  A         -
  B         noptilus-2
  N         -
  task      (watch (survey[noptilus-2] >> action { action }) |
            condition { condition })
  waits for relay.dol:4: consume ready: 1
     1  noptilus-2 starts survey (relay.dol:3)
  3> 1
  
  state 4
  A         noptilus-2 -> survey
  B         noptilus-2
  N         -
  task      (watch (survey[noptilus-2]... >> action { action
            }) | condition { condition })
  waits for relay.dol:4: consume ready: 1
     1  noptilus-2 ends survey (relay.dol:3)
     2  noptilus-2 fails in survey: failure (relay.dol:3)
  4> 2
  
  state 5
  A         -
  B         noptilus-2
  N         -
  task      condition { condition }
  waits for relay.dol:4: consume ready: 1
  Nothing can happen any more, and the program has not ended:
  a deadlock.
  5> vars
  v         noptilus-2
  g         1
  5> undo
  
  state 4, 1 ahead
  A         noptilus-2 -> survey
  B         noptilus-2
  N         -
  task      (watch (survey[noptilus-2]... >> action { action
            }) | condition { condition })
  waits for relay.dol:4: consume ready: 1
     1  noptilus-2 ends survey (relay.dol:3)
  >  2  noptilus-2 fails in survey: failure (relay.dol:3)
  4> 1
  
  state 5
  A         -
  B         noptilus-2
  N         -
  task      (watch action { action } | condition { condition
            })
  waits for relay.dol:4: consume ready: 1
     1  program posts ready:1 (relay.dol:3)
  5> undo 3
  
  state 2, 3 ahead
  A         -
  B         noptilus-2
  N         -
  script    relay.dol:1
  >  1  program execute (relay.dol:3)
  2> goto end
  
  state 5
  A         -
  B         noptilus-2
  N         -
  task      (watch action { action } | condition { condition
            })
  waits for relay.dol:4: consume ready: 1
     1  program posts ready:1 (relay.dol:3)
  5> run
      program                       noptilus-2     where
  1   pick(1 vehicle of type 'U...                 relay.dol:1
  2   picks noptilus-2                             relay.dol:1
  3   execute                                      relay.dol:3
      v = noptilus-2, g = 1
  4                                 starts survey  relay.dol:3
  5                                 ends survey    relay.dol:3
  5> write by-hand.run
  by-hand.run: 5 steps
  5> quit

What was written is a run to follow, here and by exec.

  $ dolphin exec --follow by-hand.run relay.dol
     2  program     picks noptilus-2
     4  noptilus-2  starts survey
     5  noptilus-2  ends survey
        here the recorded run stops
  $ printf 'n 2\n\nu\n1\ng 9\nnext 7\n' | walk --faults fail --trace by-hand.run
  'next' takes the steps of the recorded run, 'goto N' and
  'goto end' go to its states.
  
  state 0, 5 ahead
  A         -
  B         -
  N         -
  script    relay.dol:1
  >  1  program pick(1 vehicle of type 'UUV') (relay.dol:1)
  0> n 2
  
  state 2, 3 ahead
  A         -
  B         noptilus-2
  N         -
  script    relay.dol:1
  >  1  program execute (relay.dol:3)
  2> 
  
  state 3, 2 ahead
  A         -
  B         noptilus-2
  N         -
  task      (watch (survey[noptilus-2] >> action { action }) |
            condition { condition })
  waits for relay.dol:4: consume ready: 1
  >  1  noptilus-2 starts survey (relay.dol:3)
  3> u
  
  state 2, 3 ahead
  A         -
  B         noptilus-2
  N         -
  script    relay.dol:1
  >  1  program execute (relay.dol:3)
  2> 1
  
  state 3, 2 ahead
  A         -
  B         noptilus-2
  N         -
  task      (watch (survey[noptilus-2] >> action { action }) |
            condition { condition })
  waits for relay.dol:4: consume ready: 1
  >  1  noptilus-2 starts survey (relay.dol:3)
  3> g 9
  no state 9: the last one is 5
  3> next 7
  not as many steps ahead: 2 steps
  3> 

It has to fit the world, and the program.

  $ dolphin explore relay.dol --faults fail --trace stuck.run > shown
  [1]
  $ walk --trace stuck.run </dev/null
  dolphin: stuck.run does not fit relay.dol: step 5 cannot be taken: fail(noptilus-1, survey, failure) does not happen in this world; its --faults and answers may be other ones
  [2]
  $ walk --trace relay.dol </dev/null
  dolphin: relay.dol: line 1 is not JSON
  [2]

A counterexample is followed to its end: the state that shows it. Words may be short.

  $ printf 'g end\n\n1\n' | walk --faults fail --trace stuck.run | tail -n 12
  A         -
  B         noptilus-1
  N         -
  task      condition { condition }
  waits for relay.dol:4: consume ready: 1
  Nothing can happen any more, and the program has not ended:
  a deadlock.
  5> 
  nothing can happen here: 'undo' goes back, 'quit' leaves
  5> 1
  no choice 1 here
  5> 

Whatever a sensor may show is a choice; what nobody can list is said, and one may go back.

  $ cat > charge.dol <<'END'
  > v = pick { id 'noptilus-1' }
  > if (battery(v) < 0.5) { message 'low' } else { message 'fine' }
  > post level: battery(v)
  > END
  $ printf '\n\n2\n1\nu 2\nm\n' | dolphin walk charge.dol | tail -n 42
  B         -
  N         -
  waits for charge.dol:1: 1 vehicle with id 'noptilus-1'
     1  program picks noptilus-1 (charge.dol:1)
  1> 
  
  state 2
  A         -
  B         noptilus-1
  N         -
  script    charge.dol:1
     1  program says: low (charge.dol:2)
         if battery(noptilus-1) < 0.5 is true
     2  program says: fine (charge.dol:2)
         if battery(noptilus-1) < 0.5 is false
  2> 2
  
  state 3
  A         -
  B         noptilus-1
  N         -
  script    charge.dol:2
  The possible steps here cannot be listed:
  charge.dol:3:1: error: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
    3 | post level: battery(v)
      | ^^^^^^^^^^^^^^^^^^^^^^
  3> 1
  The possible steps here cannot be listed:
  charge.dol:3:1: error: the value of battery(noptilus-1) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
    3 | post level: battery(v)
      | ^^^^^^^^^^^^^^^^^^^^^^
  3> u 2
  
  state 1, 2 ahead
  A         -
  B         -
  N         -
  waits for charge.dol:1: 1 vehicle with id 'noptilus-1'
  >  1  program picks noptilus-1 (charge.dol:1)
  1> m
  >  1  program picks noptilus-1 (charge.dol:1)
  1> 

Many choices are listed when they are asked for, and taken by their number.

  $ cat > many.dol <<'END'
  > vs = pick { count 4 }
  > END
  $ cat > many.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > vehicle 'c', { type 'UUV' }
  > vehicle 'd', { type 'UUV' }
  > vehicle 'e', { type 'UUV' }
  > END
  $ printf '\n40\n' | dolphin walk many.dol --faults join | tail -n 16
    18  program picks b, d, e, c (many.dol:1)
         if c comes late
    19  program picks c, d, e, a (many.dol:1)
         if a comes late
    20  program picks c, d, e, b (many.dol:1)
         if b comes late
        and more, which 'more' shows
  1> 40
  
  state 2
  A         -
  B         b, e, a, d
  N         -
  script    many.dol:1
     1  program end
  2> 
  $ printf '\nmore\n' | dolphin walk many.dol --faults join | grep -c 'picks'
  140

No line is wider than the terminal.

  $ printf '\n\n\n\n\n\n\n\n\n\n1\n1\n2\n1\n' | dolphin walk ../../examples/rendezvous.dol --faults all | awk 'length($0) > 60'

What is typed wrongly is told.

  $ printf '7\njump\nnext x\ngoto 5\nundo\nwrite\nwrite run.svg\nwrite no/where.run\nnext 2\n\n\n\n?\n' | dolphin walk many.dol
  
  state 0
  A         -
  B         -
  N         -
  script    many.dol:1
     1  program pick(4 vehicles) (many.dol:1)
  0> 7
  no choice 7 here
  0> jump
  'jump' is not known here: type a number, or help
  0> next x
  'next' needs a number, not 'x'
  0> goto 5
  no state 5: the last one is 0
  0> undo
  this is as far back as it goes
  0> write
  'write' needs the name of a file
  0> write run.svg
  'run.svg' is the name of a picture, but JSON would be
  written
  0> write no/where.run
  no/where.run: No such file or directory
  0> next 2
  not as many steps ahead: nothing is
  0> 
  
  state 1
  A         -
  B         -
  N         -
  waits for many.dol:1: 4 vehicles
     1  program picks a, b, c, d (many.dol:1)
     2  program picks a, b, c, e (many.dol:1)
     3  program picks a, b, d, e (many.dol:1)
     4  program picks a, c, d, e (many.dol:1)
     5  program picks b, c, d, e (many.dol:1)
  1> 
  there are several choices: type the number of one
  1> 
  there are several choices: type the number of one
  1> ?
    N           take choice N
    Enter       take the only choice, or the one marked >
    next [N]    take the next step, or the next N, of the run
                ahead
    undo [N]    go back one step, or N; they are ahead then
    goto N      go to the state after N steps, back or ahead
    goto end    go to the last state of the run ahead
    more        show all choices
    state       show the state again
    vars        show the variables
    run         show the steps so far
    write FILE  write the run so far, for exec --follow or
                --trace
    help        show this
    quit        leave
  Words may be shortened, to one letter if you like.
  1> 
