Rounds, and tasks that are tried again, in a run.

What goes round without any wait is stopped after 10,000 rounds, and says where it is.

  $ cat > spin.dol << 'END'
  > post go: 1
  > execute repeat waitFor { consume go: 1 } then action { post go: 1 }
  > END
  $ touch spin.fleet
  $ dolphin exec --sim spin.dol > log 2> error
  [1]
  $ grep -c 'posts go:1' log
  10001
  $ tail -n 1 log
     0:00  program     is stuck
  $ head -n 1 error
  spin.dol:2:9: error: the program is stuck in rounds that begin here: they follow each other, and none waits for anything that happens
  $ cat > again.dol << 'END'
  > execute watch action { fail 'no' } onError { retry() }
  > END
  $ dolphin exec --sim=spin.fleet again.dol > log 2> error
  [1]
  $ grep -c 'has an error in a task: no' log
  10000
  $ head -n 1 error | cut -d: -f1-3
  again.dol:1:9

Nor do tasks that end or fail at the instant at which they begin let a round wait, whatever goes round.

  $ spins() { dolphin exec --sim=$1.fleet $1.dol > log 2> error; echo $?; tail -n 1 log | cut -c 10-; sed -n '1s/, and.*//p' error; }
  $ printf "vehicle 'a', { type 'UUV'; battery 0.percent }\n" > empty.fleet
  $ cat > empty.dol << 'END'
  > v = pick { type 'UUV' }
  > execute watch task('short') onError { retry() }
  > END
  $ spins empty
  1
  program     is stuck
  empty.dol:2:9: error: the program is stuck in rounds that begin here: they follow each other
  $ printf "vehicle 'a', { type 'UUV' }\nplan 'short', { only 'UAV'; duration 1.min }\n" > only.fleet; cp empty.dol only.dol
  $ spins only
  1
  program     is stuck
  only.dol:2:9: error: the program is stuck in rounds that begin here: they follow each other
  $ printf "vehicle 'a', { type 'UUV' }\n" > popup.fleet
  $ cat > popup.dol << 'END'
  > v = pick { type 'UUV' }
  > execute repeat imcPlan { planName 'up'; popup duration: 0 }
  > END
  $ spins popup
  1
  program     is stuck
  popup.dol:2:9: error: the program is stuck in rounds that begin here: they follow each other
  $ cp popup.fleet script.fleet; cat > script.dol << 'END'
  > v = pick { type 'UUV' }
  > while (true) { execute imcPlan { planName 'up'; popup duration: 0 } }
  > END
  $ spins script
  1
  program     is stuck
  script.dol:2:24: error: the program is stuck in rounds that begin here: they follow each other
  $ (cat popup.fleet; echo "answer 'Again?', 'no'") > asks.fleet; cat > asks.dol << 'END'
  > execute watch confirm('Again?') onError { retry() }
  > END
  $ spins asks
  1
  program     is stuck
  asks.dol:1:9: error: the program is stuck in rounds that begin here: they follow each other
  $ echo "execute repeat idle(0)" > idle.dol; cp popup.fleet idle.fleet
  $ spins idle
  1
  program     is stuck
  idle.dol:1:9: error: the program is stuck in rounds that begin here: they follow each other

Loops of the script have no rounds. They are stopped after a million steps at one instant, whatever they are made of;
a loop that ends is not.

  $ cat > picks.dol << 'END'
  > while (true) { v = pick { type 'UUV' }; release v }
  > END
  $ cat > calls.dol << 'END'
  > execute idle(5)
  > def go() { execute idle(0); go() }
  > go()
  > END
  $ for p in picks calls; do cp idle.fleet $p.fleet; dolphin exec -q --sim=$p.fleet $p.dol > log 2> error; echo $?; sed -n '1s/, and.*//p' error; done
  1
  picks.dol:1:20: error: the program is stuck in rounds that begin here: they follow each other
  1
  calls.dol:2:12: error: the program is stuck in rounds that begin here: they follow each other
  $ cat > many.dol << 'END'
  > n = 0
  > while (n < 100000) { post k: n; n = n + 1 }
  > END
  $ dolphin exec -q --sim=idle.fleet many.dol > log; echo $?
  0

Nor does a loop without a visible step go on; its journal is that of a run that was stuck.

  $ echo 'while (true) { x = 1 }' > silent.dol
  $ printf 'def f() { f() }\nf()\n' > pure.dol
  $ for p in silent pure; do
  >   cp idle.fleet $p.fleet; dolphin exec -q --sim=$p.fleet $p.dol --journal $p.run > log 2> error; echo $?
  >   sed -n '1s/, and.*//p' error; dolphin trace check $p.dol $p.run | sed 's/of [0-9]* transitions/of so many/'
  > done
  1
  silent.dol:1:8: error: the program is stuck in rounds that begin here: they follow each other
  silent.run: a run, of so many in 0:00; stuck
  1
  pure.dol:1:11: error: the program is stuck in rounds that begin here: they follow each other
  pure.run: a run, of so many in 0:00; stuck
  $ cat > long.dol << 'END'
  > n = 0
  > while (n < 1000000) { n = n + 1 }
  > END
  $ dolphin exec -q --sim=idle.fleet long.dol > log; echo $?
  0

