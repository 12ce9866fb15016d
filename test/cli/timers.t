The rows of timers have the places of the steps that wait: 'during', 'within' and 'idle', not of 'execute'.

  $ cat > rows.py <<'END'
  > # The deed and the place of each row of a run that is shown.
  > import re, sys
  > for line in sys.stdin:
  >     row = re.match(r' *\d+ +(.*?) {2,}.*?(\w+\.dol:\d+)', line)
  >     if row and re.match('timeout|set-time|yes|no|answer|recruit', row[1]):
  >         print(row[2], row[1])
  > END
  $ cat > one.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > plan 'p', { duration 3.min, 9.min }
  > answer 'now?', yes
  > END
  $ rows() { COLUMNS=200 dolphin explore "$@" --fleet one.fleet | sed -n '/^formula.*shortest/,$p' | python3 rows.py; }
  $ cat > timers.dol <<'END'
  > v = pick { type 'UUV' }
  > wait = idle(20)
  > limit = 10.seconds
  > t = during(2 * limit) run
  >   (task('p')[v]
  >    | idle(5)
  >      >> idle(3))
  > execute action {} >> t
  >   >> during 5.minutes run (
  >     idle(7) within
  >       1.minute)
  >   >> watch within { limit }
  >      run (wait >> action { post here: 1 }) onError {
  >        post late: 1
  >        ignore()
  >      }
  >   >> repeat 2, (
  >     idle(1))
  > END
  $ rows timers.dol --ltl 'G !end'
  timers.dol:4 timeout
  timers.dol:9 timeout
  $ rows timers.dol --ltl 'G !post(here)'
  timers.dol:4 timeout
  timers.dol:10 timeout
  timers.dol:12 set-time(10)
  timers.dol:2 timeout
  timers.dol:9 timeout
  $ dates() { COLUMNS=200 dolphin time "$@" --fleet one.fleet | sed -n 's/^ *\([0-9]:[0-9]*  *timeout\) */\1  /p; /depends/p'; }
  $ dates timers.dol
  0:05   timeout  timers.dol:6                               idled long enough
  0:08   timeout  timers.dol:7                               idled long enough
  0:20   timeout  timers.dol:4                               cuts a task short: its time is up
  0:27   timeout  timers.dol:10                              idled long enough
  0:37   timeout  timers.dol:12                              stops a task that is not done within its time

A wait ends together with others: those are cancelled, and the row has the place of the one that expired. The
durations that an end depends on have these places, too.

  $ cat > nested.dol <<'END'
  > execute action {}
  >   >> repeat 2, (
  >     during 5.minutes run (
  >       within 1.minute run (
  >         idle(7))))
  >   >> action { post over: 1 }
  > END
  $ rows nested.dol --ltl 'G !post(over)'
  nested.dol:2 timeout
  nested.dol:2 timeout
  $ dates nested.dol
  0:07   timeout  nested.dol:4  idled long enough
  0:14   timeout  nested.dol:4  idled long enough
  its end depends on: nested.dol:4:27: a timer (0:07), then nested.dol:4:27: a timer (0:07)

Questions, and vehicles that are recruited.

  $ cat > asks.dol <<'END'
  > execute action {} >>
  >   confirm('now?') >>
  >   recruit {
  >     type 'UUV'
  >   } then { v -> task('p')[v] }
  > END
  $ rows asks.dol --ltl 'G !start(p)'
  asks.dol:2 answer(yes)
  asks.dol:3 recruit(noptilus-1)

A task that ends exactly when its time is up is a tie: the timer wins in a simulated run, and explore and time show both
outcomes. A millisecond less is none.

  $ cat > tie.dol <<'END'
  > v = pick { id 'a' }
  > execute watch (task('p') within 1.min) >> action { message 'in time' } onError { message 'too late' }
  > END
  $ tie() { printf "vehicle 'a', { type 'UUV' }\nplan 'p', { duration $1 }\n" > tie.fleet; }
  $ tie 60.seconds
  $ dolphin exec tie.dol 2> /dev/null | grep -o 'says: .*'
  says: too late
  $ for text in 'in time' 'too late'; do dolphin explore tie.dol --ltl "G !message(\"$text\")" | grep -o '^formula.*: [hv][a-z]*'; done
  formula G !message("in time"): violated
  formula G !message("too late"): violated
  $ dolphin time tie.dol | grep -e '^completed' -e within: -e '^p '
  completed: 1:00 at the earliest, 1:00 at the latest
  tie.dol:2:15: within: missed, at 1:00
  p     a        0:00    1:00  1:00     tie.dol:2
  $ tie 59.999.seconds
  $ dolphin exec tie.dol 2> /dev/null | grep -o 'says: .*'
  says: in time
  $ dolphin time tie.dol | grep -e '^completed' -e within: -e '^p '
  completed: 0:59.999 at the earliest, 0:59.999 at the latest
  tie.dol:2:15: within: kept
  p     a        0:00    0:59.999  tie.dol:2

  $ check-journals
