A journal is copied while its run goes on, and several processes resume it: one console commands the vehicle, the others
end with a message, and each plan is started once. The situations run at the same time, each on ports of its own.

  $ cat > one.fleet <<'EOF'
  > vehicle 'noptilus-1', { type 'UUV' }
  > plan 'first', { duration 32 }
  > plan 'second', { duration 4 }
  > plan 'third', { duration 4 }
  > EOF
  $ cat > mission.dol <<'EOF'
  > v = pick { type 'UUV'; timeout 1.min }
  > execute imcPlan('first') >> imcPlan('second') >> imcPlan('third')
  > EOF

"situation NAME PORT COMMAND" carries COMMAND out in a folder NAME, beside a vehicle that hears consoles at PORT to
PORT + 4, and prints which plans it started, and how often.

  $ await() {
  >   for i in $(seq 600); do grep -qs "$1" $2 && return; sleep 0.05; done
  >   echo "no '$1' in $2"
  > }
  $ situation() {
  >   network="--imc-loopback --imc-discovery-ports $2-$(($2 + 4))"; first=$2
  >   mkdir $1; cd $1; shift 2
  >   timeout 240 dolphin sim ../one.fleet --imc --speed 4 --announce 0.5 --contact 0.2 \
  >     --discovery-ports $first-$((first + 4)) --port $((first + 10)) --log log.jsonl > vehicles.txt & vehicles=$!
  >   await . vehicles.txt
  >   "$@"
  >   kill $vehicles; wait $vehicles || true
  >   for run in *.run; do dolphin trace check ../mission.dol $run > verdict.txt 2>&1 || cat verdict.txt; done
  >   grep '"did":"started"' log.jsonl | grep -o '"plan":"[^"]*"' | sort | uniq -c | sed 's/^ *//'
  > }
  $ begin() {
  >   (sh -c "echo \$\$ > pid.txt; exec dolphin exec ../mission.dol $network --journal $1.run \
  >     > $1.txt 2> $1.errors" || true) 2> killed.txt & console=$!
  >   await 'starts first' $1.txt
  > }
  $ dies() { kill -KILL $(cat pid.txt); wait $console; }
  $ resume() {
  >   status=0
  >   timeout 120 dolphin exec --resume $1.run ../mission.dol $network > $1.txt 2> $1.errors || status=$?
  >   echo "status $status" > $1.status
  > }
  $ report() {
  >   for name in "$@"; do cut -c 10- $name.txt | grep -E 'starts|ends|fails'; done
  >   for name in "$@"; do sed 's/ccu-dolphin-[0-9a-f]*/CONSOLE/' $name.errors; done
  >   for name in "$@"; do if [ -e $name.status ]; then cat $name.status; fi; done | sort
  > }

The console was killed; the copy is resumed so many seconds after the first journal.

  $ killed() {
  >   begin one; dies; cp one.run two.run
  >   resume one & one=$!
  >   sleep $1; resume two & two=$!
  >   wait $one; wait $two; report one two
  > }

The copy was made before the console was killed; it is resumed first.

  $ before() {
  >   begin one; cp one.run two.run; dies
  >   resume two & two=$!
  >   sleep 4; resume one & one=$!
  >   wait $one; wait $two; report two one
  > }

The first console lives.

  $ alive() { begin one; cp one.run two.run; resume two; wait $console; report one two; }

The first console sleeps, and wakes up while the copy goes on.

  $ asleep() {
  >   begin one; cp one.run two.run; kill -STOP $(cat pid.txt)
  >   resume two & two=$!
  >   sleep 6; kill -CONT $(cat pid.txt)
  >   wait $console; wait $two; report one two
  > }

The copy has come to its end; then the first journal is resumed.

  $ after() { begin one; dies; cp one.run two.run; resume two; resume one; report two one; }

  $ both() { name=$1; situation "$@" > $name.out 2>&1 & }
  $ both together 21480 killed 0; both soon 21500 killed 1; both late 21520 killed 4
  $ both before 21540 before; both alive 21560 alive; both asleep 21580 asleep; both after 21600 after
  $ wait
  $ for name in together soon late before alive asleep after; do echo "-- $name"; cat $name.out; done
  -- together
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; nothing was commanded
  status 0
  status 3
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- soon
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; nothing was commanded
  status 0
  status 3
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- late
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; nothing was commanded
  status 0
  status 3
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- before
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; nothing was commanded
  status 0
  status 3
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- alive
  noptilus-1  starts first
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; nothing was commanded
  status 3
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- asleep
  noptilus-1  starts first
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  dolphin: this run lives in CONSOLE: its journal was copied, or moved while it ran; this console commands nothing any more
  status 0
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
  -- after
  noptilus-1  ends first
  noptilus-1  starts second
  noptilus-1  ends second
  noptilus-1  starts third
  noptilus-1  ends third
  program     ends
  noptilus-1  fails in first: replaced by plan third
  program     fails: first failed on noptilus-1: replaced by plan third
  ../mission.dol:2:9: error: first failed on noptilus-1: replaced by plan third
    2 | execute imcPlan('first') >> imcPlan('second') >> imcPlan('third')
      |         ^^^^^^^^^^^^^^^^
  status 0
  status 1
  1 "plan":"first"
  1 "plan":"second"
  1 "plan":"third"
