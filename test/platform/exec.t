What the page says about lines is what the schemas say.

  $ PYTHONPATH=../conformance python3 lines_of_page.py ../../docs/platform.md ../../conformance/schema
  34 fit

A program on the simulated fleet behind the protocol. Times are left out of the log.

  $ cat > slow.fleet <<'END'
  > vehicle 'auv-1', { type 'UUV' }
  > vehicle 'auv-2', { type 'UUV' }
  > plan 'survey', { duration 10.seconds }
  > plan 'long', { duration 1.hour }
  > plan 'bad', { duration 10.seconds; fails }
  > END
  $ adapter="dolphin sim slow.fleet --platform --speed 100"
  $ run() { dolphin exec "$@" 2>&1 | sed 's/^ *[0-9]*:[0-9]* *//'; }
  $ cat > two.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('survey') >> imcPlan('bad')
  > END
  $ run two.dol --journal two.run --platform "$adapter"
  program     picks auv-1
  auv-1       starts survey
  auv-1       ends survey
  auv-1       starts bad
  auv-1       fails in bad: plan failed
  program     releases auv-1
  program     fails: bad failed on auv-1: plan failed
  two.dol:2:33: error: bad failed on auv-1: plan failed
    2 | execute v: imcPlan('survey') >> imcPlan('bad')
      |                                 ^^^^^^^^^^^^^^
  $ dolphin trace check two.dol two.run | sed 's/ in 0:0[0-9]//'
  two.run: a run, of 7 transitions; failed: bad failed on auv-1: plan failed

A mission of items, as it is written and as the other side reads it.

  $ cat > fly.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: mission {
  >     name 'fly'; arm: true; vehicles 'auv-1', 'auv-2'
  >     takeOff 30
  >     goPos Location.APDL, altitude: 40
  >     move Location.APDL, { north 10; west 5 }
  >     surveyArea([Location.APDL, location(41.186, -8.7048), location(41.186, -8.7)], 50)
  >     stored 'field'
  >     returnHomeAndLand()
  > }
  > END
  $ dolphin plan fly.dol fly --fleet slow.fleet > fly.json
  $ python3 ../conformance/schema.py ../../conformance/schema/plan.schema.json fly.json
  1 checked, 0 wrong
  $ run fly.dol --journal fly.run --platform "$adapter"
  program     picks auv-1
  auv-1       starts fly
  auv-1       ends fly
  program     releases auv-1
  program     ends
  $ dolphin trace check fly.dol fly.run | sed 's/ in 0:0[0-9]//'
  fly.run: a run, of 6 transitions; completed
  $ dolphin check fly.dol --fleet slow.fleet --platform "$adapter"
  fly.dol: no errors
  slow.fleet: no errors
  fly: sim runs it
  $ dolphin check fly.dol --fleet slow.fleet --platform "../../examples/adapter.py"
  fly.dol: no errors
  slow.fleet: no errors
  fly: rover: it takes no plans in mission
  [2]

Adapters that cannot be spoken to: no run begins.

  $ for adapter in ./missing true 'echo {}' "echo '{\"kind\":\"hello\",\"protocol\":2,\"name\":\"x\"}'" \
  >   "echo '{\"kind\":\"error\",\"why\":\"no serial port\"}'" "echo '{\"kind\":\"pong\",\"id\":1}'"; do
  >   dolphin exec two.dol --journal none.run --platform "$adapter" 2>&1 | grep -v /bin/sh; test ! -e none.run || echo begun
  > done
  dolphin: the adapter './missing' ended with exit status 127 before it greeted
  dolphin: the adapter 'true' ended with exit status 0 before it greeted
  dolphin: the adapter 'echo {}' violates the platform protocol: its first line has no member 'kind' that is a text
  dolphin: the adapter 'echo '{"kind":"hello","protocol":2,"name":"x"}'' speaks version 2 of the platform protocol, and we version 1
  dolphin: the adapter 'echo '{"kind":"error","why":"no serial port"}'' says: no serial port
  dolphin: the adapter 'echo '{"kind":"pong","id":1}'' violates the platform protocol: its first line is not a 'hello'

Of journals that are there nothing is lost, nor is a run resumed.

  $ cp two.run before.run
  $ dolphin exec two.dol --journal two.run --platform false 2>&1 | sed 's/ended.*//'
  dolphin: the adapter 'false' 
  $ sed '/"label":"start(/q' before.run > cut.run
  $ cp cut.run before-cut.run
  $ dolphin exec two.dol --resume cut.run --platform false 2>&1 | sed 's/ended.*//'
  dolphin: the adapter 'false' 
  $ dolphin exec two.dol --resume cut.run --journal copy.run --platform false 2>&1 | sed 's/ended.*//'
  dolphin: the adapter 'false' 
  $ cmp two.run before.run && cmp cut.run before-cut.run && ls copy.run
  ls: cannot access 'copy.run': No such file or directory
  [2]

