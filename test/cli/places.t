Where described plans are.

  $ cat > stay.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan {
  >     planName 'stay'
  >     skeeping duration: 1.min
  > }
  > END
  $ echo "vehicle 'a', { type 'UUV'; at 43, -8; speed 1.5 }" > far.fleet
  $ (cat far.fleet; echo "locate 43.001, -8") > near.fleet

A plan that has no place does not go anywhere: nothing moves.

  $ dolphin check stay.dol
  stay.dol:4:5: error: 'skeeping' has no place: neither plan, program nor fleet has one
    4 |     skeeping duration: 1.min
      |     ^^^^^^^^^^^^^^^^^^^^^^^^
      hint: write locate LATITUDE, LONGITUDE before it, or once for all plans at the top of the program or in its fleet
  stay.dol: 1 error
  [2]
  $ dolphin check stay.dol --fleet far.fleet > /dev/null 2>&1
  [2]
  $ dolphin exec stay.dol --fleet far.fleet 2>&1 | head -1
  stay.dol:4:5: error: 'skeeping' has no place: neither plan, program nor fleet has one
  $ dolphin explore stay.dol --fleet far.fleet > /dev/null 2>&1
  [2]
  $ dolphin time stay.dol --fleet far.fleet > /dev/null 2>&1
  [2]
  $ dolphin walk stay.dol --fleet far.fleet < /dev/null > /dev/null 2>&1
  [2]
  $ timeout 60 dolphin exec stay.dol --imc --no-socket 2>&1 | grep -v journal | head -1
  stay.dol:4:5: error: 'skeeping' has no place: neither plan, program nor fleet has one
  $ timeout 60 dolphin exec stay.dol --imc --fleet far.fleet 2>&1 | head -1
  stay.dol:4:5: error: 'skeeping' has no place: neither plan, program nor fleet has one

A fleet has a place for plans, a program for its own, a plan for itself; the nearest of them counts.

  $ place() { dolphin plan "$@" --json |
  >   python3 -c 'import json, sys; print(json.load(sys.stdin)["plans"][0]["way"]["maneuvers"][0]["points"])'; }
  $ dolphin check stay.dol --fleet near.fleet
  stay.dol: no errors
  near.fleet: no errors
  $ place stay.dol stay --fleet near.fleet
  [[43.001, -8]]
  $ (echo "parameter north = 43.002"; echo "locate north, -8"; cat stay.dol) > own.dol
  $ dolphin check own.dol --fleet far.fleet
  own.dol: no errors
  far.fleet: no errors
  $ place own.dol stay --fleet near.fleet
  [[43.002, -8]]
  $ place own.dol stay --fleet near.fleet --set north=43.0025
  [[43.0025, -8]]
  $ sed 's/skeeping/locate 43.003, -8\n&/' own.dol > inner.dol
  $ place inner.dol stay --fleet near.fleet
  [[43.003, -8]]

The fleet beside the program is the one of check and exec.

  $ cp near.fleet stay.fleet; dolphin check stay.dol
  stay.dol: no errors
  stay.fleet: no errors
  $ rm stay.fleet

Recorded runs have the place in their journal.

  $ dolphin exec stay.dol --fleet near.fleet --journal stay.run
     0:00  program     picks a
     0:00  a           starts stay
     2:14  a           ends stay
     2:14  program     releases a
     2:14  program     ends
  $ head -1 stay.run | grep -o '"place".*'
  "place":{"latitude":43.001,"longitude":-8,"height":0}}
  $ dolphin trace check stay.dol stay.run
  stay.run: a run, of 6 transitions in 2:14; completed
  $ dolphin trace check stay.dol stay.run --timed --fleet near.fleet
  stay.run: a run, of 6 transitions in 2:14; completed
  $ head -4 stay.run > cut.run; dolphin exec stay.dol --resume cut.run --fleet near.fleet | tail -1
     2:14  program     ends
  $ dolphin trace check stay.dol cut.run
  cut.run: a run, of 6 transitions in 2:14; completed

What code decides is a fault where the plan is built.

  $ cat > code.dol <<'END'
  > v = pick { type 'UUV' }
  > def go(n) { imcPlan { if (n > 1) { locate 43, -8 }; goTo() } }
  > execute v: go(2)
  > execute v: go(1)
  > END
  $ dolphin check code.dol 2>&1 | cut -c 1-99
  code.dol:2:53: warning: a run ends here: 'goTo' has no place: neither plan, program nor fleet has o
    2 | def go(n) { imcPlan { if (n > 1) { locate 43, -8 }; goTo() } }
      |                                                     ^^^^^^
      hint: found by following the program in its fleet, where no fault happens
  code.dol: no errors, 1 warning
  $ dolphin exec code.dol --fleet far.fleet
     0:00  program     picks a
     0:00  a           starts plan-2
     0:00  a           ends plan-2
     0:00  program     releases a
     0:00  program     fails: 'goTo' has no place: neither plan, program nor fleet has one; write locate LATITUDE, LONGITUDE before it, or once for all plans at the top of the program or in its fleet
  code.dol:2:53: error: 'goTo' has no place: neither plan, program nor fleet has one; write locate LATITUDE, LONGITUDE before it, or once for all plans at the top of the program or in its fleet
    2 | def go(n) { imcPlan { if (n > 1) { locate 43, -8 }; goTo() } }
      |                                                     ^^^^^^
  [1]
  $ (cat far.fleet; echo 'locate 43.001, -8') > code.fleet; dolphin exec code.dol | tail -1
     1:14  program     ends

Fences hold for plans that have their place of the fleet, with a place in the program's text.

  $ (echo 'fence outside location(43.001, -8) ^ 200'; cat stay.dol) > fenced.dol
  $ dolphin check fenced.dol --fleet near.fleet
  fenced.dol:5:5: error: plan 'stay': 1.StationKeeping breaks fence outside location(43.001, -8) ^ 200 (fenced.dol:1) by 200.0 m, at (43.001000, -8.000000)
    5 |     skeeping duration: 1.min
      |     ^^^^^^^^^^^^^^^^^^^^^^^^
  fenced.dol: 1 error
  near.fleet: no errors
  [2]

Formatting keeps the declaration.

  $ printf "locate   43.001,-8\nfence depth 12.m\n" > form.dol; dolphin fmt form.dol; cat form.dol
  form.dol
  locate 43.001, -8
  fence depth 12.m
