The console of a folder, on a port of its own, and all that docs/openapi.json describes.

  $ export XDG_STATE_HOME=$(mktemp -d)
  $ cat > mission.dol << 'END'
  > parameter n = 2, 'how many'
  > input 'go'
  > x = ask 'How many?'
  > message "$x"
  > execute condition { consume go: 'south' }
  > END
  $ echo "answer 'How many?', 2" > mission.fleet
  $ echo 'message askk' > wrong.dol
  $ printf 'pause 1.minute\npause 2.seconds\n' > short.dol
  $ echo 'message "the end"' > end.dol
  $ { cat mission.dol; echo "include 'end.dol'"; } > longer.dol
  $ sed "s/How many/How often/" mission.dol > others.dol
  $ cat > plans.dol << 'END'
  > parameter n = 1, 'loiters'
  > both = pick { count 2 }
  > execute task('survey')[both]
  > execute both: imcPlan {
  >   planName 'circles'
  >   locate Location.APDL
  >   move 30, -125
  >   goTo()
  >   for (i in 1..n) { loiter radius: 100 }
  >   skeeping()
  > }
  > END
  $ cat > plans.fleet << 'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > plan 'survey'
  > plan 'deep', { only 'b' }
  > END
  $ cat > zones.kml << 'END'
  > <kml><Placemark><name>quay</name><Point><coordinates>-8.7,41.2</coordinates></Point></Placemark></kml>
  > END
  $ python3 - << 'END'
  > import sqlite3
  > db = sqlite3.connect("chart.mbtiles")
  > db.execute("CREATE TABLE metadata (name text, value text)")
  > db.execute("CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)")
  > db.execute("CREATE UNIQUE INDEX tile_index ON tiles (zoom_level, tile_column, tile_row)")
  > db.executemany("INSERT INTO metadata VALUES (?, ?)", [("minzoom", 1), ("maxzoom", "1"), ("bounds", "-9,41,-8,42")])
  > db.execute("INSERT INTO tiles VALUES (1, 0, 1, ?)", (b"\x89PNG\r\n\x1a\n",))
  > db.commit()
  > END
  $ echo 'no database' > broken.mbtiles
  $ serve() { dolphin console . --port "$1" --no-browser > "$2" & while ! grep -qs "is at" "$2" && kill -0 $!; do sleep 0.05; done; }
  $ serve 0 served
  $ console=$!
  $ port=$(sed -n 's/.*:\([0-9]*\)\/$/\1/p' served)
  $ python3 console_api.py ../../docs/openapi.json $port
  no run: no-run
  no run: no-run
  layers: ['broken.mbtiles', 'chart.mbtiles', 'zones.kml']
  shapes: ['quay']
  tiles: {'minimum': 1, 'maximum': 1, 'bounds': [-9, 41, -8, 42], 'attribution': ''}
  a tile: 200 404
  drawn: ['area', 'circle']
  imported: ['buoy']
  called: message x
  known: {'a': ['survey'], 'b': ['survey', 'deep']}
  plan: survey ['a'] by name None
  plan: circles ['b'] ['1.Goto 1 0', '2.Loiter 1 60', '3.Loiter 1 60', '4.StationKeeping 1 60'] 205
  a question: end: no answer to 'How many?': end of input
  explored: over ['no deadlock']
  counterexample: ['ask(How many?)', 'answer(2)', "message '2'", 'execute']
  carried out: no deadlock None interrupted
  no such faults: failed
  timed: violated {'completed': {'earliest': 62, 'latest': 62}} deadline 1:00
  with dates: [0, 60, 60, 62, 62]
  too large: failed
  another number: True
  graph: 8 states, 9 transitions
  wrong.dol: faults
  none.dol: not-found
  others.dol: differs
  added: include 'end.dol'
  
  message "the end"
  may follow: mission.dol violated ['no deadlock']
  may follow: longer.dol violated ['no deadlock']
  another text: changed
  replaced: 200 longer.dol
  kept: mission.dol interrupted
  notes: [(1.5, 'here it waits', None), (0, 'again', None)]
  of no run: bad-request
  replayed to its end: True
  not asked for: []
  all as described

A program of ten lines starts a run, watches it, posts to it:

  $ sed "s/:8642/:$port/" ../../examples/client.py > client.py
  $ python3 client.py mission.dol "go: 'south'" | sed 's/^ *[0-9:]* *//'
  program     asks: How many?
  program     says: 2
  program     gets go:'south'
  program     consumes go:'south'
  program     ends
  end

