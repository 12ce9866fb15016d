Looks at sensors do not contradict each other as long as no time passes: a battery that is low is not full at the same
moment. So these programs do not go round in no time.

  $ explore() { dolphin explore "$@" --fleet one.fleet | grep -e termination -e deadlock; }
  $ timed() { dolphin time "$@" --fleet one.fleet | grep -e completed -e endlessly; }
  $ cat > one.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'p', { duration 3.min, 9.min }
  > plan 'q', { duration 3.min, 9.min }
  > END
  $ cat > chatter.dol <<'END'
  > v = pick { id 'a' }
  > execute (repeat oneOf {
  >   when { battery(v) < 0.3 } then (until { battery(v) >= 0.3 } run task('p'))
  >   when { battery(v) >= 0.3 } then (until { battery(v) < 0.3 } run task('q'))
  > }) during 2.hours
  > END
  $ explore chatter.dol
  no deadlock: holds
  termination: holds
  $ timed chatter.dol
  completed: 2:00:00 at the earliest, 2:00:00 at the latest
  $ sed 's/battery(v) >= 0.3/battery(v) > 0.5/' chatter.dol > apart.dol
  $ explore apart.dol
  no deadlock: holds
  termination: holds
  $ timed apart.dol
  completed: 2:00:00 at the earliest, 2:00:00 at the latest

A date that has passed stays passed.

  $ cat > date.dol <<'END'
  > v = pick { id 'a' }
  > execute (repeat oneOf {
  >   when { now() > 60 } then (until { now() <= 60 } run task('p'))
  >   when { now() <= 60 } then (until { now() > 60 } run task('q'))
  > }) during 2.hours
  > END
  $ explore date.dol
  no deadlock: holds
  termination: holds
  $ timed date.dol
  completed: 2:00:00 at the earliest, 2:00:00 at the latest
  $ cat > passed.dol <<'END'
  > while (true) {
  >   pause 10
  >   if (now() <= 60) halt 'early'
  >   pause 10
  >   if (now() > 60) halt 'late'
  > }
  > END
  $ explore passed.dol
  no deadlock: holds
  termination: holds

What one moment may show is a run in no time.

  $ cat > spin.dol <<'END'
  > v = pick { id 'a' }
  > execute (repeat (condition { battery(v) < 0.3 } >> condition { battery(v) < 0.5 })) during 2.hours
  > END
  $ explore spin.dol
  no deadlock: holds
  termination: violated: after 3 steps, 2 steps that can repeat without end
  termination: a run in which the program may never end
  $ timed spin.dol
  completed: 2:00:00 at the earliest, 2:00:00 at the latest
  a run that may loop endlessly in no time:

A formula is asked of runs of a world, too.

  $ dolphin explore chatter.dol --fleet one.fleet --ltl 'F ended' | grep '^formula'
  formula F ended: holds
  $ dolphin explore spin.dol --fleet one.fleet --ltl 'F ended' | grep '^formula.*violated'
  formula F ended: violated: after 3 steps, 2 steps that can repeat without end
