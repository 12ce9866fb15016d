What adapters do wrong in the middle of a run.

  $ cat > m.fleet <<'END'
  > vehicle 'auv-1', { type 'UUV' }
  > plan 'a', { duration 10.seconds }
  > plan 'b', { duration 24.hours }
  > END
  $ cat > m.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('a')
  > END
  $ with() { echo "python3 faulty.py '$1' 'dolphin sim m.fleet --platform --state \"state of $1\" --speed 100'"; }
  $ run() { dolphin exec "$@" 2>&1 | sed 's/^ *[0-9]*:[0-9]* *//'; }

A line that is no report is told, and does no harm.

  $ run m.dol --journal 1.run --platform "$(with prints)"
  program     picks auv-1
  auv-1       starts a
  program     platform sim: a line of the adapter is no JSON: Line 1, bytes 0-27: Invalid token 'armed, waiting for the link'; it is ignored
  auv-1       ends a
  program     releases auv-1
  program     ends

The adapter dies: its vehicle loses its link, the next adapter says what became of the plan.

  $ run m.dol --journal 2.run --platform "$(with dies)"
  program     picks auv-1
  auv-1       starts a
  program     platform sim: the adapter ended with exit status 4; its vehicles have lost their link
  auv-1       loses its link
  program     platform sim: the adapter runs again
  auv-1       has its link back
  auv-1       ends a
  program     releases auv-1
  program     ends
  $ dolphin trace check m.dol 2.run | sed 's/ in 0:0[0-9]//'
  2.run: a run, of 6 transitions; completed
  $ grep -c '"start"' 'state of dies'
  1

A stop that is never confirmed is named at the end. Ctrl-C, when the adapter has the order to start: one that is not
sent yet is not sent then.

  $ sed 's/imcPlan(.a.)/imcPlan("b")/' m.dol > b.dol
  $ dolphin exec b.dol --journal 3.run --platform "$(with 'no stop')" > log 2>&1 & run=$!
  $ until grep -qs '"start"' 'state of no stop' || ! kill -0 $run; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ sed 's/^ *[0-9]*:[0-9]* *//' log
  program     picks auv-1
  auv-1       starts b
  auv-1       stops b
  program     releases auv-1
  program     is interrupted
  program     auv-1: may still run plan b: it was not heard to have stopped
