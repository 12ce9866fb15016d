A program runs on the built-in fleet if there is no other.

  $ cat > visit.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('visit')
  > message "${v} is back"
  > EOF
  $ dolphin exec visit.dol
     0:00  program     picks noptilus-1
     0:00  noptilus-1  starts visit
     2:04  noptilus-1  ends visit
     2:04  program     says: noptilus-1 is back
     2:04  program     releases noptilus-1
     2:04  program     ends

Saying so makes no difference.

  $ dolphin exec visit.dol > plain.log
  $ dolphin exec --sim visit.dol | diff plain.log -

A fleet beside the program is taken; one that is named goes before it.

  $ cat > visit.fleet <<'EOF'
  > vehicle 'beside', { type 'UUV' }
  > plan 'visit', { duration 1.min }
  > EOF
  $ cat > other.fleet <<'EOF'
  > vehicle 'other', { type 'UUV' }
  > plan 'visit', { duration 2.min }
  > EOF
  $ dolphin exec visit.dol
     0:00  program     picks beside
     0:00  beside      starts visit
     1:00  beside      ends visit
     1:00  program     says: beside is back
     1:00  program     releases beside
     1:00  program     ends
  $ dolphin exec visit.dol --fleet other.fleet
     0:00  program     picks other
     0:00  other       starts visit
     2:00  other       ends visit
     2:00  program     says: other is back
     2:00  program     releases other
     2:00  program     ends
  $ dolphin exec visit.dol --sim=other.fleet | head -1
     0:00  program     picks other

The same seed gives the same log, another seed another one.

  $ cat > chance.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > plan 'visit', { duration 1.min, 1.hour }
  > EOF
  $ dolphin exec visit.dol --fleet chance.fleet --seed 1 > first.log
  $ dolphin exec visit.dol --fleet chance.fleet --seed 1 | diff first.log -
  $ dolphin exec visit.dol --fleet chance.fleet --seed 2 | diff -q first.log - > same.txt
  [1]

So it is for the mission of the paper.

  $ dolphin exec ../../examples/rendezvous.dol --seed 5 > first.log
  $ dolphin exec ../../examples/rendezvous.dol --seed 5 | diff first.log -

Time may pass as in reality, or faster.

  $ dolphin exec visit.dol > plain.log
  $ dolphin exec visit.dol --speed 600 | cut -c 10- > paced.txt
  $ cut -c 10- plain.log | diff paced.txt -

A program without a statement does nothing.

  $ : > empty.dol
  $ dolphin exec empty.dol
     0:00  program     ends
  $ echo '// nothing but a comment' > comment.dolphin
  $ dolphin exec comment.dolphin
     0:00  program     ends

A program that halts says so.

  $ echo "halt 'no wind'" > halt.dol
  $ dolphin exec halt.dol
     0:00  program     halts: no wind
  [1]

Neither messages nor names can command the terminal.

  $ printf 'message "red \\u001b[31m and two\\nlines"\n' > escape.dol
  $ dolphin exec escape.dol
     0:00  program     says: red ?[31m and two
                       lines
     0:00  program     ends

Warnings are told, and do not hinder.

  $ echo "imcPlan('visit')" > warning.dol
  $ dolphin exec warning.dol
  warning.dol:1:1: warning: this task is made but not executed
    1 | imcPlan('visit')
      | ^^^^^^^^^^^^^^^^
      hint: write execute before it, or give it a name
     0:00  program     ends

A link that is lost and comes back is told; lost for too long it is an error.

  $ cat > link.fleet <<'EOF'
  > vehicle 'a', { type 'UUV'; drops 20.seconds, 30.seconds; drops 2.min, 1.hour }
  > plan 'visit', { duration 10.min }
  > EOF
  $ dolphin exec visit.dol --fleet link.fleet
     0:00  program     picks a
     0:00  a           starts visit
     0:20  a           loses its link
     0:50  a           has its link back
     2:00  a           loses its link
     3:00  a           fails in visit: connection lost for 60 s
     3:00  program     releases a
     3:00  program     fails: visit failed on a: connection lost for 60 s
  visit.dol:2:12: error: visit failed on a: connection lost for 60 s
    2 | execute v: imcPlan('visit')
      |            ^^^^^^^^^^^^^^^^
  [1]

What nothing can make true any more is told.

  $ cat > stuck.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute condition { consume ready: 1 } >> imcPlan('visit')
  > EOF
  $ dolphin exec stuck.dol
     0:00  program     picks noptilus-1
     0:00  program     releases noptilus-1
     0:00  program     is stuck
  stuck.dol:2:19: error: the program is stuck: nothing can make this condition true any more
    2 | execute condition { consume ready: 1 } >> imcPlan('visit')
      |                   ^^^^^^^^^^^^^^^^^^^^
  [1]
  $ cat > low.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute waitFor { battery(v) > 1 } then imcPlan('visit')
  > EOF
  $ dolphin exec low.dol
     0:00  program     picks noptilus-1
  40:00:00  program     releases noptilus-1
  40:00:00  program     is stuck
  low.dol:2:9: error: the program is stuck: nothing can make this condition true any more
    2 | execute waitFor { battery(v) > 1 } then imcPlan('visit')
      |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]

