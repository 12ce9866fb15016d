What a program leaves to whoever starts it: parameters, which dolphin help lists and --set gives other values.

  $ cp ../../examples/parameters.dol ../../examples/parameters.fleet .
  $ dolphin help parameters.dol
  A survey in rounds, by as many vehicles as there are to spare.
  
  Parameters, which --set NAME=VALUE gives other values:
    vehicles = 2     how many vehicles survey
    rounds = 2       how often each of them does
    limit = 30.min   after which they come home, wherever they are
  $ dolphin --help parameters.dol | tail -1
    limit = 30.min   after which they come home, wherever they are
  $ dolphin exec parameters.dol -q | grep -v '^  journal'
    16:00  program     says: vehicles: 2, rounds: 2
    16:00  program     ends
  completed after 16:00
    tasks    4 done
  $ dolphin exec parameters.dol -q --set vehicles=3 --set limit=5.min | grep -v '^  journal'
     5:00  program     says: vehicles: 3, rounds: 2
     5:00  program     ends
  completed after 5:00
    tasks    3 stopped
  $ dolphin check parameters.dol --set rounds=1
  parameters.dol: no errors
  parameters.fleet: no errors

Of a wrong name or value it is told what would be right.

  $ for set in vehicle=3 n=3 vehicles=2.5 vehicles=all limit=true limit= rounds=[1] rounds=2+2; do
  >   dolphin exec parameters.dol --set $set || echo "status $?"
  > done
  dolphin: --set vehicle=3: the program has no parameter 'vehicle': did you mean 'vehicles'?
  status 2
  dolphin: --set n=3: the program has no parameter 'n', only vehicles = 2 (how many vehicles survey), rounds = 2 (how often each of them does), limit = 30.min (after which they come home, wherever they are)
  status 2
  dolphin: --set vehicles=2.5: 'vehicles' is a whole number, as in vehicles = 2 (how many vehicles survey)
  status 2
  dolphin: --set vehicles=all: 'vehicles' is a whole number, as in vehicles = 2 (how many vehicles survey)
  status 2
  dolphin: --set limit=true: 'limit' is a number, as in limit = 30.min (after which they come home, wherever they are)
  status 2
  dolphin: --set limit=: 'limit' is a number, as in limit = 30.min (after which they come home, wherever they are)
  status 2
  dolphin: --set rounds=[1]: 'rounds' is a whole number, as in rounds = 2 (how often each of them does)
  status 2
  dolphin: --set rounds=2+2: 'rounds' is a whole number, as in rounds = 2 (how often each of them does)
  status 2
  $ dolphin exec parameters.dol --set rounds=1 --set rounds=2
  dolphin: --set rounds is given twice
  [2]
  $ dolphin explore parameters.dol --set rounds 2>&1 | head -1
  dolphin: option '--set': 'rounds' is not written NAME=VALUE, as in n=5
  $ echo 'message 1' > none.dol
  $ dolphin check none.dol --set n=1
  dolphin: --set n=1: the program has no parameters
  [2]
  $ dolphin help none.dol
  It has no parameters and no inputs.
  $ dolphin help nobody
  dolphin: 'nobody' is neither a command nor a file
  [2]
  $ dolphin help exce
  dolphin: 'exce' is neither a command nor a file: did you mean 'exec'?
  [2]

A text needs no quotes; null stands for anything; a number with a unit for any number.

  $ cat > kinds.dol <<'END'
  > /* Kinds of values,
  >  * one after the other. */
  > parameter name = 'x8-01', 'of a vehicle'
  > parameter place = Location.APDL
  > parameter perhaps = null
  > parameter far = 2.5.km
  > parameter many = [1, [a: -2]]
  > input 'abort'
  > message "$name $place $perhaps $far $many"
  > execute condition { poll(abort: true) } during 1.sec
  > END
  $ dolphin help kinds.dol
  Kinds of values,
  one after the other.
  
  Parameters, which --set NAME=VALUE gives other values:
    name = 'x8-01'          of a vehicle
    place = Location.APDL
    perhaps = null
    far = 2.5.km
    many = [1, [a: -2]]
  
  Inputs, which dolphin post posts to a run:
    'abort'
  $ dolphin exec -q kinds.dol | grep -v '^  journal'
     0:00  program     says: x8-01 (41.185242, -8.704803) null 2500.0 [1, [a:-2]]
     0:01  program     ends
  completed after 0:01
    tasks    none
  $ dolphin exec -q kinds.dol --set name=x8-02 --set 'perhaps=[1]' --set far=3 --set 'place=location(41.1, -8.7)' --set 'many=[]' | grep -v '^  journal'
     0:00  program     says: x8-02 (41.100000, -8.700000) [1] 3 []
     0:01  program     ends
  completed after 0:01
    tasks    none
  $ dolphin exec -q kinds.dol --set 'name="a b"' --set perhaps=abc
  dolphin: --set perhaps=abc: a text stands in quotes: 'abc'
  [2]

Journals keep them: the run is checked, and resumed, with what it was started with.

  $ dolphin exec parameters.dol -q --set vehicles=3 --set rounds=1 --journal all.run
     8:00  program     says: vehicles: 3, rounds: 1
     8:00  program     ends
  completed after 8:00
    tasks    3 done
    journal  all.run
  $ head -1 all.run | grep -o '"set":{[^}]*}'
  "set":{"vehicles":"3","rounds":"1"}
  $ dolphin trace check parameters.dol all.run
  all.run: a run, of 11 transitions in 8:00; completed
  $ dolphin trace check parameters.dol - < all.run
  -: a run, of 11 transitions in 8:00; completed
  $ dolphin trace check parameters.dol all.run --set rounds=2
  dolphin: the recorded run has parameters of its own: leave out --set
  [2]
  $ head -c 5000 all.run > part.run
  $ dolphin exec parameters.dol -q --resume part.run
     8:00  program     says: vehicles: 3, rounds: 1
     8:00  program     ends
  completed after 8:00
    tasks    3 done
    journal  part.run
  $ dolphin trace check parameters.dol part.run
  part.run: a run, of 11 transitions in 8:00; completed
  $ cat > early.dol <<'END'
  > parameter n = 1
  > v = pick { type 'UUV' }
  > execute v: imcPlan("survey$n") during 1.min
  > assert { n < 2 }, 'n is small'
  > END
  $ dolphin explore early.dol --fleet parameters.fleet --set n=2 --trace early.course | grep assertions
  assertions: violated after 5 steps: early.dol:4:1: assertion failed: n is small
  assertions: a shortest run in which an assertion fails
  $ dolphin exec early.dol --fleet parameters.fleet --follow early.course > followed; head -3 followed
  early.dol:4:1: error: assertion failed: n is small
    4 | assert { n < 2 }, 'n is small'
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  breaks: assertions
     2  program     picks noptilus-1
     4  program     cuts a task short: its time is up

Graphs and models are of the program as it was set.

  $ dolphin lts early.dol --fleet parameters.fleet -o one.aut
  $ dolphin lts early.dol --fleet parameters.fleet --set n=2 --compare one.aut | head -1
  not bisimilar
  $ dolphin tla early.dol --fleet parameters.fleet --set n=2 -o model
  $ grep -c '"n is small"' model/MC.tla
  1
