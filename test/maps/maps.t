The example, whose log is beside it.

  $ cp ../../examples/maps/* .
  $ dolphin exec harbour.dol | diff harbour.log -
  $ dolphin explore harbour.dol | head -2
  no deadlock: holds
  termination: holds

A changed map is a changed program.

  $ dolphin exec harbour.dol --quiet --journal harbour.run
     0:00  program     says: [north basin, buoy, fairway, wreck]: the basin has 70812 square metres
     8:00  program     says: noptilus-2 is clear of the fairway
     8:00  program     ends
  completed after 8:00
    tasks    2 done
    journal  harbour.run
  $ dolphin trace check harbour.dol harbour.run | sed 's/ in .*//'
  harbour.run: a run, of 10 transitions
  $ cut -b 1-3000 harbour.run | grep -v '"kind":"end"' > torn.run
  $ sed -i 's/-8.7052,41.1865/-8.7052,41.1866/' harbour.geojson
  $ dolphin trace check harbour.dol harbour.run 2>&1 | head -1
  dolphin: harbour.dol is not the program of this run, or has changed since: places are not compared
  $ dolphin exec harbour.dol --resume torn.run 2>&1 | cut -c 1-90
  dolphin: torn.run: this run was of another program, or the program has changed since; --fo

Names that the map does not have are told before anything moves; so is what is wrong with a map.

  $ cat > wrong.dol <<'EOF'
  > harbour = map 'harbour.geojson'
  > message harbour.boy
  > message harbour['north basn']
  > message harbour.keys().size() + harbour.size()
  > message map('none.kml')
  > message map('wrong.dol')
  > name = 'harbour.geojson'
  > message map(name)
  > message map('a.kml', 'b.kml')
  > EOF
  $ dolphin check wrong.dol
  wrong.dol:2:17: error: harbour.geojson has no 'boy'
    2 | message harbour.boy
      |                 ^^^
      hint: did you mean 'buoy'?
  wrong.dol:3:17: error: harbour.geojson has no 'north basn'
    3 | message harbour['north basn']
      |                 ^^^^^^^^^^^^
      hint: did you mean 'north basin'?
  wrong.dol:5:13: error: the map cannot be read: none.kml: No such file or directory
    5 | message map('none.kml')
      |             ^^^^^^^^^^
  wrong.dol:6:13: error: the map cannot be read: wrong.dol: a map ends in .geojson, .json, .kml, .kmz, .gpx, .plan, .nmap, .nmisz
    6 | message map('wrong.dol')
      |             ^^^^^^^^^^^
  wrong.dol:8:13: error: map takes the name of a file, as a text in quotes: it is read before anything runs
    8 | message map(name)
      |             ^^^^
      hint: write map 'harbour.geojson'
  wrong.dol:9:9: error: map takes 1 argument, not 2
    9 | message map('a.kml', 'b.kml')
      |         ^^^^^^^^^^^^^^^^^^^^^
      hint: write map 'harbour.geojson'
  wrong.dol: 6 errors
  [2]

Where a variable may be something else, the program runs, as with any map of names.

  $ cat > hidden.dol <<'EOF'
  > harbour = map 'harbour.geojson'
  > def f(harbour) { harbour.anything }
  > message f([anything: 1])
  > EOF
  $ dolphin exec hidden.dol | grep says
     0:00  program     says: 1

A program may have something else that is called map; and a map is found beside the file that names it.

  $ cat > own.dol <<'EOF'
  > def map(x) { "my $x" }
  > message map('harbour.geojson')
  > EOF
  $ dolphin exec own.dol | grep says
     0:00  program     says: my harbour.geojson
  $ mkdir lib && cp harbour.geojson lib/ && echo "quay = map('harbour.geojson').buoy" > lib/quay.dol
  $ echo "include 'lib/quay.dol'
  > message quay" > including.dol
  $ (cd / && dolphin exec "$OLDPWD/including.dol") | grep says
     0:00  program     says: (41.185500, -8.706100)