The plans on the command line:

  $ dolphin plan --json plans.dol survey
  {"plans":[{"plan":"survey","vehicles":["a"],"way":null,"breaks":null}],"unfinished":null}
  $ dolphin plan --json plans.dol none
  dolphin: no vehicle is given a plan 'none'; inline plans are circles
  [1]
  $ dolphin plan --json --to kml plans.dol
  dolphin: --json prints a summary of plans: it excludes export and --platform
  [2]

The port is taken; there is no such folder:

  $ dolphin console . --port $port 2>&1 | sed "s/$port/PORT/"
  dolphin: port PORT cannot be had: Address already in use
  $ dolphin console . --port 99999999 2>&1 | head -1
  dolphin: option '--port': '99999999' is not a port, from 0 to 65535
  $ dolphin console . --listen here 2>&1 | head -1
  dolphin: option '--listen': 'here' is not an address such as 192.168.1.5
  $ dolphin console . --tiles https://tile.example/ 2>&1 | head -1
  dolphin: option '--tiles': https://tile.example/ is not an address of tiles,
  $ echo 'ana steer' > crew && chmod 600 crew
  $ dolphin console . --proxy-user-header X-User
  dolphin: --proxy-user-header goes with --operators: their names are in the header
  [2]
  $ dolphin console . --proxy-user-header X-User --operators crew --listen 0.0.0.0
  dolphin: --proxy-user-header goes with 127.0.0.1 or ::1 alone: elsewhere every client could send that header
  [2]
  $ dolphin console . --proxy-user-header Host --operators crew 2>&1 | head -1
  dolphin: option '--proxy-user-header': 'Host' is not a header such as
  $ dolphin console none
  dolphin: none: No such file or directory
  [2]

Vehicles of an adapter are heard before a run; the adapter ends before that of the run begins:

  $ cat > adapter << 'END'
  > #!/bin/sh
  > echo begins >> lives
  > trap 'echo ends >> lives' EXIT
  > dolphin sim plans.fleet --platform
  > END
  $ chmod +x adapter
  $ echo "v = pick { type 'UUV' }" > picks.dol
  $ dolphin console . --platform ./adapter --port 0 --no-browser > real & real=$!
  $ while ! grep -qs "is at" real; do sleep 0.05; done
  $ python3 - $(sed -n 's/.*:\([0-9]*\)\/$/\1/p' real) << 'END'
  > import json, sys, time, urllib.request
  > base = f"http://127.0.0.1:{sys.argv[1]}/api/"
  > def ask(path, body=None):
  >     request = urllib.request.Request(base + path, body and json.dumps(body).encode(), {"Content-Type": "application/json"})
  >     return urllib.request.urlopen(request, timeout=20)
  > def heard(events):
  >     for line, _ in zip(events, range(2000)):
  >         if line == b"event: heard\n":
  >             found = json.loads(next(events).split(b":", 1)[1])
  >             if len(found["vehicles"]) == 2: return sorted(v["vehicle"] for v in found["vehicles"])
  > events = ask("events")
  > print("heard:", heard(events))
  > ask("run", {"program": "picks.dol"})
  > while json.load(ask("status"))["run"]["state"] != "over": time.sleep(0.05)
  > print("heard again:", heard(events))
  > END
  heard: ['a', 'b']
  heard again: ['a', 'b']
  $ kill -INT $real && wait $real
  $ cat lives
  begins
  ends
  begins
  ends
  begins
  ends

The server is killed during a run, and the next one resumes it:

  $ python3 resume.py start $port
  How many?
  $ kill -9 $console
  $ wait $console 2> wait; rm served
  $ serve $port served
  $ console=$!
  $ python3 resume.py resume $port
  mission.dol broken off
  How many?
  completed

Likewise after its program was replaced: the run goes on with the new one.

  $ python3 resume.py replace $port
  longer.dol
  $ kill -9 $console
  $ wait $console 2> wait; rm served
  $ serve $port served
  $ console=$!
  $ python3 resume.py onwards $port
  completed
  says: the end
  $ kill -INT $console
  $ wait $console
  $ dolphin runs | grep -o 'sim .*[a-z]' | sort
  sim       completed
  sim       completed
  sim       completed
  sim       interrupted