All of these are known before they run; no example of a mission is such a loop.

  $ for p in empty only popup script idle; do dolphin check $p.dol 2>&1 | grep warning: ; done
  empty.dol:2:9: warning: this fails at once, and retry() starts it again at the same instant
  only.dol:2:9: warning: this fails at once, and retry() starts it again at the same instant
  popup.dol:2:9: warning: a round of this takes no time: a run that gets here goes round at one instant
  script.dol:2:1: warning: a round of this takes no time: a run that gets here goes round at one instant
  idle.dol:1:9: warning: a round of this takes no time: a run that gets here goes round at one instant
  $ for p in ../../examples/missions/*.dol; do dolphin check $p 2>&1; done | grep ': warning'
  [1]

A warning is true of the run, whatever the loop is made of; what takes time, ends, or may be ended has none.

  $ cat > times.fleet << 'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UAV' }
  > plan 'none', { duration 0.seconds }
  > plan 'some', { duration 1.min }
  > plan 'air', { only 'UAV' }
  > plan 'broken', { duration 0.seconds; fails }
  > plan 'often', { duration 0.seconds; mayFail 50.percent }
  > END
  $ in_loop() {
  >   (echo "v = pick { type 'UUV' }"; echo 'n = 0'; echo "$1") > loop.dol
  >   dolphin check loop.dol --fleet times.fleet 2>&1 | grep -q ': warning' && warned=warned || warned=quiet
  >   dolphin exec loop.dol --fleet times.fleet 2>&1 | head -n 50000 > log
  >   grep -q 'stuck in rounds' log && echo "$warned, stuck: $1" || echo "$warned: $1"
  > }
  $ in_loop "execute repeat task('none')"
  warned, stuck: execute repeat task('none')
  $ in_loop "execute repeat imcPlan { planName 'x'; locate 41.2, -8.7; goTo speed: 2 }"
  warned, stuck: execute repeat imcPlan { planName 'x'; locate 41.2, -8.7; goTo speed: 2 }
  $ in_loop "p = task('none'); execute repeat (p >> p) until { consume stop: 1 }"
  warned, stuck: p = task('none'); execute repeat (p >> p) until { consume stop: 1 }
  $ in_loop "def t() { task('none') >> action { n = n + 1 } }; execute repeat watch t() onError { ignore() }"
  warned, stuck: def t() { task('none') >> action { n = n + 1 } }; execute repeat watch t() onError { ignore() }
  $ in_loop "execute watch task('air') onError { e -> message e; retry() }"
  warned, stuck: execute watch task('air') onError { e -> message e; retry() }
  $ in_loop "execute repeat watch task('broken') onError { ignore() }"
  warned, stuck: execute repeat watch task('broken') onError { ignore() }
  $ in_loop "execute watch action { fail 'no' } onError { retry() }"
  warned, stuck: execute watch action { fail 'no' } onError { retry() }
  $ in_loop "execute repeat 3, task('none')"
  quiet: execute repeat 3, task('none')
  $ in_loop "execute (repeat task('some') >> task('none')) during 1.hour"
  quiet: execute (repeat task('some') >> task('none')) during 1.hour
  $ in_loop "execute repeat task('often')"
  quiet: execute repeat task('often')
  $ in_loop "execute watch task('often') onError { retry() }"
  quiet: execute watch task('often') onError { retry() }
  $ in_loop "execute watch task('air') onError { n = n + 1; if (n < 3) retry() else ignore() }"
  quiet: execute watch task('air') onError { n = n + 1; if (n < 3) retry() else ignore() }
  $ in_loop "execute until { consume up: 1 } run repeat task('none') >> action { post up: 1 }"
  quiet: execute until { consume up: 1 } run repeat task('none') >> action { post up: 1 }
  $ in_loop "def t() { imcPlan { planName 'x'; locate 41.2, -8.7; goTo() } }; execute (repeat t() >> t()[v]) during 9.hours"
  warned, stuck: def t() { imcPlan { planName 'x'; locate 41.2, -8.7; goTo() } }; execute (repeat t() >> t()[v]) during 9.hours

So it is in paced time.

  $ dolphin exec empty.dol --fleet empty.fleet --speed 1 > log 2> error
  [1]
  $ tail -n 1 log | sed 's/^ *[0-9:]* *//'
  program     is stuck
  $ dolphin exec empty.dol --fleet empty.fleet --speed 1000 --journal empty.run > log 2> error
  [1]
  $ tail -n 1 log | sed 's/^ *[0-9:]* *//'
  program     is stuck

  $ for p in picks calls idle; do dolphin exec -q --sim=$p.fleet --speed 7 $p.dol > log 2> error; echo $?; sed -n '1s/, and.*//p' error; done
  1
  picks.dol:1:20: error: the program is stuck in rounds that begin here: they follow each other
  1
  calls.dol:2:12: error: the program is stuck in rounds that begin here: they follow each other
  1
  idle.dol:1:9: error: the program is stuck in rounds that begin here: they follow each other

