What a supplier may reply, as the fleet says it. A run takes the first of several replies.

  $ dolphin exec ../../examples/supplier.dol | cut -c 10-
  program     calls getSupplier
  program     is told host object supplier
  program     calls supplier.active
  program     is told true
  program     calls supplier.queue
  program     is told host object queue
  program     calls queue.await
  program     is told task('photograph_pier')
  program     picks x8-02
  x8-02       starts photograph_pier
  x8-02       ends photograph_pier
  program     releases x8-02
  program     calls supplier.active
  program     is told true
  program     calls supplier.queue
  program     is told host object queue
  program     calls queue.await
  program     is told task('look_for_oil')
  program     picks x8-02
  x8-02       starts look_for_oil
  x8-02       fails in look_for_oil: plan failed
  program     says: Error: look_for_oil failed on x8-02: plan failed
  program     releases x8-02
  program     calls supplier.active
  program     is told true
  program     calls supplier.queue
  program     is told host object queue
  program     calls queue.await
  program     is told task('follow_coast')
  program     picks x8-02
  x8-02       starts follow_coast
  program     cuts a task short: its time is up
  x8-02       stops follow_coast
  program     releases x8-02
  program     calls supplier.active
  program     is told false
  program     ends
  $ dolphin exec ../../examples/supplier.dol --supplier ../../examples/supplier.py | grep -c starts
  3

The explorer takes all of them.

  $ explore() { dolphin explore "$@" > result; status=$?; sed 's/, [0-9.]* s, [0-9]* MiB//' result; return $status; }
  $ explore ../../examples/supplier.dol --strict
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  46 states, 51 transitions, depth 38; reduced by partial order, symmetry of vehicles
  $ for reduction in none por symmetry all; do explore ../../examples/supplier.dol --reduction $reduction | tail -1; done
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  86 states, 101 transitions, depth 38
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  86 states, 101 transitions, depth 38; reduced by partial order
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  46 states, 51 transitions, depth 38; reduced by symmetry of vehicles
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  46 states, 51 transitions, depth 38; reduced by partial order, symmetry of vehicles
  $ explore ../../examples/supplier.dol --compress | tail -1
  dolphin: by the fleet these join late: x8-03; here they are there from the start, unless --faults has join
  46 states, 51 transitions, depth 38; reduced by partial order, symmetry of vehicles
  $ dolphin lts ../../examples/supplier.dol | head -12
  des (0, 101, 86)
  (0,"call(getSupplier)",1)
  (1,"reply(host object supplier)",2)
  (2,"call(supplier.active)",3)
  (3,"reply(true)",4)
  (4,"call(supplier.queue)",5)
  (5,"reply(host object queue)",6)
  (6,"call(queue.await)",7)
  (7,"reply(task('photograph_pier'))",8)
  (8,"pick(1 vehicle of type 'UAV')",9)
  (9,"bind(x8-02)",10)
  (9,"bind(x8-03)",11)

