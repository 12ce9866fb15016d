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
  dolphin: harbour.dol is not the text that this run was of, or has changed since: places are not compared
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
  none.kmz: there is no *.kml in this archive
  entity.kml: line 2, column 26: this is no XML: unknown entity reference (b)
  external.kml: line 2, column 32: this is no XML: unknown entity reference (x)
  laughs.kml: line 2, column 27: this is no XML: unknown entity reference (l9)
  laughs.gpx: line 2, column 20: this is no XML: unknown entity reference (l9)
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
  >   (ulimit -v 4000000; dolphin check hostile.dol) 2>&1 | sed -n 's/.*cannot be read: //p'
  > done
  ringless.geojson: the geometry: a polygon has a ring of positions
  cornerless.geojson: the geometry: a polygon has three corners or more that differ, not 0
  flat.geojson: the geometry: the corners of a polygon are not on one line
  nothing.geojson: the geometry: a polygon has corners
  bow.geojson: the geometry: a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
  beyond.geojson: the geometry, position 3: longitude 240 is not from -180 to 180 degrees
  world.geojson: the geometry: an area reaches at most 200 km from its middle
  endless.geojson: the geometry: longitude inf is not from -180 to 180 degrees
  lattice.geojson: the geometry: an area has 5000 corners at most, not 10000

Around a pole and across the meridian of 180 degrees.

  $ for file in pole antimeridian; do
  >   echo "m = map '$file.geojson'
  >   message m['area 1'].size.round()" > round.dol
  >   dolphin exec round.dol 2>&1 | grep -E 'says|error'
  > done
     0:00  program     says: 1620621
     0:00  program     says: 2461814