A wait begins the count again:

  $ cat > waits.dol << 'END'
  > n = 0
  > while (n < 40) { for (i in 1..1000) { post k: i; consume(k: i) }; n = n + 1; execute idle(1) }
  > message n
  > END
  $ dolphin exec --sim=idle.fleet --speed 20 waits.dol | tail -n 2 | cut -c 10-
  program     says: 40
  program     ends

Rounds in which something happens are not counted: these are 20,000.

  $ cat > many.dol << 'END'
  > n = 0
  > execute repeat 20000, (action { n = n + 1 } >> idle(1))
  > message n
  > END
  $ dolphin exec --sim=spin.fleet many.dol | tail -n 2
  5:33:20  program     says: 20000
  5:33:20  program     ends

Whoever dies within a round, or between two tries, another one goes on: after each transition, to the same end.

  $ resumed() {
  >   dolphin exec $1 --journal whole.run > whole.log
  >   for n in $(grep -n '"i":' whole.run | sed '$d' | cut -d: -f1); do
  >     head -n $n whole.run > died.run
  >     dolphin exec --resume died.run $1 > second.log 2>&1 || cat second.log
  >     dolphin trace check $1 died.run
  >   done | sort | uniq -c | sed 's|^ *||'
  > }
  $ resumed ../../examples/repeat.dol
  48 died.run: a run, of 49 transitions in 1:09:01; completed
  $ resumed ../../examples/second_try.dol
  22 died.run: a run, of 23 transitions in 35:47; completed
  $ resumed ../../examples/missions/replacement.dol
  21 died.run: a run, of 22 transitions in 43:59; completed

Formulas are asked of fair runs: one in which q never ends, while p goes round, is none, unless all runs are asked. One
without any event is what the runtime would do.

  $ cat > fair.dol << 'END'
  > v = pick { type 'UUV' }
  > w = pick { type 'UUV' }
  > execute (task('q')[w] >> action { post z: 1 }) | (until { poll z: 1 } run repeat task('p')[v])
  > END
  $ printf "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\n" > fair.fleet
  $ dolphin explore fair.dol --ltl 'F ended' --ltl 'F G !start(p)' | grep -e termination -e '^formula.*: [hv]'
  termination: holds
  formula F ended: holds
  formula F G !start(p): holds
  $ dolphin explore fair.dol --fairness none --ltl 'F ended' | grep -e termination -e '^formula.*: [hv]'
  termination: holds
  formula F ended: violated: after 8 steps, 2 steps that can repeat without end
  $ dolphin explore fair.dol --fairness none
  dolphin: --fairness none is about formulas: give --ltl too
  [2]
  $ dolphin explore spin.dol --ltl 'F ended' | grep -e termination -e '^formula.*: [hv]'
  termination: violated: after 2 steps, 2 steps that can repeat without end
  formula F ended: violated: after 2 steps, 2 steps that can repeat without end
  termination: a run in which the program may never end

The explorer and the timed analysis have the same rounds. Without a duration in the fleet, a plan on an empty battery may
be one without any time, which succeeds.

  $ for p in empty only popup; do dolphin explore $p.dol | grep termination; dolphin time $p.dol | head -1; done
  termination: by design not: retry at empty.dol:2:9; ended by short being done on a
  completed: 0:00 at the earliest, no latest time
  termination: by design not: retry at only.dol:2:9; ended by nothing that may happen here
  no run ends
  termination: by design not: repeat at popup.dol:2:9; ended by nothing that may happen here
  no run ends

So it is for each battery, filter, duration and loop: where a run is stuck in rounds, termination does not hold and no
run ends; where it completes, both have that.

  $ task="task('short')"
  $ loops() { printf '%s\n' "execute $task" "execute watch $task onError { retry() }" \
  >   "execute watch $task onError { ignore() }" "while (!poll(x: 1)) { execute watch $task onError { ignore() } }"; }
  $ verdict() {
  >   dolphin exec --quiet drawn.dol > log 2>&1; ran=$?
  >   dolphin explore drawn.dol | grep -q 'termination: holds' && ends=explored || ends=rounds
  >   dolphin time drawn.dol | grep -q '^no run ends' && timed=rounds || timed=ends
  >   grep -q 'stuck in rounds' log && ran=rounds
  >   echo "$ran $ends $timed"
  > }
  $ for battery in 0 100; do for only in UUV UAV; do for duration in 0.seconds 1.min; do loops | while read -r loop; do
  >   printf "vehicle 'a', { type 'UUV'; battery $battery.percent }\n" > drawn.fleet
  >   printf "plan 'short', { only '$only'; duration $duration }\n" >> drawn.fleet
  >   printf "v = pick { type 'UUV' }\n%s\n" "$loop" > drawn.dol
  >   case $loop/$duration/$only/$battery in while*/1.min/UUV/100) ;; *) verdict ;; esac
  > done; done; done; done | sort | uniq -c | sed 's/^ *//'
  14 0 explored ends
  5 1 explored ends
  12 rounds rounds rounds
