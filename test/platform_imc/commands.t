The commands that speak IMC, with vehicles in another process.

  $ cat > pair.fleet <<'EOF'
  > vehicle 'noptilus-1', { type 'UUV'; payload 'DVL', 'Sidescan'; battery 80.percent }
  > vehicle 'x8-02', { type 'UAV' }
  > EOF
  $ vehicles() {
  >   dolphin sim pair.fleet --imc --announce 0.5 --contact 0.2 --discovery-ports $1-$(($1 + 4)) --port $(($1 + 10)) \
  >     --for 90 > vehicles.txt & vehicles=$!
  >   until [ -s vehicles.txt ]; do sleep 0.05; done
  > }

Who is there.

  $ vehicles 22200
  $ dolphin fleet --imc-loopback --imc-discovery-ports 22200-22204 --once --seconds 6 > fleet.txt
  $ awk '{ print $1, $2, $3 }' fleet.txt
  VEHICLE TYPE IMC
  noptilus-1 UUV 3001
  x8-02 UAV 3002
  $ dolphin fleet --imc-loopback --imc-discovery-ports 22200-22204 --once --seconds 6 --json --imc-payload x8-02=Camera |
  >   python3 -c "
  > import json, sys
  > for v in json.load(sys.stdin): print(v['id'], v['type'], v['address'], v['mode'], v['linked'], v['available'], v['plan'], 'DVL' in v['payload'], 'Camera' in v['payload'])"
  noptilus-1 UUV 127.0.0.1:22210 SERVICE True True None True False
  x8-02 UAV 127.0.0.1:22211 SERVICE True True None False True
  $ kill $vehicles; wait $vehicles 2> wait.txt || true

Its own definition of IMC gives names to what Dolphin has none for, and a vehicle can be of another type than IMC knows.

  $ python3 imc_xml.py ../imc/data/facts.jsonl > IMC.xml
  $ dolphin sim pair.fleet --imc --announce 0.5 --contact 0.2 --discovery-ports 22260-22264 --port 22270 --flood 100 \
  >   --for 90 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ dolphin fleet --imc-loopback --imc-discovery-ports 22260-22264 --once --seconds 6 --json --imc-xml IMC.xml \
  >   --imc-type noptilus-1=ROV | python3 -c "
  > import json, sys
  > for v in json.load(sys.stdin):
  >   said = {m['id']: m for m in v['messages']}
  >   print(v['id'], v['type'], said[256]['last'], said[256]['count'] > 10, said[350]['last']['abbrev'], 281 in said)"
  noptilus-1 ROV {'abbrev': 'AngularVelocity', 'time': 0.0, 'x': 0.0, 'y': 0.0, 'z': 0.0} True EstimatedState True
  x8-02 UAV {'abbrev': 'AngularVelocity', 'time': 0.0, 'x': 0.0, 'y': 0.0, 'z': 0.0} True EstimatedState True
  $ echo "v = pick { type 'ROV'; timeout 20.seconds }; message \"picked \${v}\"" > rov.dol
  $ dolphin exec rov.dol --imc-loopback --imc-discovery-ports 22260-22264 --imc-type noptilus-1=ROV | grep -o 'says: .*'
  says: picked noptilus-1
  $ kill $vehicles; wait $vehicles 2> wait.txt || true

A definition that is none, one that contradicts itself, and one of another protocol than vehicles speak to us.

  $ printf '<messages>\n  <message id="1" abbrev="A"/>\n  <message id="1" abbrev="B"/>\n</messages>\n' > twice.xml
  $ dolphin fleet --imc-xml twice.xml
  twice.xml:3:29: error: message B: the id 1 is taken
    3 |   <message id="1" abbrev="B"/>
      |                             ^
  [2]
  $ printf '<messages>\n  <message id="1" abbrev="A">\n    <field abbrev="x" type="float"/>' > float.xml
  $ dolphin fleet --imc-xml float.xml
  float.xml:3:37: error: unexpected end of input
    3 |     <field abbrev="x" type="float"/>
      |                                     ^
  [2]
  $ echo '</message></messages>' >> float.xml
  $ echo "message 'hello'" > hello.dol
  $ dolphin exec hello.dol --imc-xml float.xml
  float.xml:3:35: error: <field>: float is not a type of IMC
    3 |     <field abbrev="x" type="float"/></message></messages>
      |                                   ^
  [2]
  $ python3 imc_xml.py ../imc/data/facts.jsonl 'id="559"=>id="1559"' \
  >   'abbrev="sys_name" type="plaintext"=>abbrev="sys_name" type="uint8_t"' > other.xml
  $ dolphin exec hello.dol --imc-xml other.xml
  dolphin: other.xml is not the IMC that Dolphin speaks: field 1 of message Announce is sys_name u8, not sys_name text
  dolphin: other.xml is not the IMC that Dolphin speaks: message PlanControl has the id 1559, not 559
  [2]
  $ python3 -c "print('<messages>\n' + '<message>\n' * 200000)" > deep.xml
  $ dolphin fleet --imc-xml deep.xml
  deep.xml:101:9: error: elements are nested more than 100 deep
    101 | <message>
        |         ^
  [2]
  $ python3 -c "print('<messages>\n' + '<message/>\n' * 1000000 + '</messages>')" > wide.xml
  $ dolphin plan hello.dol P --imc-xml wide.xml
  wide.xml:100001:9: error: there are more than 100000 elements
    100001 | <message/>
           |         ^
  [2]
  $ python3 -c "print('<messages\n' + ' '.join(f'a{i}=\"1\"' for i in range(1000000)) + '/>')" > long.xml
  $ dolphin exec hello.dol --imc-xml long.xml 2>&1 | grep -o 'long.xml:2.*error.*' | sed 's/:2:[0-9]*/:2:N/'
  long.xml:2:N: error: this element has too many attributes
  $ dolphin exec hello.dol --imc-xml nowhere.xml
  dolphin: nowhere.xml: No such file or directory
  [2]
  $ dolphin exec hello.dol --imc-type ROV 2>&1 | head -1
  dolphin: option '--imc-type': 'ROV' is not like seacon-1=ROV

