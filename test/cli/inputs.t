What one wrong line in a program with inputs costs, as dolphin explore finds it.

The operator's abort. If the fetching stands beside the until, it waits for a survey that was cut short:

  $ cp ../../examples/abort.* ../../examples/targets.* .
  $ dolphin explore abort.dol --faults fail=1,loss=1 | grep -v note | sed 's/, [0-9.]* s,.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  3308 states, 8069 transitions, depth 34
  $ sed -e 's/ | fetching$//' -e 's/^execute until.*/execute (until { poll abort: true } run mission) | fetching/' \
  >   abort.dol > wrong.dol
  $ dolphin explore wrong.dol --fleet abort.fleet | head -1
  no deadlock: violated after 7 steps: nothing can happen any more, and the program has not ended

Targets. If the loop does not look whether it is to stop, it waits for a target that never comes:

  $ dolphin explore targets.dol | grep -v note | sed 's/, [0-9.]* s,.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  165 states, 267 transitions, depth 19
  $ sed "s/ || poll(stop: true) }/ }/" targets.dol > deaf.dol
  $ dolphin explore deaf.dol --fleet targets.fleet | head -1
  no deadlock: violated after 18 steps: nothing can happen any more, and the program has not ended

Commands for single vehicles: a held vehicle goes on where it was, one that aborts comes home.

  $ cp ../../examples/commanded.* .
  $ dolphin exec commanded.dol | grep -E 'gets|starts|stops|ends '
     0:00  noptilus-1  starts lane0
     0:00  noptilus-2  starts lane1
     2:00  program     gets hold:noptilus-1
     2:00  noptilus-1  stops lane0
     4:00  program     gets abort:noptilus-2
     4:00  noptilus-2  stops lane1
     4:00  noptilus-2  starts home
     5:00  program     gets goOn:noptilus-1
     5:00  noptilus-1  starts lane0
     6:00  noptilus-2  ends home
    12:17  noptilus-1  ends lane0
  $ dolphin explore commanded.dol | grep -v note | sed 's/, [0-9.]* s,.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  2700 states, 8472 transitions, depth 31
  $ dolphin help commanded.dol | tail -n 4
  Inputs, which dolphin post posts to a run:
    'hold', of a vehicle
    'goOn', of a vehicle
    'abort', of a vehicle
  $ sed "s/'vehicle'/'boat'/" commanded.dol > boat.dol
  $ dolphin check boat.dol --fleet commanded.fleet
  boat.dol:3:36: error: values of an input are any, or vehicles
    3 | input 'hold', 'goOn', 'abort', of: 'boat'
      |                                    ^^^^^^
      hint: write input 'hold', of: 'vehicle'
  boat.dol: 1 error
  commanded.fleet: no errors
  [2]

  $ sed "s/'hold', vehicles('noptilus-1')/'hold', true/" commanded.fleet > unfit.fleet
  $ for command in exec explore check time; do dolphin $command commanded.dol --fleet unfit.fleet; done
  dolphin: unfit.fleet: input 'hold' takes a vehicle, as in input 'hold', vehicles('x8-02')
  dolphin: unfit.fleet: input 'hold' takes a vehicle, as in input 'hold', vehicles('x8-02')
  dolphin: unfit.fleet: input 'hold' takes a vehicle, as in input 'hold', vehicles('x8-02')
  unfit.fleet: no errors
  dolphin: unfit.fleet: input 'hold' takes a vehicle, as in input 'hold', vehicles('x8-02')
  [2]

An input that nobody need post is not waited for:

  $ sed "s/, after 20.min//" targets.fleet > perhaps.fleet
  $ dolphin explore targets.dol --fleet perhaps.fleet | head -1
  no deadlock: violated after 17 steps: nothing can happen any more, and the program has not ended

The simulator posts what the fleet gives a time:

  $ dolphin exec targets.dol | grep gets
     1:00  program     gets found:'mine'
     2:00  program     gets found:'wreck'
    20:00  program     gets stop:true

