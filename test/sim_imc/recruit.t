Vehicles of a network that are recruited, as two processes over UDP.

  $ cat > planes.fleet <<'END'
  > vehicle 'x8-01', { type 'UAV' }
  > vehicle 'x8-02', { type 'UAV'; joins 2.minutes }
  > plan 'search', { duration 60 }
  > END
  $ vehicles() {
  >   first=$1; shift
  >   dolphin sim planes.fleet --imc --speed 20 --announce 0.5 --contact 0.2 --discovery-ports $first-$((first + 4)) \
  >     --port $((first + 10)) --log log.jsonl --for 200 "$@" > vehicles.txt & vehicles=$!
  >   until [ -s vehicles.txt ]; do sleep 0.05; done
  > }
  $ starts() { grep '"did":"started"' log.jsonl | sed 's/.*"vehicle":"\([^"]*\)".*"plan":"\([^"]*\)".*"request_id":\([0-9]*\).*/\1 \2 \3/' | sort -u | cut -d' ' -f1,2; }

Nobody is there when the program asks. Who comes is recruited; as it vanishes while it is held, it is released, and its
work is given to who comes then.

  $ cat > search.dol <<'END'
  > setConnectionTimeout 5.seconds
  > execute watch recruit { type 'UAV' } then { v -> task('search') >> action { message "searched by $v" } } onError { why ->
  >     message "again: $why"
  >     retry()
  > }
  > END
  $ (status=0; timeout 100 dolphin exec search.dol --imc-loopback --imc-discovery-ports 21420-21424 --journal search.run \
  >    > run.txt 2> errors.txt || status=$?; echo $status > status.txt) & console=$!
  $ until grep -qs 'timeout to 5 s' run.txt; do sleep 0.05; done
  $ vehicles 21420 --vanish x8-01=30
  $ wait $console; cat status.txt errors.txt
  0
  $ kill $vehicles; wait $vehicles || true
  $ cut -c 10- run.txt
  program     sets the connection timeout to 5 s
  x8-01       is recruited
  x8-01       is given a task
  x8-01       starts search
  x8-01       fails in search: no word from the vehicle for 5 seconds
  program     releases x8-01
  program     says: again: search failed on x8-01: no word from the vehicle for 5 seconds
  program     goes on with a task that it made
  x8-02       is recruited
  x8-02       is given a task
  x8-02       starts search
  x8-02       ends search
  program     says: searched by x8-02
  program     releases x8-02
  program     ends
  program     x8-01: may still run plan search: it was not heard to have stopped
  $ starts
  x8-01 search
  x8-02 search
  $ dolphin trace check search.dol search.run | sed 's/ in .*;/;/'
  search.run: a run, of 15 transitions; completed

A console that dies while it has a recruited vehicle: the next one has it still, does not start its plan again, and
releases it.

  $ cat > one.dol <<'END'
  > execute recruit { type 'UAV' } then { v -> task('search') >> action { message "searched by $v" } }
  > END
  $ rm log.jsonl
  $ vehicles 21440
  $ (sh -c 'echo $$ > pid.txt; exec dolphin exec one.dol --imc-loopback --imc-discovery-ports 21440-21444 --journal one.run > first.txt 2> errors.txt' || true) \
  >   2> killed.txt & console=$!
  $ until grep -qs 'starts search' first.txt; do sleep 0.05; done
  $ kill -KILL $(cat pid.txt); wait $console
  $ timeout 100 dolphin exec --resume one.run one.dol --imc-loopback --imc-discovery-ports 21440-21444 > second.txt
  $ kill $vehicles; wait $vehicles || true
  $ cut -c 10- first.txt
  x8-01       is recruited
  x8-01       is given a task
  x8-01       starts search
  $ cut -c 10- second.txt
  x8-01       ends search
  program     says: searched by x8-01
  program     releases x8-01
  program     ends
  $ starts
  x8-01 search
  $ dolphin trace check one.dol one.run | sed 's/ in .*;/;/'
  one.run: a run, of 8 transitions; completed

The same over the platform protocol, where the fleet outlives its adapter.

  $ adapter='dolphin sim planes.fleet --platform --speed 20 --state state.json'
  $ export adapter; rm first.txt
  $ (sh -c 'echo $$ > pid.txt; exec dolphin exec one.dol --platform "$adapter" --journal two.run > first.txt 2> errors.txt' || true) \
  >   2> killed.txt & console=$!
  $ until grep -qs 'starts search' first.txt; do sleep 0.05; done
  $ kill -KILL $(cat pid.txt); wait $console
  $ timeout 100 dolphin exec --resume two.run one.dol --platform "$adapter" > second.txt
  $ cat first.txt second.txt | cut -c 10-
  x8-01       is recruited
  x8-01       is given a task
  x8-01       starts search
  x8-01       ends search
  program     says: searched by x8-01
  program     releases x8-01
  program     ends
  $ dolphin trace check one.dol two.run | sed 's/ in .*;/;/'
  two.run: a run, of 8 transitions; completed

Two of one platform each are recruited side by side.

  $ cat > two.dol <<'END'
  > execute recruit { id 'x8-01' } then { v -> task('search') } | recruit { id 'x8-02' } then { v -> task('search') }
  > END
  $ rm log.jsonl; echo "vehicle 'x8-02', { type 'UAV' }" > other.fleet; echo "plan 'search', { duration 60 }" >> other.fleet
  $ vehicles 21460
  $ timeout 100 dolphin exec two.dol --imc-loopback --imc-discovery-ports 21460-21464 --journal three.run \
  >   --platform 'dolphin sim other.fleet --platform --speed 20' > run.txt 2> errors.txt
  $ kill $vehicles; wait $vehicles || true
  $ grep -c 'ends search' run.txt
  2
  $ starts
  x8-01 search
  $ dolphin trace check two.dol three.run | sed 's/ in .*;/;/'
  three.run: a run, of 12 transitions; completed
