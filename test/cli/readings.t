What vehicles measure, in a run, its journal, and the explorer.

  $ cp ../../examples/front.* .
  $ dolphin exec front.dol --journal run.jsonl | sed 's/^ *//'
  0:00  program     picks lauv-1
  0:00  lauv-1      starts transect
  7:14  program     sees that the condition of until holds
  7:14  lauv-1      stops transect
  7:14  program     says: a front: 14.0 degrees at 1.5 m/s
  7:14  lauv-1      starts spiral
  27:14  lauv-1      ends spiral
  27:14  lauv-1      starts home
  37:14  lauv-1      ends home
  37:14  program     releases lauv-1
  37:14  program     ends
  $ grep -c '"readings":{"Temperature":1[0-9.]*}' run.jsonl > /dev/null && dolphin trace check front.dol run.jsonl
  run.jsonl: a run, of 13 transitions in 37:14; completed

What was read is in the journal: with another value the run is another.

  $ sed 's/"Temperature":1[0-9.]*/"Temperature":19/' run.jsonl > warm.jsonl
  $ dolphin trace check front.dol warm.jsonl
  warm.jsonl: line 94 does not belong to a run: transition 4, at 5:1: cut
    nothing could happen by itself, so cut could not
    false then: until at 5:14
    enabled then: nothing
    awaited then: the end of lauv-1's task
    before it: 4 transitions of a run
  [1]

A run that was killed is resumed.

  $ grep -n '"label":"cut' run.jsonl | head -1 | cut -d: -f1 > cut
  $ head -n $(cat cut) run.jsonl > killed.jsonl
  $ dolphin exec front.dol --resume killed.jsonl | sed 's/^ *//'
  7:14  program     says: a front: 14.0 degrees at 1.5 m/s
  7:14  lauv-1      starts spiral
  27:14  lauv-1      ends spiral
  27:14  lauv-1      starts home
  37:14  lauv-1      ends home
  37:14  program     releases lauv-1
  37:14  program     ends

With values in the fleet, any expression may depend on them.

  $ cat > sorted.dol <<'END'
  > auv = pick { type 'UUV' }
  > execute auv: task("go${reading(auv, 'Temperature')}")
  > END
  $ dolphin explore sorted.dol --fleet front.fleet | head -3
  no deadlock: inconclusive, sorted.dol:2:14: the value of goreading(lauv-1,'Temperature') is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  termination: inconclusive, sorted.dol:2:14: the value of goreading(lauv-1,'Temperature') is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  no unhandled error: inconclusive, sorted.dol:2:14: the value of goreading(lauv-1,'Temperature') is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  $ sed "s/shows 'Temperature'/shows 'Temperature', 12, 18/" front.fleet > two.fleet
  $ dolphin explore sorted.dol --fleet two.fleet | grep deadlock
  no deadlock: holds
  $ dolphin tla sorted.dol --fleet two.fleet -o model && grep -c "reading(lauv-1,'Temperature')" model/MC.tla
  1

A name that is computed has no translation, nor a quantity that is unknown.

  $ cat > computed.dol <<'END'
  > auv = pick { type 'UUV' }
  > quantity = 'Depth'
  > message reading(auv, quantity)
  > message reading(auv, 'Depth')
  > END
  $ dolphin exec computed.dol --fleet two.fleet | grep says
     0:00  program     says: unknown
     0:00  program     says: unknown
  $ dolphin tla computed.dol --fleet two.fleet -o model2
  computed.dol:3:9: error: cannot be translated to TLA+: a reading whose name is not a text of the program
    3 | message reading(auv, quantity)
      |         ^^^^^^^^^^^^^^^^^^^^^^
      hint: write the name where it is read, as in reading(v, 'Temperature')
  computed.dol:4:9: error: cannot be translated to TLA+: the reading Depth of lauv-1 is unknown in this fleet: the models have no unknown values
    4 | message reading(auv, 'Depth')
      |         ^^^^^^^^^^^^^^^^^^^^^
  [2]

Links are there or not.

  $ printf "v = pick { type 'UUV' }\nassert { connected(v) }, 'no link'\n" > link.dol
  $ dolphin explore link.dol --fleet two.fleet | grep '^assertions: viol'
  assertions: violated after 3 steps: link.dol:2:1: assertion failed: no link
  $ printf "v = pick { type 'UUV' }\nmessage reading('x', 3)\nmessage reading(v)\n" > wrong.dol
  $ dolphin check wrong.dol
  wrong.dol:2:17: error: reading takes a vehicle set, this is a string
    2 | message reading('x', 3)
      |                 ^^^
  wrong.dol:2:22: error: reading takes a string, this is a number
    2 | message reading('x', 3)
      |                      ^
  wrong.dol:3:9: error: reading takes 2 arguments, not 1
    3 | message reading(v)
      |         ^^^^^^^^^^
  wrong.dol: 3 errors
  [2]

Who is near another vehicle: either outcome for each, at each look.

  $ cat > near.dol <<'END'
  > include 'prelude'
  > vs = pick { type 'UUV'; count 2 }
  > execute waitFor { near(vs[0], vs, 500.m) == vs[1] } then task('t')
  > assert { near(vs[0], vs, 500.m) == vs[1] }
  > END
  $ cat > near.fleet <<'END'
  > vehicle 'a', { type 'UUV'; at 41.185, -8.706 }
  > vehicle 'b', { type 'UUV'; at 41.186, -8.706 }
  > plan 't', { duration 30 }
  > END
  $ dolphin exec near.dol | tail -1
     0:30  program     ends
  $ dolphin explore near.dol | grep 'assertions: viol\| if '
  assertions: violated after 7 steps: near.dol:4:1: assertion failed
      if position(a).distance(position(b)) > 500 is false
      if position(a).distance(position(b)) > 500 is true