What Dolphin exports, it reads: the same positions in each format.

  $ python3 hostile.py
  $ dolphin exec harbour.dol --quiet --journal again.run
     0:00  program     says: [north basin, buoy, fairway, wreck]: the basin has 70812 square metres
     8:05  program     says: noptilus-2 is clear of the fairway
     8:05  program     ends
  completed after 8:05
    tasks    2 done
    journal  again.run
  $ for format in geojson kml gpx; do
  >   dolphin trace export again.run -o again.$format
  >   echo "m = map 'again.$format'
  >   message \"\${m.keys()} \${m['noptilus-2'].size()} \${m['noptilus-2'][0]} \${m['look 2']}\"" > again.dol
  >   dolphin exec again.dol | grep says
  > done | sort -u | sed 's/ [0-9]* (/ N (/'
     0:00  program     says: [look, look 2, noptilus-2] N (41.186500, -8.706500) (41.184566, -8.707737, -2.0 m)
     0:00  program     says: [noptilus-2, look, look 2] N (41.186500, -8.706500) (41.184566, -8.707737, -2.0 m)

Archives: those of Google Earth and Neptus.

  $ for file in good.kmz good.nmisz; do
  >   echo "m = map '$file'
  >   message m" > archive.dol
  >   dolphin exec archive.dol | grep says
  > done
     0:00  program     says: [deck:(41.000000, -8.000000)]
     0:00  program     says: [pier:(41.500000, -8.250000, -2.0 m), pier 2:(41.500000, -8.250000, -2.0 m)]

Hostile files: nothing is expanded, followed or written, and memory is bounded.

  $ for file in bomb.kmz many.kmz torn.kmz overlap.kmz encrypted.kmz none.kmz \
  >     entity.kml external.kml laughs.kml laughs.gpx parameter.kml deep.kml deep.geojson large.geojson large.nmap \
  >     large.nmisz; do
  >   echo "x = map '$file'" > hostile.dol
  >   (ulimit -v 4000000; dolphin check hostile.dol) 2>&1 | sed -n 's/.*cannot be read: //p'
  > done
  bomb.kmz: unpacked, it has more than 20 MB
  many.kmz: unpacked, it has more than 20 MB
  torn.kmz: this ZIP archive is broken
  overlap.kmz: the files in this archive overlap
  encrypted.kmz: 'doc.kml' in it is encrypted
  none.kmz: this archive has no *.kml
  entity.kml: line 2, column 26: this is not XML: unknown entity reference (b)
  external.kml: line 2, column 32: this is not XML: unknown entity reference (x)
  laughs.kml: line 2, column 27: this is not XML: unknown entity reference (l9)
  laughs.gpx: line 2, column 20: this is not XML: unknown entity reference (l9)
  deep.kml: line 1: elements are nested more than 100 deep
  deep.geojson: line 1, column 101: lists and objects are nested more than 100 deep
  large.geojson: the file is larger than 64 MB
  large.nmap: it has more than 20 MB
  large.nmisz: unpacked, it has more than 20 MB
  $ ls ../evil* ./evil* 2>/dev/null
  [2]

Areas that are none, and those that would take all day.

  $ for file in ringless cornerless flat nothing bow beyond world endless lattice; do
  >   echo "x = map '$file.geojson'" > hostile.dol
  >   (ulimit -v 4000000; dolphin check hostile.dol) 2>&1 | sed -n 's/.*cannot be read: //p; s/.*warning: //p'
  > done
  ringless.geojson: the geometry: it is empty, and left out
  cornerless.geojson: the geometry: it is empty, and left out
  flat.geojson: the geometry: the corners of a polygon are not on one line
  nothing.geojson: the geometry: it is empty, and left out
  bow.geojson: the geometry: a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
  beyond.geojson: the geometry, position 3: longitude 240 is not from -180 to 180 degrees
  world.geojson: the geometry: an area reaches at most 200 km from its middle
  endless.geojson: the geometry: a number of that size or kind is not known
  lattice.geojson: the geometry: an area has 20000 corners at most, not 40000