Nobody reads on: the run is interrupted, without a word.

  $ cat > chatter.dol <<'EOF'
  > while (true) { message 'still here' }
  > EOF
  $ (timeout 20 dolphin exec chatter.dol; echo "status $?" >&2) | head -2
     0:00  program     says: still here
     0:00  program     says: still here
  status 130

A pick that gives up is told of the vehicles that would have come.

  $ cat > late.fleet <<'END'
  > vehicle 'late', { type 'UUV'; joins 1.hour }
  > END
  $ dolphin exec visit.dol --fleet late.fleet
     0:10  program     fails: could not pick 1 vehicle of type 'UUV': no vehicle was heard of
  dolphin: the pick gave up at 0:10, and late joins at 1:00:00: 'timeout' lets a pick wait longer
  visit.dol:1:5: error: could not pick 1 vehicle of type 'UUV': no vehicle was heard of
    1 | v = pick { type 'UUV' }
      |     ^^^^^^^^^^^^^^^^^^^
  [1]

A battery that its vehicle never tells is unknown; a condition that compares it does not hold, which is said once.

  $ cat > silent.fleet <<'END'
  > vehicle 'silent', { type 'UUV'; battery unknown }
  > plan 'visit', { duration 1.min }
  > END
  $ cat > silent.dol <<'END'
  > v = pick { type 'UUV' }
  > execute imcPlan('visit') until { battery(v) < 0.3 || consume(abort: true) }
  > execute imcPlan('visit') assure { battery(v) > 0.3 }
  > message "${battery(v)}, taken as ${battery(v) ?: 0.5}"
  > if (battery(v) < 0.3) { message 'low' }
  > END
  $ dolphin exec silent.dol --fleet silent.fleet
     0:00  program     picks silent
     0:00  silent      starts visit
     0:00  program     silent.dol:2:9: this condition does not hold: battery(silent) is unknown, since silent has not reported it: battery(v) ?: x takes x then
     1:00  silent      ends visit
     1:00  silent      starts visit
     1:00  program     silent.dol:3:9: this condition does not hold: battery(silent) is unknown, since silent has not reported it: battery(v) ?: x takes x then
     2:00  silent      ends visit
     2:00  program     says: unknown, taken as 0.5
     2:00  program     releases silent
     2:00  program     fails: battery(silent) is unknown, since silent has not reported it: battery(v) ?: x takes x then
  silent.dol:5:5: error: battery(silent) is unknown, since silent has not reported it: battery(v) ?: x takes x then
    5 | if (battery(v) < 0.3) { message 'low' }
      |     ^^^^^^^^^^^^^^^^
  [1]
  $ dolphin explore silent.dol --fleet silent.fleet | grep -A 1 holds
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 10 steps: an unhandled error ends the program
  assertions: holds
  vehicles for all tasks: holds
  note: all code reached: violated: no run reaches message at silent.dol:5:25

The programs that ran did what the semantics allows.

  $ check-journals
