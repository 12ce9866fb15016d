A console that dies, and another one that goes on, on the simulated fleet.

The console ends while it writes its journal, at a limit on file sizes.

  $ die_at() { prlimit --fsize=$1 --core=0 dolphin exec ../../examples/rendezvous.dol --journal $2 > $3 2> /dev/null; }
  $ dolphin exec ../../examples/rendezvous.dol --journal whole.run > whole.log

It died at six points, mostly within a line: what the two consoles tell together is what one would have told.

  $ for bytes in 1900 2500 10001 20002 60000 195000; do
  >   rm -f died.run; (die_at $bytes died.run first.log) 2> /dev/null
  >   dolphin exec --resume died.run ../../examples/rendezvous.dol > second.log
  >   cat first.log second.log | diff - whole.log && dolphin trace check ../../examples/rendezvous.dol died.run
  > done
  died.run: a run, of 35 transitions in 18:44; completed
  died.run: a run, of 35 transitions in 18:44; completed
  died.run: a run, of 35 transitions in 18:44; completed
  died.run: a run, of 35 transitions in 18:44; completed
  died.run: a run, of 35 transitions in 18:44; completed
  died.run: a run, of 35 transitions in 18:44; completed
  $ dolphin trace show died.run | grep -c 'is resumed'
  1

It may die again, and the journal may go on in another file; a picture shows the whole run.

  $ rm died.run; (die_at 9000 died.run first.log) 2> /dev/null; cp died.run copy.run
  $ (prlimit --fsize=30000 --core=0 dolphin exec --resume died.run ../../examples/rendezvous.dol > second.log; true) 2> /dev/null
  $ dolphin exec --resume died.run ../../examples/rendezvous.dol --journal joined.run --draw joined.svg > third.log
  $ cat first.log second.log third.log | diff - whole.log
  $ dolphin trace check ../../examples/rendezvous.dol joined.run
  joined.run: a run, of 35 transitions in 18:44; completed
  $ grep -c 'is resumed' joined.run || dolphin trace show joined.run | grep -c 'is resumed'
  0
  2
  $ dolphin trace check ../../examples/rendezvous.dol died.run | cut -d, -f1
  died.run: the beginning of a run
  $ grep -o 'survey1' joined.svg | head -1
  survey1

A console that dies while tasks use something, and another one: each pair is given back once.

  $ dolphin exec ../../examples/corridors.dol --journal whole2.run > whole2.log
  $ died() { prlimit --fsize=$1 --core=0 dolphin exec ../../examples/corridors.dol --journal used.run > first.log 2> /dev/null; }
  $ for share in 15 30 40 50 60 70 80 90; do
  >   bytes=$(($(wc -c < whole2.run) * share / 100))
  >   rm -f used.run; (died $bytes) 2> /dev/null
  >   dolphin exec --resume used.run ../../examples/corridors.dol > second.log
  >   cat first.log second.log | diff - whole2.log && dolphin trace check ../../examples/corridors.dol used.run
  > done
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed
  used.run: a run, of 33 transitions in 4:00; completed

A run that is over, no run, no journal.

  $ dolphin exec --resume whole.run ../../examples/rendezvous.dol
  dolphin: whole.run: this run is over: it ended completed
  [2]
  $ dolphin exec --resume whole.run ../../examples/rendezvous.dol --quiet 2>/dev/null | head -1
  completed after 18:44
  $ sed '/"i":3,/d' copy.run > gap.run
  $ dolphin exec --resume gap.run ../../examples/rendezvous.dol 2>&1 | head -1
  dolphin: gap.run: line 9 does not belong to a run: transition 4, at 11:7: pick(1 vehicle of type 'UAV' in region (41.185000, -8.706200) ^ 2000 m)
  $ dolphin exec --resume missing.run ../../examples/rendezvous.dol
  dolphin: missing.run: No such file or directory
  [2]
  $ : > empty.run
  $ dolphin exec --resume empty.run ../../examples/rendezvous.dol
  dolphin: empty.run: line 1: the journal is empty
  [2]