Nor is it an area if its holes leave nothing of it: as a fence it would keep no vehicle out.

  $ python3 - <<'EOF'
  > import json
  > square = lambda x, d: [[x, 41.1], [x + d, 41.1], [x + d, 41.11], [x, 41.11], [x, 41.1]]
  > whole = square(-8.7, 0.01)
  > halves = [[[x, 41.1], [x + 0.005, 41.1], [x + 0.005, 41.11], [x, 41.11], [x, 41.1]] for x in (-8.7, -8.695)]
  > rounded = [[[x + d, y] for x, y in half] for half, d in zip(halves, (0, -0.000001))]
  > for name, holes in (("covered", [whole]), ("turned", [whole[::-1]]), ("tiled", halves), ("rounded", rounded)):
  >     json.dump({"type": "Polygon", "coordinates": [whole, *holes]}, open(name + ".geojson", "w"))
  > EOF
  $ for file in covered turned tiled rounded; do
  >   echo "fence outside map '$file.geojson'" > hostile.dol
  >   dolphin check hostile.dol 2>&1 | head -1
  > done
  hostile.dol:1:19: error: the map cannot be read: covered.geojson: the geometry: nothing is left: the area is empty
  hostile.dol:1:19: error: the map cannot be read: turned.geojson: the geometry: nothing is left: the area is empty
  hostile.dol:1:19: error: the map cannot be read: tiled.geojson: the geometry: nothing is left: the area is empty
  hostile.dol:1:19: error: the map cannot be read: rounded.geojson: the geometry: nothing is left: the area is empty

A feature that is wrong does not hide the others: it is null, and an error where it is used.

  $ cat > some.geojson <<'EOF'
  > {"type": "FeatureCollection", "features": [
  > {"type": "Feature", "properties": {"name": "bow"}, "geometry": {"type": "Polygon",
  >   "coordinates": [[[0,0],[0.01,0.01],[0.01,0],[0,0.01],[0,0]]]}},
  > {"type": "Feature", "properties": {"name": "spike"}, "geometry": {"type": "Polygon",
  >   "coordinates": [[[-8.7,41.1],[-8.69,41.1],[-8.68,41.1],[-8.69,41.1],[-8.69,41.11],[-8.7,41.11],[-8.7,41.1]]]}},
  > {"type": "Feature", "properties": {"name": "nowhere"}, "geometry": {"type": "Point", "coordinates": []}},
  > {"type": "Feature", "properties": {"name": "buoy"}, "geometry": {"type": "Point", "coordinates": [-8.7, 41.1]}}]}
  > EOF
  $ cat > some.dol <<'EOF'
  > m = map 'some.geojson'
  > message m.buoy in m.spike
  > message m.bow
  > fence outside m
  > fence outside m['bow']
  > EOF
  $ dolphin check some.dol
  some.dol:1:9: warning: some.geojson: 'bow' is null: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    1 | m = map 'some.geojson'
      |         ^^^^^^^^^^^^^^
  some.dol:1:9: warning: some.geojson: feature 2 ('spike'): spikes are cut off, corners that repeat the one before are left out
    1 | m = map 'some.geojson'
      |         ^^^^^^^^^^^^^^
  some.dol:1:9: warning: some.geojson: feature 3 ('nowhere'): it is empty, and left out
    1 | m = map 'some.geojson'
      |         ^^^^^^^^^^^^^^
  some.dol:3:11: error: 'bow' of some.geojson cannot be used: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    3 | message m.bow
      |           ^^^
  some.dol:4:15: error: 'bow' cannot be part of a fence: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    4 | fence outside m
      |               ^
  some.dol:5:17: error: 'bow' of some.geojson cannot be used: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    5 | fence outside m['bow']
      |                 ^^^^^
  some.dol: 3 errors, 3 warnings
  [2]
  $ sed -i "/bow/d; s/fence outside m$/fence outside (m.values() - [null])/" some.dol
  $ dolphin exec some.dol 2>/dev/null | grep says
     0:00  program     says: true
  $ echo "fence outside (map('some.geojson').values() - [null])" > some.dol
  $ dolphin check some.dol 2>&1 | grep warning
  some.dol:1:20: warning: some.geojson: 'bow' is null: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
  some.dol:1:20: warning: some.geojson: feature 2 ('spike'): spikes are cut off, corners that repeat the one before are left out
  some.dol:1:20: warning: some.geojson: feature 3 ('nowhere'): it is empty, and left out
  some.dol: no errors, 3 warnings

