Values that are nested 200,000 deep, in a run, in all runs, and in time.

  $ cat > made.dol <<'X'
  > x = []
  > y = []
  > for (i in 1..200000) { x = [x]; y = [y] }
  > def wrap(f) { return { -> f } }
  > f = 1
  > for (i in 1..200000) { f = wrap(f) }
  > X
  $ cat > all.fleet <<'X'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > plan 'p', { duration 1.min }
  > plan 'q', { duration 1.min }
  > X

  $ cat made.dol - > equal.dol <<'X'
  > def after(x) { return action { y = [x] } >> imcPlan('q') }
  > v = pick { count 2 }
  > execute v: after(f) | (imcPlan('p') >> action { y = x })
  > message x == y ? 'equal' : 'not equal'
  > X
  $ dolphin check equal.dol
  equal.dol: no errors
  $ dolphin exec --sim=all.fleet --journal run equal.dol | tail -1
     1:00  program     ends
  $ dolphin trace check equal.dol run
  run: a run, of 271 transitions in 1:00; completed
  $ dolphin explore --fleet all.fleet equal.dol | grep -v states
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  $ dolphin time --fleet all.fleet equal.dol | grep -v states
  completed: 1:00 at the earliest, 1:00 at the latest
  task  vehicle  starts  ends  where
  p     b        0:00    1:00  equal.dol:9
  q     a        0:00    1:00  equal.dol:7
  vehicle  least battery
  a        99.8 %
  b        99.8 %
  
  a run that ends last:
         program           b         a         where         variables
  0:00   pick(2 vehicles)                      equal.dol:8   x = ..., y = ...
  0:00   picks a, b                            equal.dol:8
  0:00   execute                               equal.dol:9   v = [a, b]
  0:00                     starts p            equal.dol:9
  0:00   act                                   equal.dol:7   y = [{ closure }]
  0:00                               starts q  equal.dol:7
  1:00                     ends p              equal.dol:9
  1:00   act                                   equal.dol:9   y = ...
  1:00                               ends q    equal.dol:7
  1:00   message 'equal'                       equal.dol:10
  1:00   end
  its end depends on: equal.dol:7:45: q on a (1:00)
  $ dolphin lts --fleet all.fleet equal.dol | head -1 | cut -c 1-5
  des (

  $ cat made.dol - > sensor.dol <<'X'
  > v = pick { count 1 }
  > message v.battery == x ? 'equal' : 'not equal'
  > X
  $ dolphin exec --sim=all.fleet sensor.dol | tail -1
     0:00  program     ends
  $ dolphin explore --fleet all.fleet sensor.dol 2>&1 | grep -v states
  no deadlock: inconclusive, sensor.dol:8:9: the value of battery(a) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  termination: inconclusive, sensor.dol:8:9: the value of battery(a) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  no unhandled error: inconclusive, sensor.dol:8:9: the value of battery(a) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  assertions: inconclusive, sensor.dol:8:9: the value of battery(a) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  vehicles for all tasks: inconclusive, sensor.dol:8:9: the value of battery(a) is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements

  $ cat made.dol - > key.dol <<'X'
  > m = [a: 1]
  > m[x] = 2
  > X
  $ dolphin exec key.dol
     0:00  program     fails: a value that is nested more than 10000 deep is too large for this
  key.dol:8:1: error: a value that is nested more than 10000 deep is too large for this
    8 | m[x] = 2
      | ^^^^^^^^
  [1]
  $ dolphin explore key.dol 2>&1 | grep -v states
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 261 steps: an unhandled error ends the program
  assertions: holds
  vehicles for all tasks: holds
  
  no unhandled error: a shortest run in which an unhandled error ends the program
      program                                   where      variables
  1   fault(a value that is nested more than 10000 deep is too large for this)  key.dol:8  x = ..., y = ..., m = [a:1]
  $ dolphin time key.dol 2>&1 | grep -v states
  failed: 0:00 at the earliest, 0:00 at the latest
  
  a run that ends last:
         program                                   where      variables
  0:00   fault(a value that is nested more than 10000 deep is too large for this)  key.dol:8  x = ..., y = ..., m = [a:1]