A program that declares an input is stuck only when none comes any more:

  $ cat > waits.dol << 'END'
  > input 'go'
  > execute condition { consume go: 1 }
  > message 'went'
  > END
  $ echo "input 'go', 2, 1, after 3.min" > waits.fleet
  $ dolphin exec waits.dol
     3:00  program     gets go:2
     6:00  program     gets go:1
     6:00  program     consumes go:1
     6:00  program     says: went
     6:00  program     ends
  $ echo "input 'go', 2, 3, after 3.min" > waits.fleet
  $ dolphin exec waits.dol
     3:00  program     gets go:2
     6:00  program     gets go:3
     6:00  program     is stuck
  waits.dol:2:19: error: the program is stuck: nothing can make this condition true any more
    2 | execute condition { consume go: 1 }
      |                   ^^^^^^^^^^^^^^^^^
  [1]

Journals have inputs, and are checked and resumed with them:

  $ dolphin exec abort.dol --journal abort.run > log
  $ grep '"input"' abort.run
  {"kind":"event","time":300,"event":"input","key":"abort","value":true}
  $ dolphin trace check abort.dol abort.run
  abort.run: a run, of 26 transitions in 7:00; completed

The console died when the journal had the input, and nothing had come of it:

  $ sed '/"input"/q' abort.run > cut.run
  $ dolphin exec abort.dol --resume cut.run > resumed.log
  $ head -2 resumed.log
     5:00  program     gets abort:true
     5:00  program     sees that the condition of until holds
  $ dolphin trace check abort.dol cut.run
  cut.run: a run, of 26 transitions in 7:00; completed
  $ grep -c '"input"' cut.run
  1

It died before, and after it:

  $ sed '/"input"/,$d' abort.run > cut.run
  $ dolphin exec abort.dol --resume cut.run | grep gets
     5:00  program     gets abort:true
  $ sed '/starts home/q; /"start(noptilus-1, home)"/q' abort.run > cut.run
  $ dolphin exec abort.dol --resume cut.run | grep -c gets
  0
  [1]

Of what was observed elsewhere, inputs are labels:

  $ cat > seen.run << 'END'
  > {"format":"dolphin-journal","version":1,"observed":["input"]}
  > {"kind":"label","label":"input go:2"}
  > {"kind":"label","label":"input go:1"}
  > END
  $ dolphin trace check waits.dol seen.run --fleet waits.fleet
  seen.run: a possible run: 2 lines
  $ sed 's/go:1/no:1/' seen.run > unseen.run
  $ dolphin trace check waits.dol unseen.run --fleet waits.fleet
  unseen.run: line 3 does not fit any run: input no:1
    input no:1 could not happen
    possible here: nothing
    before it: 1 line
  [1]
  $ check-journals

An input that is certain may come after the end, which is too late:

  $ cat > owed.dol << 'END'
  > input 'abort'
  > v = pick { type 'UUV' }
  > execute until { poll abort: true } run task('survey')
  > END
  $ cat > owed.fleet << 'END'
  > vehicle 'u1', { type 'UUV' }
  > plan 'survey', { duration 1.min, 2.min }
  > input 'abort', true, after 5.min
  > END
  $ dolphin explore owed.dol --ltl 'F input(abort)' --ltl 'F ended' | grep '^formula.*: [hv]'
  formula F input(abort): violated after 6 steps: it does not hold
  formula F ended: holds
  $ dolphin exec owed.dol | grep -c 'gets abort'
  0
  [1]

An input that comes after the program has looked, or is polled and not taken, is not a leftover tuple; a pair of the
program is.

  $ cat > home.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > plan 'survey', { duration 9.min }
  > plan 'home', { duration 2.min }
  > input 'abort', true, after 5.min
  > END
  $ cat > home.dol <<'END'
  > input 'abort'
  > v = pick { type 'UUV' }
  > execute until { poll abort: true } run task('survey')
  > if (poll(abort: true)) {
  >     message 'Home!'
  >     execute task('home')
  > }
  > END
  $ dolphin explore home.dol --strict | sed 's/, [0-9.]* s,.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  18 states, 24 transitions, depth 10
  $ (cat home.dol; echo "post found: 1") > left.dol
  $ dolphin explore left.dol --fleet home.fleet --strict | sed -n 's/ after.*//; /leftover/p'
  no leftover tuples: violated
  no leftover tuples: a shortest run in which tuples are left when the program completes
