What can still happen in a run is explored from where its journal ends.

  $ cat > ride.dol << 'END'
  > side = ask('Which side?')
  > v = pick { type 'UUV' }
  > execute task('out')[v]
  > if (side == 'port') {
  >     execute waitFor { poll clear: true } then task('home')[v]
  > } else {
  >     execute task('home')[v]
  > }
  > END
  $ cat > ride.fleet << 'END'
  > vehicle 'a', { type 'UUV'; drops 5.min, 30.seconds }
  > plan 'out', { duration 10.min }
  > plan 'home', { duration 5.min }
  > answer 'Which side?', ["port", "starboard"]
  > END

At the beginning, one of the answers may lead to a wait that never ends. After the other one it is not possible any more.

  $ dolphin explore ride.dol --answer '"port"' --answer '"starboard"' 2> /dev/null | grep 'deadlock: v'
  no deadlock: violated after 8 steps: nothing can happen any more, and the program has not ended
  $ dolphin exec ride.dol --answer '"starboard"' --journal whole.run > /dev/null
  $ upto() { sed "/$1/q" whole.run > $2.run; }
  $ upto '"label":"start(a, out)"' out
  $ dolphin explore ride.dol --from ./out.run | sed 's/, [^,]*s, .*MiB//'
  dolphin: by the fleet these leave, or lose their links: a; here they stay, unless --faults has loss
  from 0:00 of ./out.run, after 6 transitions
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  6 states; reduced by partial order
  $ dolphin explore ride.dol --from ./out.run --json | grep -o '"from":{[^}]*}'
  dolphin: by the fleet these leave, or lose their links: a; here they stay, unless --faults has loss
  "from":{"journal":"./out.run","time":0.0,"transitions":6}

A vehicle that is out of contact then may stay away.

  $ upto '"connected":false' gone
  $ dolphin explore ride.dol --from ./gone.run 2> error | grep -v -e states -e tuples; cat error
  from 5:00 of ./gone.run, after 6 transitions
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 1 step, without a fault: an unhandled error ends the program
  assertions: holds
  vehicles for all tasks: holds
  
  no unhandled error: a shortest run without a fault in which an unhandled error ends the program
      program  a                              where  variables
  1            fails in out: connection lost         side = 'starboard', v = a
  dolphin: a is out of contact: its tasks may fail, and a pick may miss it
  dolphin: by the fleet these leave, or lose their links: a; here they stay, unless --faults has loss

The program may have changed, if the run so far is the beginning of a run of it. So a change is checked before the run is
resumed with it.

  $ sed "s/task('home').v.$/& >> action { assert({ side == 'port' }, 'the port side') }/" ride.dol > changed.dol; tail -n 2 changed.dol
      execute task('home')[v] >> action { assert({ side == 'port' }, 'the port side') }
  }
  $ dolphin explore changed.dol --from ./out.run 2>&1 | head -n 7
  dolphin: changed.dol: this program is not the one that the run began with; the run so far is the beginning of a run of this one, too
  dolphin: by the fleet these leave, or lose their links: a; here they stay, unless --faults has loss
  from 0:00 of ./out.run, after 6 transitions
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: violated after 5 steps: changed.dol:7:41: assertion failed: the port side
  $ sed "s/task('out')/task('away')/" ride.dol > another.dol
  $ dolphin explore another.dol --from ./out.run
  dolphin: ./out.run: line 9 does not belong to a run: transition 5, at 3:9: start(a, out)
    no transition is like this one; the nearest differs: "label" should be "start(a, away)", not "start(a, out)"
    enabled then: start(a, away)
    awaited then: nothing
    before it: 5 transitions of a run
  [2]

Inputs and questions that came before are counted: of three that the fleet may post, two are still to come.

  $ cat > count.dol << 'END'
  > input 'more'
  > n = 0
  > while (n < 3) {
  >     execute waitFor { consume more: true } then idle(0)
  >     n = n + 1
  > }
  > END
  $ echo "input 'more', true, times 3, after 1.min" > count.fleet
  $ dolphin explore count.dol --ltl 'F ended' | grep -e deadlock -e formula -e states | sed 's/, [^,]*s, .*MiB//'
  no deadlock: holds
  formula F ended: holds
  26 states; reduced by partial order; 25 states for formulas
  $ dolphin exec count.dol --journal whole.run > /dev/null
  $ upto '"label":"input more' posted
  $ dolphin explore count.dol --from ./posted.run --ltl 'F ended' | grep -e deadlock -e formula -e states | sed 's/, [^,]*s, .*MiB//'
  no deadlock: holds
  formula F ended: holds
  17 states; reduced by partial order; 20 states for formulas

