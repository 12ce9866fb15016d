Ctrl-C while an adapter takes its time to greet: all ends at once, nothing has begun, and nothing is left behind.

  $ cat > m.fleet <<'END'
  > vehicle 'auv-1', { type 'UUV' }
  > plan 'long', { duration 24.hours }
  > END
  $ cat > m.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('long')
  > END
  $ cat > slow.sh <<'END'
  > echo $$ > slow.pid
  > exec sleep 60
  > END
  $ quick="dolphin sim m.fleet --platform --state fleet.state"
  $ interrupted() {
  >   rm -f slow.pid; "$@" > log 2>&1 & run=$!
  >   until [ -s slow.pid ]; do sleep 0.05; done; kill -INT $run
  >   wait $run; echo "status $?"; cat log; if kill -0 $(cat slow.pid) 2> gone; then echo "the adapter is left behind"; fi
  > }
  $ interrupted dolphin exec m.dol --journal m.run --platform 'exec sh slow.sh'
  status 130
  dolphin: interrupted before the run began: nothing was started
  $ interrupted dolphin exec m.dol --journal m.run --platform "$quick" --platform 'exec sh slow.sh'
  status 130
  dolphin: interrupted before the run began: nothing was started
  $ ls m.run
  ls: cannot access 'm.run': No such file or directory
  [2]
  $ interrupted dolphin fleet --platform 'exec sh slow.sh'
  status 0
  $ interrupted dolphin check m.dol --platform 'exec sh slow.sh'
  status 130
  m.dol: no errors
  m.fleet: no errors
  dolphin: interrupted before the adapters had answered

A run that is to be resumed and is not: its vehicles are not told to stop, and it can be resumed later.

  $ dolphin exec m.dol --journal m.run --platform "$quick" > log & run=$!
  $ until grep -qs '"start"' fleet.state || ! kill -0 $run; do sleep 0.05; done; kill -KILL $run; wait $run 2> killed
  [137]
  $ dolphin exec m.dol --resume m.run --platform "$quick" --platform false
  dolphin: the adapter 'false' ended with exit status 1 before it greeted
  [3]
  $ interrupted dolphin exec m.dol --resume m.run --platform "$quick" --platform 'exec sh slow.sh'
  status 130
  dolphin: interrupted before the run went on: no vehicle was ordered to stop; go on with it by --resume m.run
  $ grep -c '"kind":"stop"' fleet.state
  0
  [1]
  $ dolphin exec m.dol --resume m.run --platform "$quick" > log & run=$!
  $ until grep -qs 'has its link back' log || ! kill -0 $run; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ grep -c '"kind":"stop"' fleet.state
  1
  $ dolphin trace check m.dol m.run | sed 's/ in .*;/;/'
  m.run: a run, of 5 transitions; interrupted