The example of the page.

  $ cat > rover.dol <<'END'
  > v = pick { type 'UGV' }
  > execute v: imcPlan('short') >> watch imcPlan('nonsense') onError { error -> message "${error}" }
  > END
  $ run rover.dol --journal rover.run --platform ../../examples/adapter.py
  program     picks rover-1
  rover-1     starts short
  rover-1     ends short
  rover-1     starts nonsense
  rover-1     fails in nonsense: undefined plan 'nonsense'
  program     says: nonsense failed on rover-1: undefined plan 'nonsense'
  program     releases rover-1
  program     fails: nonsense failed on rover-1: undefined plan 'nonsense'
  rover.dol:2:38: error: nonsense failed on rover-1: undefined plan 'nonsense'
    2 | execute v: imcPlan('short') >> watch imcPlan('nonsense') onError { error -> message "${error}" }
      |                                      ^^^^^^^^^^^^^^^^^^^

Two platforms in one run; a vehicle that both offer cannot be picked.

  $ cat > both.dol <<'END'
  > v = pick { type 'UGV' }
  > w = pick { type 'UUV' }
  > execute v: imcPlan('short'), w: imcPlan('survey')
  > END
  $ run both.dol --journal both.run --platform ../../examples/adapter.py --platform "dolphin sim slow.fleet --platform --speed 100" | sort
  auv-1       ends survey
  auv-1       starts survey
  program     ends
  program     picks auv-1
  program     picks rover-1
  program     releases rover-1, auv-1
  rover-1     ends short
  rover-1     starts short
  $ echo "vehicle 'rover-1', { type 'UGV' }" > rover.fleet
  $ cat > twice.dol <<'END'
  > pause 5.seconds
  > v = pick { type 'UGV'; timeout 0.1.seconds }
  > END
  $ run twice.dol --journal twice.run --platform ../../examples/adapter.py --platform "dolphin sim rover.fleet --platform"
  program     pauses for 5 s
  program     rover-1: is offered by rover and by sim: it cannot be picked until only one does
  program     fails: could not pick 1 vehicle of type 'UGV': rover-1 is offered by rover and by sim
  twice.dol:2:5: error: could not pick 1 vehicle of type 'UGV': rover-1 is offered by rover and by sim
    2 | v = pick { type 'UGV'; timeout 0.1.seconds }
      |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^

Who is there, and what keeps them from running a program's plans.

  $ dolphin fleet --once --platform ../../examples/adapter.py
  VEHICLE  TYPE  PLATFORM  POSITION            BATTERY  SPEED  PAYLOAD  LINK  READY
  rover-1  UGV   rover     41.18500, -8.70600  -        -      -        yes   yes
  $ dolphin fleet --once --json --platform ../../examples/adapter.py
  [{"id":"rover-1","platform":"rover","type":"UGV","latitude":41.185,"longitude":-8.706,"height":0.0,"battery":null,"speed":null,"payload":[],"linked":true,"available":true,"unready":null}]
  $ cat > inline.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan {
  >     planName 'look'
  >     locate 41.185, -8.706
  >     goTo payload: 'Camera'
  > }
  > END
  $ dolphin plan inline.dol --platform "dolphin sim slow.fleet --platform"
  look: sim runs it
  $ dolphin plan inline.dol --platform ../../examples/adapter.py
  look: rover: it takes no plans in imcPlan
  [1]
  $ dolphin plan inline.dol look --platform ../../examples/adapter.py --platform "dolphin sim slow.fleet --platform"
  {
    "name": "look",
    "language": "imcPlan",
    "body": {
      "description": "",
      "vehicles": [],
      "maneuvers": [
        {
          "id": "1.Goto",
          "maneuver": "goTo",
          "latitude": 41.185,
          "longitude": -8.706,
          "height": 0.0,
          "z": 2.0,
          "zUnit": "depth",
          "speed": 900.0,
          "speedUnit": "rpm",
          "payload": [
            { "name": "Camera", "parameters": { "Active": "true" } }
          ]
        }
      ]
    }
  }
  look: sim runs it
  $ dolphin check inline.dol --platform ../../examples/adapter.py
  inline.dol: no errors
  look: rover: it takes no plans in imcPlan
  [2]
  $ dolphin check rover.dol --platform ../../examples/adapter.py
  rover.dol: no errors
  rover.fleet: no errors
  short: rover runs it
  nonsense: rover: undefined plan 'nonsense'
  [2]