A run is named as for the other commands. A run that is over has nothing left; the other errors are plain.

  $ mkdir -p state/dolphin/runs; cp out.run state/dolphin/runs/ride-1.run
  $ XDG_STATE_HOME=$PWD/state dolphin explore ride.dol --from ride 2> /dev/null | head -n 1 | sed "s#$PWD##"
  from 0:00 of /state/dolphin/runs/ride-1.run, after 6 transitions
  $ dolphin explore count.dol --from ./whole.run
  dolphin: ./whole.run: this run is over: it ended completed
  [2]
  $ sed '$d' whole.run > unsigned.run; dolphin explore count.dol --from ./unsigned.run
  dolphin: ./unsigned.run: this run is over
  [2]
  $ dolphin explore ride.dol --from ./none.run
  dolphin: ./none.run: No such file or directory
  [2]
  $ dolphin explore ride.dol --from ./ride.dol
  dolphin: ./ride.dol: line 1: this is not a journal: its first line is not the header of one
  [2]
  $ dolphin explore ride.dol --from ./out.run --trace t.run
  dolphin: --trace, --draw, --certify and --cache are for runs from the beginning: leave them out with --from
  [2]
  $ dolphin explore ride.dol --from ./out.run --cache
  dolphin: --trace, --draw, --certify and --cache are for runs from the beginning: leave them out with --from
  [2]

It is known when the run will be over, in times since its start: tasks and timers have gone on since they began.

  $ cat > pair.dol << 'END'
  > v = pick { type 'UUV' }
  > execute task('out')[v]
  > pause(2.min)
  > execute task('home')[v]
  > END
  $ cat > pair.fleet << 'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'out', { duration 6.min, 10.min }
  > plan 'home', { duration 5.min }
  > END
  $ dolphin time pair.dol | head -n 1
  completed: 13:00 at the earliest, 17:00 at the latest
  $ rm whole.run; dolphin exec pair.dol --journal whole.run | grep out
     0:00  a           starts out
     9:25  a           ends out
  $ upto '"time":450,' later; dolphin time pair.dol --from ./later.run | grep -v states
  from 7:30 of ./later.run, after 4 transitions
  completed: 14:30 at the earliest, 17:00 at the latest
  task  vehicle  starts         ends            where
  out   a                       7:30 to 10:00   pair.dol:2
  home  a        9:30 to 12:00  14:30 to 17:00  pair.dol:4
  
  a run that ends last:
          program     a            where       variables
  10:00               ends out                 v = a
  10:00   pause(120)               pair.dol:3
  12:00   resume                   pair.dol:3
  12:00   execute                  pair.dol:4
  12:00               starts home  pair.dol:4
  17:00               ends home    pair.dol:4
  17:00   end
  its end depends on: pair.dol:2:9: out on a (2:30), then pair.dol:3:1: a timer of the program (2:00), then pair.dol:4:9: home on a (5:00)
  $ upto '"label":"pause' paused; dolphin time pair.dol --from ./paused.run --deadline 16.min | head -n 3
  from 9:25 of ./paused.run, after 6 transitions
  completed: 16:25.445 at the earliest, 16:25.445 at the latest
  deadline 16:00: violated
  $ dolphin time pair.dol --from ./later.run --deadline 14.min --json | grep -o '"from":{[^}]*}\|"inTime":"[a-z]*"'
  "inTime":"violated"
  "from":{"journal":"./later.run","time":450.0,"transitions":4}

The last line may be an event whose transition was not written: it has happened, at its time.

  $ upto '"event":"done"' done; tail -n 1 done.run | cut -c 1-40; dolphin time pair.dol --from ./done.run | head -n 2
  {"kind":"event","time":565.4453094291505
  from 9:25 of ./done.run, after 4 transitions
  completed: 16:25.445 at the earliest, 16:25.445 at the latest

A task that should be over already may take any time.

  $ sed 's/6.min, 10.min/6.min, 7.min/' pair.fleet > short.fleet
  $ dolphin time pair.dol --fleet short.fleet --from ./later.run 2>&1 | head -n 4
  dolphin: the fleet is not the one that the run began with, or it has changed since
  from 7:30 of ./later.run, after 4 transitions
  completed: 14:30 at the earliest, no latest time
  duration unknown: pair.dol:2:9: out on a; in the fleet: plan 'out', { duration 3.min, 9.min }
  $ dolphin time pair.dol --from ./later.run --slack
  dolphin: --slack, --fewest, --trace and --draw are for runs from the beginning: leave them out with --from
  [2]

Of runs of the examples, cut off at drawn lines, the answers hold.

  $ python3 from.py ../../examples

  $ dolphin trace check pair.dol whole.run; dolphin trace check ride.dol gone.run
  whole.run: a run, of 11 transitions in 16:25; completed
  gone.run: the beginning of a run, of 6 transitions in 5:00; it breaks off