A call for which the fleet has no reply.

  $ cat > mission.dol <<'END'
  > supplier = getSupplier()
  > v = pick { type 'UUV' }
  > while (supplier.active()) {
  >   work = supplier.queue.await(v, 20.minutes)
  >   message work
  >   execute v: work
  > }
  > END
  $ cat > mission.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > reply 'getSupplier', object('supplier')
  > reply 'supplier.active', true, either(true, false), false
  > reply 'supplier.queue', object('queue')
  > END
  $ explore mission.dol
  no deadlock: holds
  termination: holds
  no unhandled error: violated after 10 steps: an unhandled error ends the program
  assertions: holds
  vehicles for all tasks: holds
  note: all code reached: violated: no run reaches message at mission.dol:5:3, execute at mission.dol:6:3
  11 states, 10 transitions, depth 10; reduced by partial order
  
  no unhandled error: a shortest run in which an unhandled error ends the program
       program                                   where          variables
   1   call(getSupplier)                         mission.dol:1
   2   reply(host object supplier)               mission.dol:1
   3   pick(1 vehicle of type 'UUV')             mission.dol:2  supplier = host object supplier
   4   picks noptilus-1                          mission.dol:2
   5   call(supplier.active)                     mission.dol:3  v = noptilus-1
   6   reply(true)                               mission.dol:3
   7   call(supplier.queue)                      mission.dol:4
   8   reply(host object queue)                  mission.dol:4
   9   call(queue.await)                         mission.dol:4
  10   no-reply(the fleet has no reply 'queue.await')  mission.dol:4
  the fleet lacks an entry: reply 'queue.await', and the supplier's possible replies
  [1]
  $ dolphin exec mission.dol
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     picks noptilus-1
     0:00  program     calls supplier.active
     0:00  program     is told true
     0:00  program     calls supplier.queue
     0:00  program     is told host object queue
     0:00  program     calls queue.await
     0:00  program     releases noptilus-1
     0:00  program     fails: queue.await: no host process to call: name one with --supplier, or give the fleet a reply 'queue.await'
  mission.dol:4:10: error: queue.await: no host process to call: name one with --supplier, or give the fleet a reply 'queue.await'
    4 |   work = supplier.queue.await(v, 20.minutes)
      |          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]

Replies that fail.

  $ cp mission.fleet short.fleet
  $ echo "reply 'queue.await', task('survey'), either(task('survey'), fails('the queue is closed'), fails, 3)" >> mission.fleet
  $ explore mission.dol --trace error.run | tail -3
  18   reply(host object queue)                      mission.dol:4
  19   call(queue.await)                             mission.dol:4
  20   no-reply(the queue is closed)                 mission.dol:4
  $ dolphin exec mission.dol --follow error.run | tail -3
  mission.dol:4:10: error: queue.await: the queue is closed
    4 |   work = supplier.queue.await(v, 20.minutes)
      |          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
    19  program     calls queue.await
    20  program     releases noptilus-1
    20  program     fails: queue.await: the queue is closed

A task fails where it was asked for.

  $ cp short.fleet mission.fleet
  $ echo "reply 'queue.await', task('survey')" >> mission.fleet
  $ explore mission.dol
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  28 states, 28 transitions, depth 25; reduced by partial order
  $ echo "plan 'survey', { mayFail }" >> mission.fleet
  $ explore mission.dol --trace failure.run | tail -2
  13                                  starts survey             mission.dol:4
  14                                  fails in survey: failure  mission.dol:4
  $ dolphin exec mission.dol --follow failure.run
  breaks: no unhandled error
     1  program     calls getSupplier
     2  program     is told host object supplier
     4  program     picks noptilus-1
     5  program     calls supplier.active
     6  program     is told true
     7  program     calls supplier.queue
     8  program     is told host object queue
     9  program     calls queue.await
    10  program     is told task('survey')
    11  program     says: task('survey')
    13  noptilus-1  starts survey
    14  noptilus-1  fails in survey: failure
    14  program     releases noptilus-1
    14  program     fails: survey failed on noptilus-1: failure
  mission.dol:4:10: error: survey failed on noptilus-1: failure
    4 |   work = supplier.queue.await(v, 20.minutes)
      |          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  [1]

