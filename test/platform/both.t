One run on a vehicle that speaks IMC and on one of an adapter: its console is killed twice, and what resumes it finds
both.

  $ echo "vehicle 'auv-1', { type 'UUV' }" > auv.fleet
  $ echo "vehicle 'uav-1', { type 'UAV' }" > uav.fleet
  $ for plan in a1 a2; do echo "plan '$plan', { duration 60.seconds }" >> auv.fleet; done
  $ for plan in b1 b2; do echo "plan '$plan', { duration 60.seconds }" >> uav.fleet; done
  $ cat > m.dol <<'END'
  > v = pick { type 'UUV'; timeout 1.min }
  > w = pick { type 'UAV'; timeout 1.min }
  > execute v: (imcPlan('a1') >> imcPlan('a2')), w: (imcPlan('b1') >> imcPlan('b2'))
  > message 'Done!'
  > END
  $ dolphin sim auv.fleet --imc --speed 10 --announce 0.5 --contact 0.2 --discovery-ports 22360-22364 --port 22370 \
  >   --log auv.log --for 300 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ imc="--imc-loopback --imc-discovery-ports 22360-22364"
  $ adapter="dolphin sim uav.fleet --platform --speed 10 --state uav.state"
  $ killed() {  # once both have started these
  >   until grep -qs "start(auv-1, $1)" m.run && grep -qs "start(uav-1, $2)" m.run || ! kill -0 $run; do sleep 0.05; done
  >   kill -KILL $run; wait $run
  > }
  $ dolphin exec m.dol --journal m.run $imc --platform "$adapter" > log & run=$!
  $ killed a1 b1 2> wait.txt
  [137]

It needs both, and does not begin with one of them; the vehicles go on.

  $ dolphin exec m.dol --resume m.run $imc
  dolphin: m.run: this run was on vehicles of a network, which will move again: give --imc and --platform
  [2]
  $ dolphin exec m.dol --resume m.run $imc --platform false
  dolphin: the adapter 'false' ended with exit status 1 before it greeted
  [3]
  $ dolphin exec m.dol --resume m.run $imc --platform "$adapter" > log & run=$!
  $ killed a2 b2 2> wait.txt
  [137]
  $ dolphin exec m.dol --resume m.run $imc --platform "$adapter" | tail -2 | cut -c 10-
  program     releases auv-1, uav-1
  program     ends
  $ kill $vehicles; wait $vehicles || true

Each plan was started once, and none was stopped.

  $ grep '"did":"started"' auv.log | sed 's/.*"plan":"\([^"]*\)".*"sent":\([0-9.]*\).*/\1 \2/' | sort -u | cut -d' ' -f1
  a1
  a2
  $ grep -c '"did":"stopped"' auv.log
  0
  [1]
  $ python3 -c "
  > import json
  > for line in open('uav.state'):
  >     order = json.loads(line).get('order', {})
  >     if order.get('kind') in ('start', 'stop'): print(order['kind'], order.get('plan', {}).get('name'))"
  start b1
  start b2
  $ dolphin trace check m.dol m.run | sed 's/, of [^;]*//'
  m.run: a run; completed
