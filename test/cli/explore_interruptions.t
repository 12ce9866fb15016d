Programs that may be interrupted at any time.

  $ explore() { dolphin explore "$@" > result; status=$?; sed 's/, [0-9.]* s, [0-9]* MiB//' result; return $status; }
  $ cat > lock.dol <<'END'
  > v = pick { type 'UUV' }
  > post lock: 1
  > execute v: imcPlan('survey')
  > consume lock: 1
  > END

An interruption is an end like that of the program: it breaks nothing by itself, and pairs that it leaves are not the
program's fault.

  $ explore lock.dol --strict --faults interrupt
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  12 states, 16 transitions, depth 8; reduced by partial order, symmetry of vehicles
  $ explore lock.dol --strict --faults interrupt --reduction none | tail -1
  30 states, 42 transitions, depth 8
  $ explore lock.dol --strict | tail -1
  9 states, 8 transitions, depth 8; reduced by partial order, symmetry of vehicles

What must hold of every state or every run may be broken by it. The run can be followed.

  $ explore lock.dol --faults interrupt --ltl 'G (start(survey) -> F done(survey))' --trace cut.run | sed -n '/^formula/,$p'
  formula G (start(survey) -> F done(survey)): violated after 6 steps: it does not hold
  12 states, 16 transitions, depth 8; reduced by partial order, symmetry of vehicles; 11 states for formulas
  
  formula G (start(survey) -> F done(survey)): a shortest run in which it does not hold
      program                        noptilus-1     where       variables
  1   pick(1 vehicle of type 'UUV')                 lock.dol:1
  2   picks noptilus-1                              lock.dol:1
  3   post lock:1                                   lock.dol:2  v = noptilus-1
  4   execute                                       lock.dol:3
  5                                  starts survey  lock.dol:3
  6   interrupt
      decides the formula: the rest of the run does not matter
  tuples then: {lock:1}
  $ dolphin exec lock.dol --follow cut.run
  breaks: formula G (start(survey) -> F done(survey))
     2  program     picks noptilus-1
     3  program     posts lock:1
     5  noptilus-1  starts survey
     6  noptilus-1  stops survey
     6  program     releases noptilus-1
     6  program     is interrupted
  [130]
  $ explore lock.dol --faults interrupt=0 --ltl 'G (start(survey) -> F done(survey))' | grep formula
  formula G (start(survey) -> F done(survey)): holds
  9 states, 8 transitions, depth 8; reduced by partial order, symmetry of vehicles; 9 states for formulas
  $ explore lock.dol --faults interrupt --ltl 'F (ended & !poll(lock: 1))' --ltl 'F ended' | grep '^formula.*: [hv]'
  formula F (ended & !poll(lock: 1)): violated after 4 steps: it does not hold
  formula F ended: holds

  $ explore lock.dol --faults interrupt --ltl 'F (done(survey) | interrupt)' --ltl 'G (interrupt -> ended & !bound(noptilus-1))' | grep '^formula'
  formula F (done(survey) | interrupt): holds
  formula G (interrupt -> ended & !bound(noptilus-1)): holds

Who is stuck is stuck, though a person could interrupt; who goes on for ever does.

  $ cat > stuck.dol <<'END'
  > execute waitFor { consume never: 1 } then action { message 'never' }
  > END
  $ explore stuck.dol --faults interrupt | head -6
  no deadlock: violated after 1 step: nothing can happen any more, and the program has not ended
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: all code reached: violated: no run reaches action at stuck.dol:1:50
  $ explore stuck.dol --faults interrupt --ltl 'F ended' | grep -A 5 '^formula.*run'
  formula F ended: a shortest run in which it does not hold
      program  where
  1   execute  stuck.dol:1
      decides the formula: the rest of the run does not matter
  $ cat > round.dol <<'END'
  > while (true) { pause 1.seconds }
  > END
  $ explore round.dol --faults interrupt | head -6
  no deadlock: holds
  termination: violated: after 1 step, 2 steps that can repeat without end
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  4 states, 6 transitions, depth 2; reduced by partial order

It is asked for by its name: all that may go wrong is another thing.

  $ for faults in all all,interrupt interrupt,fail=1; do explore lock.dol --faults $faults --reduction none | grep depth; done
  30 states, 29 transitions, depth 8
  37 states, 49 transitions, depth 8
  33 states, 45 transitions, depth 8
  $ dolphin lts lock.dol --faults interrupt | grep -c interrupt
  20
  $ dolphin explore lock.dol --faults interupt
  dolphin: option '--faults': unknown fault 'interupt': did you mean interrupt?
  Usage: dolphin explore [OPTION]… PROG
  Try 'dolphin explore --help' or 'dolphin --help' for more information.
  [2]