A program that has changed is refused, unless what happened is the beginning of a run of the new one.

  $ cp ../../examples/rendezvous.fleet changed.fleet
  $ sed 's/Done!/All is done./' ../../examples/rendezvous.dol > changed.dol
  $ cp copy.run a.run
  $ dolphin exec --resume a.run changed.dol
  dolphin: a.run: this run was of another program, or the program has changed since; --force-prefix goes on with it if what happened so far is the beginning of a run of this one, too
  [2]
  $ dolphin exec --resume a.run changed.dol --force-prefix | tail -2 | cut -c 10-
  program     says: All is done.
  program     ends
  $ dolphin trace check changed.dol a.run
  dolphin: changed.dol is not the program of this run, or has changed since: places are not compared
  a.run: a run, of 35 transitions in 18:44; completed
  $ cp copy.run b.run
  $ sed 's/count 3/count 2/; s/type .UUV./type "USV"/' ../../examples/rendezvous.dol > changed.dol
  $ dolphin exec --resume b.run changed.dol --force-prefix 2>&1 | head -2
  dolphin: b.run: line 5 does not belong to a run: transition 2, at 5:8: pick(3 vehicles of type 'UUV' with payload DVL, Sidescan in region (41.185000, -8.706200) ^ 2000 m)
    no transition is like this one; the nearest differs: "label" should be "pick(2 vehicles of type 'USV' with payload DVL, Sidescan in region (41.185000, -8.706200) ^ 2000 m)", not "pick(3 vehicles of type 'UUV' with payload DVL, Sidescan in region (41.185000, -8.706200) ^ 2000 m)"

So is another fleet, another seed, a network; and what does not go together.

  $ cp copy.run c.run
  $ sed 's/count 3/count 3/' ../../examples/rendezvous.fleet > same.fleet
  $ echo "// another" | cat - same.fleet > other.fleet
  $ dolphin exec --resume c.run ../../examples/rendezvous.dol --fleet other.fleet
  dolphin: other.fleet: this is not the fleet that the run was on, or it has changed since
  [2]
  $ dolphin exec --resume c.run ../../examples/rendezvous.dol --seed 3
  dolphin: c.run: a run goes on with the seed that it began with: leave out --seed
  [2]
  $ dolphin exec --resume c.run ../../examples/rendezvous.dol --imc-loopback
  dolphin: c.run: this run was on a simulated fleet: leave out --imc and --platform
  [2]
  $ dolphin exec ../../examples/rendezvous.dol --force-prefix
  dolphin: --force-prefix goes with --resume
  [2]
  $ dolphin exec --resume c.run ../../examples/rendezvous.dol --fleet same.fleet | tail -1 | cut -c 10-
  program     ends

Two consoles do not write one journal.

  $ dolphin exec ../../examples/parallel.dol --speed 20 --journal d.run > d.log & console=$!
  $ until [ -s d.run ]; do sleep 0.05; done
  $ dolphin exec --resume d.run ../../examples/parallel.dol
  dolphin: d.run: another console is writing this journal
  [3]
  $ kill -9 $console; wait $console 2> /dev/null || true
  $ dolphin exec --resume d.run ../../examples/parallel.dol --speed 2000 | tail -1 | cut -c 10-
  program     ends
  $ dolphin trace check ../../examples/parallel.dol d.run | grep -o 'completed'
  completed

A question that was not answered is asked again; one that was is not, and the fleet goes on with its next answer.

  $ cat > ask.dol <<'END'
  > a = ask 'First?'
  > b = ask 'Second?'
  > message a + b
  > END
  $ dolphin exec ask.dol --answer 1 --journal ask.run < /dev/null > /dev/null 2>&1
  [1]
  $ sed '/no-answer/,$d' ask.run > died.run
  $ dolphin exec --resume died.run ask.dol --answer 20
     0:00  program     asks: Second? 20
     0:00  program     says: 21
     0:00  program     ends
  $ dolphin trace check ask.dol died.run
  died.run: a run, of 6 transitions in 0:00; completed

A supplier is started anew. What it has answered it is not asked again, which it can tell from the numbers of requests.

  $ cat > supplier.py <<'END'
  > import json, sys
  > for line in sys.stdin:
  >     request = json.loads(line)
  >     value = {"object": "numbers"} if request["call"] == "getSupplier" else request["id"]
  >     print(json.dumps({"id": request["id"], "value": value}), flush=True)
  > END
  $ cat > numbers.dol <<'END'
  > numbers = getSupplier()
  > for (i in 1..3) { message numbers.next() }
  > END
  $ dolphin exec numbers.dol --supplier 'python3 supplier.py' --journal whole.run | grep -o 'says: .*'
  says: 2
  says: 3
  says: 4
  $ awk '/"event":"reply"/ && ++n == 3 { exit } { print }' whole.run > died.run
  $ dolphin exec numbers.dol --resume died.run
  dolphin: died.run: this run has a supplier, which died with its console: name it again with --supplier
  [2]
  $ dolphin exec numbers.dol --resume died.run --supplier 'python3 supplier.py'
  dolphin: the supplier is started again: 2 calls that it has answered in this run are not made again
     0:00  program     is told 3
     0:00  program     says: 3
     0:00  program     calls numbers.next
     0:00  program     is told 4
     0:00  program     says: 4
     0:00  program     ends
  $ dolphin trace check numbers.dol died.run
  died.run: a run, of 12 transitions in 0:00; completed
