A loop until the battery is charged ends if that happens some time. Without an assumption the verdict names the readings
whose recurrence would make it end.

  $ explore() { dolphin explore "$@" | grep -e ^termination: -e ^formula; }
  $ cat > world.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > plan 'charge', { duration 3.min, 9.min }
  > plan 'survey', { duration 3.min, 9.min }
  > EOF
  $ cp world.fleet assuming.fleet
  $ echo "assume eventually { battery('a') > 0.8 }" >> assuming.fleet
  $ cat > recharge.dol <<'EOF'
  > v = pick { id 'a' }
  > execute task('survey')[v] >> (repeat task('charge')[v] until { battery(v) >= 0.5 })
  > EOF
  $ explore recharge.dol --fleet world.fleet
  termination: violated: after 5 steps, 3 steps that can repeat without end; holds if battery(a) >= 0.5 recurs
  termination: a run in which the program may never end
  $ explore recharge.dol --fleet assuming.fleet --ltl 'F ended' --ltl 'G !fail'
  termination: holds if battery(a) > 0.8 recurs
  formula F ended: holds if battery(a) > 0.8 recurs
  formula G !fail: holds
  $ dolphin explore recharge.dol --fleet assuming.fleet --ltl 'F ended' --fairness none | grep ^formula.*violated
  formula F ended: violated: after 5 steps, 3 steps that can repeat without end
  $ dolphin explore recharge.dol --fleet assuming.fleet --json | jq -c '.verdicts[] | select(.property == "termination")'
  {"property":"termination","verdict":"holds","assuming":["battery(a) > 0.8"]}

The same in the script, with a variable that has the vehicle's name, and by branches.

  $ cat > script.dol <<'EOF'
  > a = pick { id 'a' }
  > while (battery(a) < 0.5) { execute task('charge')[a] }
  > EOF
  $ explore script.dol --fleet assuming.fleet
  termination: holds if battery(a) > 0.8 recurs
  $ cat > branches.dol <<'EOF'
  > v = pick { id 'a' }
  > done = false
  > execute repeat oneOf {
  >   when { battery(v) < 0.8 } then task('charge')[v]
  >   when { battery(v) >= 0.8 } then action { done = true }
  > } until { done }
  > EOF
  $ explore branches.dol --fleet assuming.fleet
  termination: holds if battery(a) > 0.8 recurs

Another reading does not help, nor that of another vehicle; with a parameter the assumption is about each. A vehicle that
is picked may be any: the states are searched without symmetry.

  $ sed 's/>= 0.5/< 0.1/' recharge.dol > empty.dol
  $ explore empty.dol --fleet assuming.fleet | head -1
  termination: violated: after 5 steps, 3 steps that can repeat without end; holds if battery(a) < 0.1 recurs
  $ sed "s/id 'a'/count 1/" recharge.dol > any.dol
  $ explore any.dol --fleet assuming.fleet | head -1
  termination: violated: after 5 steps, 3 steps that can repeat without end; holds if battery(b) >= 0.5 recurs
  $ cp world.fleet each.fleet
  $ echo 'assume eventually { v -> battery(v) > 0.8 }' >> each.fleet
  $ explore any.dol --fleet each.fleet
  termination: holds if battery(a) > 0.8 recurs and battery(b) > 0.8 recurs

What is endless by design stays so, and a spin is one in any case.

  $ cat > patrol.dol <<'EOF'
  > v = pick { id 'a' }
  > execute repeat (task('survey')[v] >> (repeat task('charge')[v] until { battery(v) > 0.8 }))
  > EOF
  $ explore patrol.dol --fleet world.fleet | head -1
  termination: violated: after 5 steps, 3 steps that can repeat without end
  $ explore patrol.dol --fleet assuming.fleet
  termination: by design not: repeat at patrol.dol:2:9; ended by nothing that may happen here; only this, if battery(a) > 0.8 recurs
  $ cat > spin.dol <<'EOF'
  > v = pick { id 'a' }
  > while (battery(v) <= 0.8) { message 'low' }
  > EOF
  $ explore spin.dol --fleet assuming.fleet --ltl 'F ended' | grep -v run
  termination: violated: after 3 steps, 1 step that can repeat without end
  formula F ended: violated: after 3 steps, 1 step that can repeat without end

An assumption does not matter to a program that reads no sensor.

  $ echo "message 'hello'" > hello.dol
  $ dolphin explore hello.dol --fleet assuming.fleet 2>&1 | grep sensor
  dolphin: assuming.fleet:5:1: the program reads no sensor, so assume(eventually { battery('a') > 0.8 }) does not matter