The areas of a map, or of a list, keep vehicles out, each by itself; places and lines are left out.

  $ cat > zones.geojson <<'EOF'
  > {"type": "FeatureCollection", "features": [
  > {"type": "Feature", "properties": {"name": "a"}, "geometry": {"type": "Polygon",
  >   "coordinates": [[[-8.71,41.18],[-8.70,41.18],[-8.70,41.19],[-8.71,41.19],[-8.71,41.18]]]}},
  > {"type": "Feature", "properties": {"name": "it's b"}, "geometry": {"type": "Polygon",
  >   "coordinates": [[[-8.73,41.18],[-8.72,41.18],[-8.72,41.19],[-8.73,41.19],[-8.73,41.18]]]}},
  > {"type": "Feature", "properties": {"name": "buoy"}, "geometry": {"type": "Point", "coordinates": [-8.7, 41.1]}}]}
  > EOF
  $ cat > zones.dol <<'EOF'
  > zones = map 'zones.geojson'
  > fence outside FENCE
  > v = pick { count 1 }
  > execute v: imcPlan {
  >   planName 'p'
  >   locate location(41.185, -8.725)
  >   goTo()
  > }
  > EOF
  $ for fence in zones "map('zones.geojson')" "zones.values().findAll { !(it in [zones.buoy]) }" zones.a "([zones.buoy])" \
  >     "([a: zones.a, b: 1])" "([:])" "([zones.a, zones.values()[1]]), margin: 1.m"; do
  >   sed "s/FENCE/$fence/" zones.dol > fenced.dol
  >   dolphin check fenced.dol | head -1
  > done
  fenced.dol:7:3: error: plan 'p': 1.Goto breaks fence outside zones['it\'s b'] (fenced.dol:2) by 419.5 m, at (41.185000, -8.725000)
    7 |   goTo()
      |   ^^^^^^
  fenced.dol: 1 error
  fenced.dol:7:3: error: plan 'p': 1.Goto breaks fence outside map('zones.geojson')['it\'s b'] (fenced.dol:2) by 419.5 m, at (41.185000, -8.725000)
    7 |   goTo()
      |   ^^^^^^
  fenced.dol: 1 error
  fenced.dol:2:38: error: an answer may not contain code { ... }
    2 | fence outside zones.values().findAll { !(it in [zones.buoy]) }
      |                                      ^^^^^^^^^^^^^^^^^^^^^^^^^
  fenced.dol: 1 error
  fenced.dol: no errors
  fenced.dol:2:16: error: fence outside takes areas, but has none
    2 | fence outside ([zones.buoy])
      |                ^^^^^^^^^^^^
  fenced.dol: 1 error
  fenced.dol:2:16: error: fence outside takes areas, and 'b' is a number
    2 | fence outside ([a: zones.a, b: 1])
      |                ^^^^^^^^^^^^^^^^^^
  fenced.dol: 1 error
  fenced.dol:2:16: error: fence outside takes areas, but has none
    2 | fence outside ([:])
      |                ^^^
  fenced.dol: 1 error
  fenced.dol:7:3: error: plan 'p': 1.Goto breaks fence outside(([zones.a, zones.values()[1]])[1]), margin:... (fenced.dol:2) by 420.5 m, at (41.185000, -8.725000)
    7 |   goTo()
      |   ^^^^^^
  fenced.dol: 1 error
  $ cat > zones.fleet <<'EOF'
  > vehicle 'a', { type 'UUV'; at 41.17, -8.725 }
  > fence outside map 'zones.geojson'
  > EOF
  $ sed '/FENCE/d' zones.dol > fleet.dol
  $ dolphin check fleet.dol --fleet zones.fleet | head -1
  fleet.dol:6:3: error: plan 'p': 1.Goto breaks fence outside map('zones.geojson')['it\'s b'] (zones.fleet:2) by 419.5 m, at (41.185000, -8.725000)
    6 |   goTo()
      |   ^^^^^^
  fleet.dol: 1 error