A supplier that need never come to its end.

  $ sed -i "s/true, either(true, false), false/either(true, false)/" mission.fleet
  $ explore mission.dol --trace cycle.run | sed -n '/a run in which the program/,/^$/p'
  termination: a run in which the program may never end
       program                        where          variables
   1   call(getSupplier)              mission.dol:1
   2   reply(host object supplier)    mission.dol:1
   3   pick(1 vehicle of type 'UUV')  mission.dol:2  supplier = host object supplier
   4   picks noptilus-1               mission.dol:2
   5   call(supplier.active)          mission.dol:3  v = noptilus-1
   6   reply(true)                    mission.dol:3
   7   call(supplier.queue)           mission.dol:4
   8   reply(host object queue)       mission.dol:4
   9   call(queue.await)              mission.dol:4
  10   reply(task('survey'))          mission.dol:4
  11   message 'task(\'survey\')'     mission.dol:5
  and from there, again and again:
       program                     noptilus-1     where
  12   execute                                    mission.dol:6
  13                               starts survey  mission.dol:4
  14                               ends survey    mission.dol:4
  15   call(supplier.active)                      mission.dol:3
  16   reply(true)                                mission.dol:3
  17   call(supplier.queue)                       mission.dol:4
  18   reply(host object queue)                   mission.dol:4
  19   call(queue.await)                          mission.dol:4
  20   reply(task('survey'))                      mission.dol:4
  21   message 'task(\'survey\')'                 mission.dol:5
  
  $ dolphin exec mission.dol --follow cycle.run | sed -n '/again/,$p'
  and from there, again and again:
    13  noptilus-1  starts survey
    14  noptilus-1  ends survey
    15  program     calls supplier.active
    16  program     is told true
    17  program     calls supplier.queue
    18  program     is told host object queue
    19  program     calls queue.await
    20  program     is told task('survey')
    21  program     says: task('survey')
  $ explore mission.dol --ltl 'F ended' --invariant '!running("survey")' | grep '^[fi].*: violated'
  invariant !running("survey"): violated after 13 steps: it does not hold
  formula F ended: violated: after 11 steps, 10 steps that can repeat without end

A journal of such a run checks, and is resumed wherever it breaks off: the fleet continues with its replies.

  $ cp ../../examples/supplier.dol ../../examples/supplier.fleet .
  $ dolphin exec supplier.dol --journal whole.run > whole.log
  $ dolphin trace check supplier.dol whole.run
  whole.run: a run, of 41 transitions in 13:10; completed
  $ lines=$(wc -l < whole.run)
  $ for n in $(seq 2 $((lines - 1))); do
  >   head -n $n whole.run > part.run
  >   dolphin exec supplier.dol --resume part.run > part.log || echo "line $n: status $?"
  >   dolphin trace check supplier.dol part.run > checked || cat checked
  >   for run in part whole; do grep '"event"\|"transition"' $run.run > $run.steps; done
  >   diff part.steps whole.steps > /dev/null || echo "line $n: another run"
  > done

What a supplier has replied the fleet does not go on with, unless it would have replied the same.

  $ cp supplier.dol real.dol
  $ sed "s/^reply 'supplier.active'.*/reply 'supplier.active', false/" supplier.fleet > real.fleet
  $ dolphin exec real.dol --supplier ../../examples/supplier.py --journal real.run | grep starts
     0:00  x8-02       starts photograph_pier
     2:00  x8-02       starts look_for_oil
     3:10  x8-02       starts follow_coast
  $ head -n 7 real.run > part.run
  $ dolphin exec real.dol --resume part.run
  dolphin: part.run: this run has a supplier, which died with its console: name it again with --supplier
  [2]
  $ dolphin exec real.dol --resume part.run --supplier ../../examples/supplier.py | tail -1
  dolphin: the supplier is started again: 2 calls that it has answered in this run are not made again
    13:10  program     ends
  $ head -n 4 real.run > part.run
  $ dolphin exec real.dol --resume part.run | tail -1
     0:00  program     ends

What is wrong with a reply is told with its place.

  $ cat > mission.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > reply 'supplier.active', ether(true, false)
  > reply 'queue.await', task(survey)
  > reply 'queue.await'
  > END
  $ dolphin check mission.dol
  mission.fleet:2:26: error: this is nothing that a supplier can reply
    2 | reply 'supplier.active', ether(true, false)
      |                          ^^^^^^^^^^^^^^^^^^
      hint: did you mean either?
  mission.fleet:3:27: error: a name in quotes is expected here
    3 | reply 'queue.await', task(survey)
      |                           ^^^^^^
  mission.fleet:4:1: error: reply takes a call of the supplier and a value, as in reply 'queue.await', task('survey1')
    4 | reply 'queue.await'
      | ^^^^^
  mission.fleet: 3 errors
  mission.dol: no errors
  [2]

  $ check-journals
