The commands that speak IMC, with vehicles in another process.

  $ cat > pair.fleet <<'EOF'
  > vehicle 'noptilus-1', { type 'UUV'; payload 'DVL', 'Sidescan'; battery 80.percent }
  > vehicle 'x8-02', { type 'UAV' }
  > EOF
  $ vehicles() {
  >   dolphin sim pair.fleet --imc --announce 0.5 --contact 0.2 --discovery-ports $1-$(($1 + 4)) --port $(($1 + 10)) \
  >     --for 30 > vehicles.txt & vehicles=$!
  >   until [ -s vehicles.txt ]; do sleep 0.05; done
  > }

Who is there.

  $ vehicles 42200
  $ dolphin fleet --imc-loopback --imc-discovery-ports 42200-42204 --once --seconds 3 > fleet.txt
  $ awk '{ print $1, $2, $3 }' fleet.txt
  VEHICLE TYPE IMC
  noptilus-1 UUV 3001
  x8-02 UAV 3002
  $ dolphin fleet --imc-loopback --imc-discovery-ports 42200-42204 --once --seconds 3 --json --imc-payload x8-02=Camera |
  >   python3 -c "
  > import json, sys
  > for v in json.load(sys.stdin): print(v['id'], v['type'], v['address'], v['mode'], v['linked'], v['available'], v['plan'], 'DVL' in v['payload'], 'Camera' in v['payload'])"
  noptilus-1 UUV 127.0.0.1:42210 SERVICE True True None True False
  x8-02 UAV 127.0.0.1:42211 SERVICE True True None False True
  $ kill $vehicles; wait $vehicles 2> wait.txt || true

Nobody.

  $ dolphin fleet --imc-loopback --imc-discovery-ports 42220-42224 --once --seconds 0.2
  no system was heard of

What does not go together, and what is no option.

  $ echo "message 'hello'" > hello.dol
  $ dolphin exec hello.dol --imc --speed 2
  dolphin: vehicles of a network (--imc) are not simulated: --sim and --speed do not go with them
  [2]
  $ dolphin exec hello.dol --imc-payload x8-02 2>&1 | head -1
  dolphin: option '--imc-payload': 'x8-02' is not like x8-02=Camera,Sidescan
  $ dolphin exec hello.dol --imc-id 1 2>&1 | head -1
  dolphin: option '--imc-id': '1' is not the IMC address of a console, from
  $ dolphin exec hello.dol --imc-loopback --imc-discovery-ports 42240-42244
     0:00  program     says: hello
     0:00  program     ends

A plan as vehicles get it.

  $ cat > plan.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute imcPlan('survey') >> imcPlan {
  >   planName 'P'
  >   speed 1.5, Speed.Units.METERS_PS
  >   goTo payload: [[name: 'Sidescan', Range: 50]]
  >   yoyo max_depth: 20, min_depth: 2
  > }
  > EOF
  $ dolphin plan plan.dol
  survey (by name)
  P: 1.Goto, 2.YoYo
  $ dolphin plan plan.dol P | python3 -c "
  > import json, sys
  > p = json.load(sys.stdin)
  > for m in p['maneuvers']: print(m['maneuver_id'], m['data']['abbrev'], m['data']['speed'], m['data']['speed_units'])
  > print(p['maneuvers'][0]['start_actions'][0]['name'], [(a['name'], a['value']) for a in p['maneuvers'][0]['start_actions'][0]['params']])
  > print(p['maneuvers'][1]['data']['z'], p['maneuvers'][1]['data']['amplitude'])
  > print([(t['source_man'], t['dest_man'], t['conditions']) for t in p['transitions']])"
  1.Goto Goto 1.5 METERS_PS
  2.YoYo YoYo 1.5 METERS_PS
  Sidescan [('Active', 'true'), ('Range', '50')]
  11.0 9.0
  [('1.Goto', '2.YoYo', 'maneuverIsDone')]
  $ dolphin plan plan.dol survey
  dolphin: 'survey' is a plan that vehicles know by name: the program does not describe it
  [1]
  $ dolphin plan plan.dol nothing
  dolphin: no vehicle is given a plan 'nothing'; inline plans are P
  [1]

The programs that ran did what the semantics allows.

  $ check-journals
