The journal of a run, judged, shown and drawn.

  $ dolphin exec ../../examples/rendezvous.dol --journal rendezvous.run > /dev/null
  $ head -c 40 rendezvous.run; echo
  {"format":"dolphin-journal","version":1,
  $ sed -n '8,11p' rendezvous.run
  {"kind":"vehicle","time":0,"vehicle":"noptilus-3","type":"UUV","payload":["DVL","Sidescan"],"latitude":41.1844,"longitude":-8.7068,"height":0,"battery":1,"connected":true,"speed":0,"cruise":1.5,"drain":0.1}
  {"kind":"transition","time":0,"i":3,"rule":["PICK-BIND"],"label":"bind(noptilus-1, noptilus-2, noptilus-3)","at":"5:8","B":{"bound":["noptilus-1","noptilus-2","noptilus-3"]},"effects":[{"cancel-timer":0},{"bind":["noptilus-1","noptilus-2","noptilus-3"]}]}
  {"kind":"transition","time":0,"i":4,"rule":["PICK"],"label":"pick(1 vehicle of type 'UAV' in region (41.185000, -8.706200) ^ 2000 m)","at":"11:7","effects":[{"look-for":"1 vehicle of type 'UAV' in region (41.185000, -8.706200) ^ 2000 m"}]}
  {"kind":"vehicle","time":0,"vehicle":"x8-02","type":"UAV","payload":[],"latitude":41.184,"longitude":-8.707,"height":0,"battery":1,"connected":true,"speed":0,"cruise":18,"drain":0.1}
  $ dolphin trace check ../../examples/rendezvous.dol rendezvous.run
  rendezvous.run: a run, of 35 transitions in 18:44; completed
  $ dolphin trace show rendezvous.run
      time  program                                           noptilus-1  noptilus-2  noptilus-3  x8-02
      0:00  asks: Radius of operation area? (km)
            is answered: 2
            looks for 3 vehicles of type 'UUV' with payload
            DVL, Sidescan in region (41.185000, -8.706200) ^
            2000 m
            picks noptilus-1, noptilus-2, noptilus-3          picked      picked      picked
            looks for 1 vehicle of type 'UAV' in region
            (41.185000, -8.706200) ^ 2000 m
            picks x8-02                                                                           picked
            connection timeout 120 s for noptilus-1,
            noptilus-2, noptilus-3
                                                              ┌ survey1
                                                              │           ┌ survey2
                                                              │           │           ┌ survey3
      4:11                                                    │           └ done      │
            posts ready:2                                     │                       │
                                                              │           ┌ sk2       │
            consumes ready:2                                  │           │           │
                                                              │           │           │           ┌ rv2
      5:04                                                    │           │           │           └ done
      5:36                                                    └ done      │           │
            posts ready:1                                                 │           │
                                                              ┌ sk1       │           │
            consumes ready:1                                  │           │           │
                                                              │           │           │           ┌ rv1
      6:36                                                    │           │           └ done      │
            posts ready:3                                     │           │                       │
                                                              │           │           ┌ sk3       │
      6:37                                                    │           │           │           └ done
            consumes ready:3                                  │           │           │
                                                              │           │           │           ┌ rv3
      7:40                                                    │           │           │           └ done
     15:47                                                    │           └ done      │
     16:43                                                    └ done                  │
     18:44                                                                            └ done
            releases noptilus-1, noptilus-2, noptilus-3,      released    released    released    released
            x8-02
            says: Done!
            completed
  $ dolphin trace show --transitions rendezvous.run | head -5
       0      0:00  2:5      ASK  ask(Radius of operation area? (km))
       1      0:00  2:5      ANSWER  answer(2)
       2      0:00  5:8      PICK  pick(3 vehicles of type 'UUV' with payload DVL, Sidescan in region (41.185000, -8.706200) ^ 2000 m)
       3      0:00  5:8      PICK-BIND  bind(noptilus-1, noptilus-2, noptilus-3)
       4      0:00  11:7     PICK  pick(1 vehicle of type 'UAV' in region (41.185000, -8.706200) ^ 2000 m)

Keeping a journal makes no difference to the run.

  $ dolphin exec ../../examples/rendezvous.dol > without.log
  $ dolphin exec ../../examples/rendezvous.dol -o again.run | diff without.log -

Errors, and who is stopped.

  $ dolphin exec ../../examples/watch.dol --journal watch.run > /dev/null 2>&1
  [1]
  $ dolphin trace show watch.run
      time  program                                           noptilus-1     noptilus-2
      0:00  looks for 2 vehicles of type 'UUV'
            picks noptilus-1, noptilus-2                      picked         picked
                                                              ┌ deep_dive
                                                              │              ┌ shallow_dive
      2:30  says: trouble: deep_dive failed on noptilus-1:    ✗ plan failed  │
            plan failed                                                      │
     10:00                                                                   └ done
            says: errors: 1
                                                              ┌ deep_dive
                                                              │              ┌ shallow_dive
     13:40  says: This is the end.                            ✗ plan failed  └ stopped
            releases noptilus-1, noptilus-2                   released       released
            failed: deep_dive failed on noptilus-1: plan
            failed

A run that was killed: the beginning of one.

  $ head -c 9000 rendezvous.run > torn.run
  $ dolphin trace check ../../examples/rendezvous.dol torn.run
  torn.run: the beginning of a run, of 11 transitions in 0:30; it breaks off in the middle of a line
  $ head -n 20 rendezvous.run > broken_off.run
  $ dolphin trace check ../../examples/rendezvous.dol broken_off.run
  broken_off.run: the beginning of a run, of 11 transitions in 0:05; it breaks off
  $ dolphin trace show torn.run | tail -2
                                                              │           ┌ survey2
                                                              │           │           ┌ survey3

A tuple that was never posted.

  $ sed 's/post ready:2/post ready:4/; s/"posted":\["ready:2"\]/"posted":["ready:4"]/' rendezvous.run > other.run
  $ dolphin trace check ../../examples/rendezvous.dol other.run
  other.run: line 220 does not belong to a run: transition 12, at 26:1: act(post ready:4)
    no transition is like this one; the nearest differs: "label" should be "act(post ready:2)", not "act(post ready:4)"
    false then: when at 32:17, when at 34:17, when at 36:17
    enabled then: act(post ready:2)
    awaited then: the end of noptilus-1's task, the end of noptilus-3's task
    before it: 12 transitions of a run
  [1]

A condition that did not hold: nothing was posted.

  $ sed '/"event":"done","vehicle":"noptilus-2"/,/start(noptilus-2, sk2)/d' rendezvous.run |
  >   python3 renumber.py > early.run
  $ dolphin trace check ../../examples/rendezvous.dol early.run
  early.run: line 218 does not belong to a run: transition 11, at 26:1: check(consume ready:2)
    nothing could happen by itself, so check(consume ready:2) could not
    false then: when at 32:17, when at 34:17, when at 36:17
    enabled then: nothing
    awaited then: the end of noptilus-1's task, the end of noptilus-2's task, the end of noptilus-3's task
    before it: 11 transitions of a run
  [1]

An event that nobody waited for.

  $ sed 's/"event":"done","vehicle":"noptilus-2"/"event":"done","vehicle":"x8-02"/' rendezvous.run > nobody.run
  $ dolphin trace check ../../examples/rendezvous.dol nobody.run
  nobody.run: line 219 does not belong to a run: transition 11, at 18:5: done(noptilus-2, survey2)
    the end of x8-02's task makes no transition: it was not awaited
    false then: when at 32:17, when at 34:17, when at 36:17
    enabled then: nothing
    awaited then: the end of noptilus-1's task, the end of noptilus-2's task, the end of noptilus-3's task
    before it: 11 transitions of a run
  [1]

A run of another program; and the same one, with a comment more.

  $ dolphin trace check ../../examples/sequence.dol rendezvous.run
  dolphin: ../../examples/sequence.dol is not the program of this run, or has changed since: places are not compared
  rendezvous.run: line 2 does not belong to a run: transition 0, at 2:5: ask(Radius of operation area? (km))
    no transition is like this one; the nearest differs: "label" should be "pick(1 vehicle with id 'x8-02')", not "ask(Radius of operation area? (km))"
    enabled then: pick(1 vehicle with id 'x8-02')
    awaited then: nothing
    before it: 0 transitions of a run
  [1]
  $ (echo '// Rendezvous'; cat ../../examples/rendezvous.dol) > commented.dol
  $ dolphin trace check commented.dol rendezvous.run
  dolphin: commented.dol is not the program of this run, or has changed since: places are not compared
  rendezvous.run: a run, of 35 transitions in 18:44; completed

What is no journal.

  $ dolphin trace check ../../examples/rendezvous.dol ../../examples/rendezvous.fleet
  dolphin: ../../examples/rendezvous.fleet:1: this is not a journal: its first line is not the header of one
  [2]
  $ dolphin trace show /dev/null
  dolphin: /dev/null:1: the journal is empty
  [2]
  $ dolphin trace check ../../examples/rendezvous.dol missing.run
  dolphin: missing.run: No such file or directory
  [2]
  $ dolphin trace check ../../examples/rendezvous.dol .
  dolphin: .: Is a directory
  [2]
  $ (head -n 5 rendezvous.run; echo oops; tail -n 3 rendezvous.run) > hole.run
  $ dolphin trace check ../../examples/rendezvous.dol hole.run
  dolphin: hole.run:6: this is not JSON: Line 1, bytes 0-4: Invalid token 'oops'
  [2]
  $ dolphin trace show hole.run 2> told | head -4; cat told
      time  program
      0:00  asks: Radius of operation area? (km)
            is answered: 2
            looks for 3 vehicles of type 'UUV' with payload
  dolphin: hole.run:6: this is not JSON: Line 1, bytes 0-4: Invalid token 'oops'

Pictures are whole documents that need nothing else.

  $ dolphin trace draw rendezvous.run -o run.svg
  $ dolphin trace draw rendezvous.run -o run.html
  $ python3 -c "import xml.dom.minidom; xml.dom.minidom.parse('run.svg')"
  $ dolphin exec ../../examples/rendezvous.dol --draw now.svg > /dev/null
  $ sed 's/20..-..-..T..:..:..Z//' run.svg > a; sed 's/20..-..-..T..:..:..Z//' now.svg | diff a -
  $ dolphin trace draw rendezvous.run -o run.png 2>&1 | head -2
  dolphin: option '-o': 'run.png' ends neither in .svg nor in .html
  Usage: dolphin trace draw [--layer=FILE] [--output=FILE] [OPTION]… RUN

Maps of other programs lie below the ways: names are tips and legends, what is far away is left out, and a coast with
very many corners is not more than what is seen of it.

  $ cat > chart.py <<'EOF'
  > import json, math
  > far = [[-8.75 + i / 2e6, 41.186 + 0.002 * math.sin(i / 9000)] for i in range(100000)]
  > def feature(name, kind, at):
  >     return {"type": "Feature", "properties": {"name": name}, "geometry": {"type": kind, "coordinates": at}}
  > json.dump({"type": "FeatureCollection", "features": [
  >     feature("the coast", "LineString", far), feature("R&D <buoy>", "Point", [-8.706, 41.185]),
  >     feature("elsewhere", "Polygon", [[[10, 50], [11, 50], [11, 51], [10, 50]]])]}, open("harbour.geojson", "w"))
  > EOF
  $ python3 chart.py
  $ echo '<kml><Placemark><name>work</name><Polygon><outerBoundaryIs><LinearRing><coordinates>-8.707,41.184 -8.705,41.184 -8.705,41.186 -8.707,41.184</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></kml>' > work.kml
  $ dolphin exec ../../examples/fences.dol --journal fences.run > /dev/null
  $ dolphin trace draw fences.run --layer harbour.geojson --layer work.kml -o layers.svg
  $ cat > shown.py <<'EOF'
  > import xml.etree.ElementTree as tree
  > for e in tree.parse("layers.svg").iter():
  >     if e.get("class", "").startswith("layer"):
  >         corners = e.get("d", "").count("L")
  >         print(e.tag.split("}")[1], e.get("class"), [t.text for t in e], "many" if corners > 2000 else corners > 100)
  > EOF
  $ python3 shown.py
  path layer layer0 ['the coast'] True
  circle layer layer0 spot ['R&D <buoy>'] False
  path layer layer1 filled ['work'] False
  line layer layer0 [] False
  line layer layer1 [] False
  $ dolphin exec ../../examples/fences.dol --draw layers.html --layer harbour.geojson --layer work.kml > /dev/null
  $ grep -o "<title>[^<]*</title>" layers.html | grep -c "the coast\|buoy\|work"
  3
  $ dolphin exec ../../examples/fences.dol --layer work.kml
  dolphin: --layer needs --draw: it is a map below the ways of the run
  [2]
  $ dolphin exec ../../examples/fences.dol --draw many.svg --runs 10 --layer work.kml
  dolphin: --layer excludes --runs and --until: these draw the ends of runs, and no ways
  [2]
  $ dolphin exec ../../examples/fences.dol --draw many.svg --layer nowhere.kml
  dolphin: nowhere.kml: No such file or directory
  [2]
  $ dolphin trace draw fences.run --layer nowhere.kml -o layers.svg
  dolphin: nowhere.kml: No such file or directory
  [2]
  $ echo '{"type": "Feature"' > broken.geojson
  $ dolphin trace draw fences.run --layer broken.geojson -o layers.svg
  dolphin: broken.geojson: line 2, bytes -1-0: this is not JSON: unexpected end of input
  [2]
  $ dolphin trace draw fences.run --layer fences.run -o layers.svg
  dolphin: fences.run: a map ends in .geojson, .json, .kml, .kmz, .gpx, .plan, .nmap, .nmisz
  [2]

A journal that cannot be written stops the run, and the vehicles. If that can be seen before, nothing starts.

  $ dolphin exec ../../examples/sequence.dol --journal /dev/full
  dolphin: the journal cannot be written: /dev/full: No space left on device
  [3]
  $ dolphin exec ../../examples/sequence.dol --journal missing/x.run
  dolphin: the journal cannot be written: missing/x.run: No such file or directory
  [3]
  $ dolphin exec ../../examples/sequence.dol --draw missing/x.svg
  dolphin: the picture cannot be written: missing/x.svg: No such file or directory
  [3]

  $ mkdir folder.svg
  $ dolphin exec ../../examples/sequence.dol --draw folder.svg
  dolphin: the picture cannot be written: folder.svg: this is a directory, not a file
  [3]

Nor can it go over the program.

  $ cp ../../examples/sequence.dol precious.dol
  $ dolphin exec precious.dol --journal ./precious.dol
  dolphin: ./precious.dol: the run was to be written over its own program or fleet
  [3]
  $ diff precious.dol ../../examples/sequence.dol

A console that is killed leaves the beginning of a run; one that is interrupted, a whole one.

  $ dolphin exec ../../examples/parallel.dol --speed 20 --journal killed.run > /dev/null & run=$!
  $ until grep -qs 'start(' killed.run || ! kill -0 $run; do sleep 0.05; done; kill -9 $run; wait $run 2> /dev/null
  [137]
  $ dolphin trace check ../../examples/parallel.dol killed.run | sed 's/, of [^;]*//; s/ in the middle of a line//'
  killed.run: the beginning of a run; it breaks off

What it did is not written over: the run can be resumed. One that is over, or did nothing, is.

  $ cp killed.run kept.run
  $ dolphin exec ../../examples/parallel.dol --journal killed.run
  dolphin: killed.run: this is the journal of a run that broke off: go on with it by --resume killed.run, or remove it
  [3]
  $ cp killed.run other.run
  $ dolphin exec ../../examples/parallel.dol --resume other.run --journal killed.run
  dolphin: killed.run: this is the journal of a run that broke off: go on with it by --resume killed.run, or remove it
  [3]
  $ cmp killed.run kept.run
  $ dolphin exec ../../examples/parallel.dol --resume killed.run > /dev/null
  $ dolphin exec ../../examples/parallel.dol --journal killed.run > /dev/null
  $ head -1 kept.run > nothing.run
  $ dolphin exec ../../examples/parallel.dol --journal nothing.run > /dev/null
  $ dolphin trace check ../../examples/parallel.dol nothing.run | sed 's/, of [^;]*//'
  nothing.run: a run; completed
  $ dolphin exec ../../examples/parallel.dol --speed 20 --journal stopped.run > /dev/null & run=$!
  $ until grep -qs 'start(' stopped.run || ! kill -0 $run; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ dolphin trace check ../../examples/parallel.dol stopped.run | sed 's/, of [^;]*//'
  stopped.run: a run; interrupted

A program that is stuck.

  $ cat > stuck.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute waitFor { consume a: 1 } then task('t')[v]
  > EOF
  $ dolphin exec stuck.dol --journal stuck.run > /dev/null 2>&1
  [1]
  $ dolphin trace check stuck.dol stuck.run
  stuck.run: a run, of 4 transitions in 0:00; stuck

A reader of the journal that goes away ends the run.

  $ echo 'for(i in 1..2000) { post a: i; consume a:_ }' > long.dol
  $ (timeout 20 dolphin exec long.dol --journal /dev/stdout 2> trouble; echo "status $?" >> trouble) | head -c 20; echo
  {"format":"dolphin-j
  $ cat trouble
  dolphin: the journal cannot be written: /dev/stdout: Broken pipe; the run was ended as by Ctrl-C
  status 3

Standard output has the log, and no journal beside it.

  $ dolphin exec long.dol --journal -
  dolphin: standard output has the log, so the journal needs a file: name one (./- for a file called -)
  [2]
  $ test -e ./-
  [1]