One that has vanished, and one that returns.

  $ rm -f vehicles.txt
  $ dolphin sim pair.fleet --imc --announce 0.3 --contact 0.2 --discovery-ports 22320-22324 --port 22330 --for 90 \
  >   --vanish x8-02=0 --vanish noptilus-1=0,1 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ dolphin fleet --imc-loopback --imc-discovery-ports 22320-22324 --once --seconds 6 | awk '{ print $1, $2 }'
  VEHICLE TYPE
  noptilus-1 UUV
  $ kill $vehicles; wait $vehicles 2> wait.txt || true

A vehicle that confirms nothing: its process is halted. The first interruption tells it to stop and waits for that to be
confirmed, for five seconds at most, and says so; the second one ends the program at once.

  $ vehicles 22280
  $ echo "v = pick { type 'UUV'; timeout 20.seconds }; execute imcPlan('long')" > long.dol
  $ (sh -c 'echo $$ > pid.txt; exec dolphin exec long.dol --imc-loopback --imc-discovery-ports 22280-22284 > log.txt 2> errors.txt'
  >  echo $? > status.txt) &
  $ until grep -qs 'starts long' log.txt || [ -s status.txt ]; do sleep 0.05; done
  $ kill -STOP $vehicles
  $ kill -INT $(cat pid.txt); until grep -q 'waiting 3 s more' log.txt; do sleep 0.05; done; kill -INT $(cat pid.txt)
  $ until [ -s status.txt ]; do sleep 0.05; done; cat status.txt
  130
  $ cut -c 10- log.txt | tail -4; cat errors.txt
  noptilus-1  stops long
  program     releases noptilus-1
  program     is interrupted
  program     noptilus-1: has not confirmed yet that it stopped plan long; waiting 3 s more
  dolphin: interrupted twice: ended at once; vehicles not yet ordered to stop keep running
  $ kill -CONT $vehicles; kill $vehicles; wait $vehicles 2> wait.txt || true

With the first one only, it does wait, and ends. What became of the plan nobody knows, and it says that.

  $ vehicles 22300
  $ rm status.txt log.txt
  $ (sh -c 'echo $$ > pid.txt; exec dolphin exec long.dol --imc-loopback --imc-discovery-ports 22300-22304 > log.txt'
  >  echo $? > status.txt) &
  $ until grep -qs 'starts long' log.txt || [ -s status.txt ]; do sleep 0.05; done
  $ kill -STOP $vehicles
  $ kill -INT $(cat pid.txt); sleep 2; [ -s status.txt ] || echo waits
  waits
  $ until [ -s status.txt ]; do sleep 0.05; done; cat status.txt
  130
  $ cut -c 10- log.txt | tail -2
  program     noptilus-1: has not confirmed yet that it stopped plan long; waiting 3 s more
  program     noptilus-1: may still run plan long: it was not heard to have stopped
  $ kill -CONT $vehicles; kill $vehicles; wait $vehicles 2> wait.txt || true

Nobody.

  $ dolphin fleet --imc-loopback --imc-discovery-ports 22220-22224 --once --seconds 0.2
  no system was heard of

What does not go together, and what is no option.

  $ echo "message 'hello'" > hello.dol
  $ dolphin exec hello.dol --imc --speed 2
  dolphin: vehicles of a network (--imc, --platform) are not simulated: --sim and --speed do not go with them
  [2]
  $ dolphin exec hello.dol --imc-payload x8-02 2>&1 | head -1
  dolphin: option '--imc-payload': 'x8-02' is not like x8-02=Camera,Sidescan
  $ dolphin exec hello.dol --imc-id 1 2>&1 | head -1
  dolphin: option '--imc-id': '1' is not the IMC address of a console, from
  $ dolphin exec hello.dol --imc-interface 192.0.2.1 --imc-discovery-ports 22240-22244
  dolphin: no interface of this machine has the address 192.0.2.1
  [3]
  $ dolphin exec hello.dol --imc-loopback --imc-discovery-ports 22240-22244
     0:00  program     says: hello
     0:00  program     ends

A plan as vehicles get it.

  $ cat > plan.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute imcPlan('survey') >> imcPlan {
  >   planName 'P'
  >   locate Location.APDL
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
  $ dolphin plan plan.dol P --imc-xml IMC.xml > by_definition.json
  $ dolphin plan plan.dol P | diff - by_definition.json | grep '^[<>]'
  <         "pitch": 0.2617993877991494,
  >         "pitch": 0.2617993950843811,
  $ dolphin plan plan.dol survey
  dolphin: 'survey' is a plan known to vehicles by name: the program does not describe it
  [1]
  $ dolphin plan plan.dol nothing
  dolphin: no vehicle is given a plan 'nothing'; inline plans are P
  [1]

The programs that ran did what the semantics allows.

  $ check-journals
