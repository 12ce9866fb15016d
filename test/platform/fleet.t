A run on vehicles of an adapter, with a fleet for its fences, goes on with this fleet.

  $ cat > vehicles.fleet << 'END'
  > vehicle 'uav-1', { type 'UAV'; at 41.1850, -8.7060 }
  > plan 'a', { duration 60.seconds }
  > END
  $ echo "fence inside location(41.1850, -8.7060) ^ 5.km" > near.fleet
  $ echo "fence inside location(41.1850, -8.7060) ^ 6.km" > far.fleet
  $ echo "v = pick { type 'UAV' }; execute v: imcPlan('a') >> imcPlan('a')" > m.dol
  $ adapter() { echo "dolphin sim vehicles.fleet --platform --speed 20 --state $1.state"; }
  $ killed() {  # NAME [OPTION...]: a run of m.dol that is killed once a plan was started
  >   dolphin exec m.dol --journal $1.run --platform "$(adapter $1)" $2 $3 > log & run=$!
  >   until grep -qs 'start(' $1.run || ! kill -0 $run; do sleep 0.05; done; kill -KILL $run; wait $run
  > }
  $ killed fenced --fleet near.fleet 2> wait.txt
  [137]
  $ resumed() { dolphin exec m.dol --resume $1.run --platform "$(adapter $1)" $2 $3; }
  $ resumed fenced --fleet far.fleet
  dolphin: far.fleet: this is not the fleet that the run was on, or it has changed since
  [2]
  $ mv near.fleet kept.fleet
  $ resumed fenced
  dolphin: near.fleet: No such file or directory
  [2]
  $ cp far.fleet near.fleet
  $ resumed fenced
  dolphin: near.fleet: this is not the fleet that the run was on, or it has changed since
  [2]
  $ mv kept.fleet near.fleet
  $ resumed fenced | tail -2 | cut -c 10-
  program     releases uav-1
  program     ends

A run that began without fences is not resumed with some.

  $ killed free 2> wait.txt
  [137]
  $ resumed free --fleet near.fleet
  dolphin: near.fleet: a run goes on with the fences that it began with, and it had no fleet
  [2]
  $ resumed free | tail -1 | cut -c 10-
  program     ends

The programs that ran did what the semantics allows.

  $ for run in fenced free; do dolphin trace check m.dol $run.run | sed "s/, of [^;]*//"; done
  fenced.run: a run; completed
  free.run: a run; completed

A simulated fleet that was killed in the middle of a line goes on from the line before. A state that cannot be written is
named.

  $ dolphin sim vehicles.fleet --platform --state torn.state < /dev/null
  $ cp torn.state whole.state; printf '{"time":1,"ord' >> torn.state
  $ dolphin sim vehicles.fleet --platform --state torn.state < /dev/null; cmp torn.state whole.state
  $ dolphin sim vehicles.fleet --platform --state /dev/full < /dev/null
  {"kind":"error","why":"/dev/full: this is not the state of a simulated fleet: it is not a file"}
  dolphin: /dev/full: this is not the state of a simulated fleet: it is not a file
  [2]

An order that is refused is quoted without characters that command the terminal.

  $ echo '{"kind": "hello", "protocol": 1, "dolphin": "1", "purpose": "\u009b31m", "program": "m.dol", "resumes": false}' |
  > dolphin sim vehicles.fleet --platform
  dolphin sim: an order is not a valid 'hello': "purpose" is '?31m', not one of run, look, check