What is wrong with a map that a fleet names is shown too.

  $ echo "fence outside map('some.geojson').spike" >> zones.fleet
  $ printf "v = pick { type 'UUV' }\nrelease v\n" > fleet.dol
  $ dolphin check fleet.dol --fleet zones.fleet
  warning: zones.fleet:3:19: some.geojson: 'bow' is null: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
  warning: zones.fleet:3:19: some.geojson: feature 2 ('spike'): spikes are cut off, corners that repeat the one before are left out
  warning: zones.fleet:3:19: some.geojson: feature 3 ('nowhere'): it is empty, and left out
  fleet.dol: no errors, 3 warnings
  zones.fleet: no errors
  $ echo "fence outside map('some.geojson')" >> zones.fleet
  $ dolphin check fleet.dol --fleet zones.fleet
  zones.fleet:4:15: error: 'bow' cannot be part of a fence: feature 1 ('bow'): a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    4 | fence outside map('some.geojson')
      |               ^^^^^^^^^^^^^^^^^^^
  zones.fleet: 1 error
  fleet.dol: no errors
  [2]

A map of 160 areas with 86,000 corners takes no time: limits of a test allow for other load.

  $ python3 - <<'EOF'
  > import json, math
  > def ring(x, y):
  >     turns = [2 * math.pi * k / 540 for k in range(540)]
  >     corners = [[x + (0.05 + 0.005 * math.sin(7 * t)) * math.cos(t), y + 0.05 * math.sin(t)] for t in turns]
  >     return corners + corners[:1]
  > features = [{"type": "Feature", "properties": {"name": str(i)},
  >              "geometry": {"type": "Polygon", "coordinates": [ring(-8.7 + 0.3 * (i % 13), 42 + 0.3 * (i // 13))]}}
  >             for i in range(160)]
  > json.dump({"type": "FeatureCollection", "features": features}, open("large.json", "w"))
  > EOF
  $ echo "zones = map 'large.json'" > large.dol
  $ sed 1d zones.dol | sed 's/FENCE/zones/' >> large.dol
  $ timeout 10 sh -c 'ulimit -t 3; dolphin exec large.dol' | tail -1
    17:31  program     ends

A map of another program that is damaged, or that says that it is elsewhere.

  $ python3 - <<'EOF'
  > import zipfile
  > with zipfile.ZipFile("stored.kmz", "w") as z:
  >     z.writestr("doc.kml", "<kml><Placemark><Point><coordinates>-8,41</coordinates></Point></Placemark></kml>")
  > text = open("stored.kmz", "rb").read()
  > open("changed.kmz", "wb").write(text.replace(b"-8,41", b"-8,42"))
  > EOF
  $ echo '{"type": "Point", "coordinates": [0, 0], "crs": {"type": "name", "properties": {"name": "EPSG:3857"}}}' > web.json
  $ for file in changed.kmz web.json; do
  >   echo "x = map '$file'" > hostile.dol
  >   dolphin check hostile.dol | sed -n 's/.*cannot be read: //p'
  > done
  hostile.dol:1:9: error: the map cannot be read: changed.kmz: 'doc.kml' in this archive is damaged: its checksum is another
    1 | x = map 'changed.kmz'
      |         ^^^^^^^^^^^^^
  hostile.dol:1:9: error: the map cannot be read: web.json: its coordinates are in the system EPSG:3857: they have to be in WGS 84, longitude first (EPSG:4326)
    1 | x = map 'web.json'
      |         ^^^^^^^^^^

Around a pole and across the meridian of 180 degrees.

  $ for file in pole antimeridian; do
  >   echo "m = map '$file.geojson'
  >   message m['area 1'].size.round()" > round.dol
  >   dolphin exec round.dol 2>&1 | grep -E 'says|error'
  > done
     0:00  program     says: 1620621
     0:00  program     says: 2461814