Between two events a sensor keeps its value: a battery that was just charged is not low. What is begun and cut off again
and again need not be done under weak fairness. Strong fairness, and the reading that has to recur, are named.

  $ cat > breaks.dol <<'EOF'
  > include 'prelude'
  > v = pick { id 'a' }
  > survey = imcPlan { planName 'survey'; locate 41.1850, -8.7060; goTo(); move 100, 0; goTo() }
  > execute withBreaks(v, survey, repeat task('charge')[v] until { battery(v) > 0.8 }) { battery(v) < 0.3 }
  > EOF
  $ explore breaks.dol --fleet world.fleet | head -1
  termination: violated: after 3 steps, 9 steps that can repeat without end; holds with --fairness strong, if battery(a) > 0.8 recurs
  $ explore breaks.dol --fleet assuming.fleet | head -1
  termination: violated: after 3 steps, 18 steps that can repeat without end; holds with --fairness strong
  $ explore breaks.dol --fleet assuming.fleet --fairness strong --ltl 'F ended'
  termination: holds with --fairness strong, if battery(a) > 0.8 recurs
  formula F ended: holds with --fairness strong, if battery(a) > 0.8 recurs
  $ dolphin explore breaks.dol --fleet world.fleet --json | jq -c '.verdicts[] | select(.property == "termination") | del(.run, .cycle, .assumptions)'
  {"property":"termination","verdict":"violated","shortest":false,"holds if these recur":["battery(a) > 0.8"],"holds with strong fairness":true}

The same for a plan that a time cuts off, without readings.

  $ cat > cut.dol <<'EOF'
  > v = pick { id 'a' }
  > while (!poll(x: 1)) { execute (task('survey')[v] >> action { post x: 1 }) during 60 }
  > EOF
  $ explore cut.dol --fleet world.fleet --ltl 'F ended' | grep -v run
  termination: violated: after 3 steps, 2 steps that can repeat without end; holds with --fairness strong
  formula F ended: violated: after 3 steps, 2 steps that can repeat without end
  $ explore cut.dol --fleet world.fleet --fairness strong --ltl 'F ended'
  termination: holds with --fairness strong
  formula F ended: holds with --fairness strong
  $ dolphin explore cut.dol --fleet world.fleet --fairness strong --sample 10
  dolphin: strong fairness needs all states: give --fairness or --sample, not both
  [2]
  $ dolphin explore cut.dol --fleet world.fleet --fairness none
  dolphin: --fairness none is about formulas: give --ltl too
  [2]

A run in no time is reported with strong fairness, too. A cycle that is shown takes what strong fairness owes.

  $ cat > spins.dol <<'EOF'
  > v = pick { id 'a' }
  > post x: 1
  > while (poll(x: _)) { execute until { poll x: 1 } run (task('survey')[v] >> action { consume x: 1 }) }
  > EOF
  $ explore spins.dol --fleet world.fleet --fairness strong --ltl 'F ended' | grep -v run
  termination: violated: after 5 steps, 2 steps that can repeat without end
  formula F ended: violated: after 5 steps, 3 steps that can repeat without end
  $ cat > again.dol <<'EOF'
  > v = pick { id 'a' }
  > while (true) { execute (task('survey')[v] >> idle(5)) during 60 }
  > EOF
  $ dolphin explore again.dol --fleet world.fleet --fairness strong | sed -n '/^and from there/,$p'
  and from there, again and again:
      program  a              where
  5   execute                 again.dol:2
  6            starts survey  again.dol:2
  7            ends survey    again.dol:2
  8   timeout                 again.dol:2

Without an event or a wait between them, two looks at a sensor agree; a date that has passed stays passed. A run that
halts only against that is not reported.

  $ cat > low.dol <<'EOF'
  > v = pick { id 'a' }
  > if (battery(v) < 0.3) {
  >   message 'low'
  >   if (battery(v) >= 0.3) halt 'low, and not low'
  > }
  > if (now() > 60) {
  >   execute task('survey')[v]
  >   if (now() < 60) halt 'earlier'
  > }
  > EOF
  $ dolphin explore low.dol --fleet world.fleet --strict | grep halt
  no halt: holds
  $ sed "s/message 'low'/execute task('charge')[v]/" low.dol > charged.dol
  $ dolphin explore charged.dol --fleet world.fleet --strict | grep halt:
  no halt: violated after 6 steps: the program halts
  no halt: a shortest run in which the program halts
  $ dolphin explore low.dol --fleet world.fleet --strict --certify low.json > /dev/null
  $ head -1 low.json | jq -c '.holds'
  ["no deadlock","no unhandled error","assertions","vehicles for all picks","vehicles for all tasks","no leftover tuples"]
