Fences: where vehicles may be, how deep and high, how near to each other.

  $ cat > basin.dol <<'END'
  > quay = location 41.1850, -8.7060
  > basin = polygon([quay, quay.displace(0, 500), quay.displace(300, 500), quay.displace(300, 0)])
  > END
  $ fenced() { cp basin.dol $1.dol; cat >> $1.dol; }

What breaks a fence wherever its vehicle is, is told before anything runs, at the maneuver: segments, circles, rows, depths,
heights, points of a way.

  $ fenced broken <<'END'
  > fence inside basin, margin: 10.m
  > fence outside quay.displace(150, 250) ^ 30
  > fence depth 12.m
  > fence height 100.m
  > plans = [
  >   imcPlan {
  >     planName 'loiters'
  >     locate quay.displace(50, 50)
  >     goTo()
  >     loiter radius: 45
  >   },
  >   imcPlan {
  >     planName 'crosses'
  >     locate quay.displace(150, 50)
  >     goTo()
  >     goTo location: quay.displace(150, 450)
  >   },
  >   imcPlan { planName 'rows'; locate quay.displace(200, 100); rows bearing: 90, length: 300, width: 100 },
  >   imcPlan {
  >     planName 'deep'
  >     speed 1.5, Speed.Units.METERS_PS
  >     locate quay.displace(50, 50)
  >     yoyo max_depth: 15, min_depth: 2
  >   },
  >   imcPlan { planName 'low'; locate quay.displace(50, 50); z 3, Z.Units.ALTITUDE; goTo() },
  >   imcPlan { planName 'high'; locate quay.displace(50, 50); z 130, Z.Units.HEIGHT; goTo() },
  >   imcPlan {
  >     planName 'follows'
  >     locate quay.displace(50, 50)
  >     followPath points: [[0, 0], [10, 20, 11]]
  >   },
  >   mission { name 'flies'; takeOff 20; goPos quay.displace(20, 20); move 0, 10, 90; loiterTurns 2, radius: 25 },
  >   imcPlan { planName 'good'; locate quay.displace(50, 50); goTo(); loiter radius: 40 }
  > ]
  > END
  $ dolphin check broken.dol 2>&1 | grep -A2 error
  broken.dol:12:5: error: plan 'loiters': 2.Loiter breaks fence inside basin, margin: 10.m (broken.dol:3) by 5.0 m, at (41.185450, -8.705404)
    12 |     loiter radius: 45
       |     ^^^^^^^^^^^^^^^^^
  broken.dol:18:5: error: plan 'crosses': 2.Goto breaks fence outside quay.displace(150, 250) ^ 30 (broken.dol:4) by 30.0 m, at (41.186351, -8.703020)
    18 |     goTo location: quay.displace(150, 450)
       |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  broken.dol:25:5: error: plan 'deep': 1.YoYo breaks fence depth 12.m (broken.dol:5) by 3.0 m
    25 |     yoyo max_depth: 15, min_depth: 2
       |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  broken.dol:27:82: error: plan 'low': 1.Goto may break fence depth 12.m (broken.dol:5): its z is above the ground, and how deep that is is not known
    27 |   imcPlan { planName 'low'; locate quay.displace(50, 50); z 3, Z.Units.ALTITUDE; goTo() },
       |                                                                                  ^^^^^^
  broken.dol:28:83: error: plan 'high': 1.Goto breaks fence height 100.m (broken.dol:6) by 30.0 m
    28 |   imcPlan { planName 'high'; locate quay.displace(50, 50); z 130, Z.Units.HEIGHT; goTo() },
       |                                                                                   ^^^^^^
  broken.dol:32:5: error: plan 'follows': 1.FollowPath breaks fence depth 12.m (broken.dol:5) by 1.0 m
    32 |     followPath points: [[0, 0], [10, 20, 11]]
       |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  broken.dol:34:3: error: plan 'flies': 4.loiterTurns breaks fence inside basin, margin: 10.m (broken.dol:3) by 15.0 m, at (41.185180, -8.705642)
    34 |   mission { name 'flies'; takeOff 20; goPos quay.displace(20, 20); move 0, 10, 90; loiterTurns 2, radius: 25 }...
       |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  broken.dol: 7 errors

A fence is known before the program runs, and of its kind.

  $ wrong() { echo "$1" | fenced wrong; dolphin check wrong.dol 2>&1 | grep -v '^wrong.dol: '; }
  $ wrong 'fence inside 3'
  wrong.dol:3:14: error: fence inside takes an area, not a number
    3 | fence inside 3
      |              ^
  $ wrong 'fence insde basin'
  wrong.dol:3:7: error: unknown fence 'insde'
    3 | fence insde basin
      |       ^^^^^
      hint: did you mean 'inside'?
  $ wrong 'fence'
  wrong.dol:3:1: error: fence declares a limit that vehicles must keep
    3 | fence
      | ^^^^^
      hint: write fence inside AREA, fence outside AREA, fence depth 30.m, fence height 120.m or fence distance 50.m
  wrong.dol:3:1: warning: this has no effect: its value is not used
    3 | fence
      | ^^^^^
  $ wrong 'fence depth(-3)'
  wrong.dol:3:13: error: the depth of a fence is a number of metres from 0 on, not -3
    3 | fence depth(-3)
      |             ^^
  $ wrong 'fence distance 0.m'
  wrong.dol:3:16: error: the distance of a fence is a number of metres above 0, not 0
    3 | fence distance 0.m
      |                ^^^
  $ wrong 'fence distance 3.m, margin: 2.m'
  wrong.dol:3:21: error: fence distance takes no margin: vehicles keep the distance itself
    3 | fence distance 3.m, margin: 2.m
      |                     ^^^^^^
  $ wrong 'fence inside basin, margin: 0 - 3.m'
  wrong.dol:3:29: error: the margin of a fence is a number of metres from 0 on, not -3
    3 | fence inside basin, margin: 0 - 3.m
      |                             ^^^^^^^
  $ wrong 'fence inside basin, 3.m'
  wrong.dol:3:21: error: after a comma, fence takes its margin
    3 | fence inside basin, 3.m
      |                     ^^^
      hint: as in fence inside harbour, margin: 20.m
  $ wrong 'fence inside basin, margn: 3.m'
  wrong.dol:3:21: error: fence has no argument 'margn': it has margin
    3 | fence inside basin, margn: 3.m
      |                     ^^^^^
      hint: as in fence inside harbour, margin: 20.m
  $ wrong 'x = fence(inside(basin))'
  wrong.dol:3:5: error: fence declares a limit that vehicles must keep: it stands by itself at the top of the program
    3 | x = fence(inside(basin))
      |     ^^^^^^^^^^^^^^^^^^^^
  $ wrong 'if (true) { fence depth 3.m }'
  wrong.dol:3:13: error: fence declares a limit that vehicles must keep: it stands by itself at the top of the program
    3 | if (true) { fence depth 3.m }
      |             ^^^^^^^^^^^^^^^
  $ wrong 'fence inside nowhere'
  wrong.dol:3:14: error: unknown name 'nowhere'
    3 | fence inside nowhere
      |              ^^^^^^^
  $ wrong 'for (i in 1..2) { n = i }; fence depth n'
  wrong.dol:3:40: error: the value of 'n' is not known before the program runs
    3 | for (i in 1..2) { n = i }; fence depth n
      |                                        ^
  $ wrong 'def f() { return 3 }; fence depth f()'
  wrong.dol:3:35: error: f(...) is not known before the program runs
    3 | def f() { return 3 }; fence depth f()
      |                                   ^^^
  $ wrong 'fence inside polygon([quay, quay.displace(9, 9), quay.displace(9, 0), quay.displace(0, 9)])'
  wrong.dol:3:14: error: a polygon does not cross itself: its sides from corner 1 and from corner 3 meet
    3 | fence inside polygon([quay, quay.displace(9, 9), quay.displace(9, 0), quay.displace(0, 9)])
      |              ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^

Maps and parameters are known, and who calls something else 'fence' has no fences.

  $ cat > harbour.geojson <<'END'
  > {"type": "Feature", "properties": {"name": "limits"}, "geometry": {"type": "Polygon", "coordinates":
  >  [[[-8.71, 41.18], [-8.70, 41.18], [-8.70, 41.19], [-8.71, 41.19], [-8.71, 41.18]]]}}
  > END
  $ cat > map.dol <<'END'
  > harbour = map 'harbour.geojson'
  > parameter margin = 10
  > fence inside harbour.limits, margin: margin
  > plan = imcPlan { planName 'edge'; locate 41.185, -8.7003; goTo() }
  > END
  $ dolphin check map.dol
  map.dol: no errors
  $ dolphin check map.dol --set margin=30 2>&1 | head -1
  map.dol:4:59: error: plan 'edge': 1.Goto breaks fence inside harbour.limits, margin: margin (map.dol:3) by 4.8 m, at (41.185000, -8.700300)
  $ echo "def fence(x) { return x }; y = fence 3; message y" > own.dol
  $ dolphin exec own.dol
     0:00  program     says: 3
     0:00  program     ends

What is not known before is refused at its start, and who breaks a fence on the way is stopped: failures of the task,
that a handler may ignore. Trace and journal are those of any other run.

  $ fenced late <<'END'
  > fence inside basin
  > fence distance 30.m
  > def go(name, north, east) { imcPlan { planName name; locate quay.displace(north, east); goTo() } }
  > vs = pick { type 'UUV'; count 2 }
  > one = vs[0]
  > other = vs[1]
  > def tried(t) { watch t onError { e -> ignore() } }
  > execute tried(go('out', 310, 20)[one])
  > execute tried(go('west', 100, 100)[one]) | tried(go('east', 100, 400)[other])
  > execute tried(go('meets', 250, 400)[one]) | tried(go('crosses', 200, 100)[other])
  > execute tried(task('drift')[one])
  > execute tried(go('back', 100, 50)[one])
  > execute task('stays')[one] | tried(task('nears')[other])
  > END
  $ cat > late.fleet <<'END'
  > vehicle 'a', { type 'UUV'; at 41.1852, -8.7055 }
  > vehicle 'b', { type 'UUV'; at 41.1852, -8.7030 }
  > plan 'drift', { duration 10.min; at 41.1840, -8.7050 }
  > plan 'stays', { duration 20.min; at 41.1859, -8.7054 }
  > plan 'nears', { duration 20.min; at 41.1859, -8.7054 }
  > END
  $ dolphin exec late.dol --journal late.run
     0:00  program     picks a, b
     0:00  a           starts out
     0:00  a           fails in out: not started: the way to 1.Goto breaks fence inside basin (late.dol:3) by 10.0 m, at (41.187791, -8.705762)
     0:00  a           starts west
     0:00  b           starts east
     1:04  a           ends west
     1:51  b           ends east
     1:51  a           starts meets
     1:51  b           starts crosses
     1:51  b           fails in crosses: not started: the way to 1.Goto comes as near as 0.0 m to the way to 1.Goto of plan 'meets' of a, at (41.186441, -8.703378): it breaks fence distance 30.m (late.dol:4)
     5:35  a           ends meets
     5:35  a           starts drift
     9:17  a           fails in drift: stopped: the vehicle breaks fence inside basin (late.dol:3) by 0.3 m, at (41.184998, -8.703844, -0.6 m)
     9:17  a           starts back
    11:06  a           ends back
    11:06  a           starts stays
    11:06  b           starts nears
    14:41  a           fails in stays: stopped: a and b are 28.5 m apart, at (41.185900, -8.705400): they break fence distance 30.m (late.dol:4) by 1.5 m
    14:41  b           stops nears
    14:41  program     releases a, b
    14:41  program     fails: stays failed on a: stopped: a and b are 28.5 m apart, at (41.185900, -8.705400): they break fence distance 30.m (late.dol:4) by 1.5 m
  late.dol:15:9: error: stays failed on a: stopped: a and b are 28.5 m apart, at (41.185900, -8.705400): they break fence distance 30.m (late.dol:4) by 1.5 m
    15 | execute task('stays')[one] | tried(task('nears')[other])
       |         ^^^^^^^^^^^^^
  [1]
  $ dolphin trace check late.dol late.run
  late.run: a run, of 25 transitions in 14:41; failed: stays failed on a: stopped: a and b are 28.5 m apart, at (41.185900, -8.705400): they break fence distance 30.m (late.dol:4) by 1.5 m

Depths and heights are watched as positions are, of plans that vehicles know by name too. Who comes from too deep may
come up.

  $ cat > levels.dol <<'END'
  > fence depth 20.m
  > fence height 100.m
  > diver = pick { type 'UUV' }
  > plane = pick { type 'UAV' }
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > execute tried(task('shallow')[diver])
  > execute tried(task('deep')[diver])
  > execute imcPlan { planName 'up'; locate 41.1852, -8.7055; z 0; goTo() }[diver]
  > execute task('climb')[plane]
  > END
  $ cat > levels.fleet <<'END'
  > vehicle 'a', { type 'UUV'; at 41.1852, -8.7055 }
  > vehicle 'b', { type 'UAV'; at 41.1852, -8.7055; speed 20.0 }
  > plan 'shallow', { duration 10.min; at 41.1859, -8.7054, -19 }
  > plan 'deep', { duration 10.min; at 41.1859, -8.7054, -40 }
  > plan 'climb', { duration 10.min; at 41.1900, -8.7054, 150 }
  > END
  $ dolphin exec levels.dol --journal levels.run
     0:00  program     picks a
     0:00  program     picks b
     0:00  a           starts shallow
    10:00  a           ends shallow
    10:00  a           starts deep
    10:27  a           fails in deep: stopped: the vehicle breaks fence depth 20.m (levels.dol:1) by 0.7 m, at (41.185563, -8.705448, -20.7 m)
    10:27  program     says: deep failed on a: stopped: the vehicle breaks fence depth 20.m (levels.dol:1) by 0.7 m, at (41.185563, -8.705448, -20.7 m)
    10:27  a           starts up
    10:54  a           ends up
    10:54  b           starts climb
    11:12  b           fails in climb: stopped: the vehicle breaks fence height 100.m (levels.dol:2) by 1.3 m, at (41.188441, -8.705432, 101.3 m)
    11:12  program     releases a, b
    11:12  program     fails: climb failed on b: stopped: the vehicle breaks fence height 100.m (levels.dol:2) by 1.3 m, at (41.188441, -8.705432, 101.3 m)
  levels.dol:9:9: error: climb failed on b: stopped: the vehicle breaks fence height 100.m (levels.dol:2) by 1.3 m, at (41.188441, -8.705432, 101.3 m)
    9 | execute task('climb')[plane]
      |         ^^^^^^^^^^^^^
  [1]
  $ dolphin trace check levels.dol levels.run
  levels.run: a run, of 16 transitions in 11:12; failed: climb failed on b: stopped: the vehicle breaks fence height 100.m (levels.dol:2) by 1.3 m, at (41.188441, -8.705432, 101.3 m)

To the explorer and to dolphin time any plan may fail where there are fences.

  $ fenced kept <<'END'
  > fence depth 50.m
  > v = pick { type 'UUV' }
  > execute task('drift')[v]
  > END
  $ cp late.fleet kept.fleet
  $ dolphin explore kept.dol | grep '^no unhandled'
  no unhandled error: violated after 5 steps: an unhandled error ends the program
  no unhandled error: a shortest run in which an unhandled error ends the program
  $ dolphin time kept.dol | head -3
  completed: 10:00 at the earliest, 10:00 at the latest
  failed: 0:00 at the earliest, 10:00 at the latest
  task   vehicle  starts  ends   fails          where
  $ sed 's/^fence.*//' kept.dol > open.dol; cp late.fleet open.fleet
  $ dolphin explore open.dol | grep '^no unhandled'
  no unhandled error: holds
  $ dolphin time open.dol | head -3
  completed: 10:00 at the earliest, 10:00 at the latest
  task   vehicle  starts  ends   where
  drift  a        0:00    10:00  open.dol:5

The operator's fences stand in the fleet, and hold for every program: with its own, or without. Maps may name them.

  $ cat > open.dol <<'END'
  > v = pick { type 'UUV' }
  > def to(name, north, east) { imcPlan { planName name; locate location(41.185, -8.706).displace(north, east); goTo() } }
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > execute tried(to('near', 100, 100)[v])
  > execute tried(to('far', 700, 100)[v])
  > END
  $ cat > basin.geojson <<'END'
  > {"type":"Feature","properties":{"name":"basin"},"geometry":{"type":"Polygon","coordinates":
  >  [[[-8.706,41.185],[-8.700,41.185],[-8.700,41.188],[-8.706,41.188],[-8.706,41.185]]]}}
  > END
  $ cat > open.fleet <<'END'
  > vehicle 'a', { type 'UUV'; at 41.1852, -8.7055 }
  > fence inside map('basin.geojson').basin, margin: 5.m
  > fence depth 12.m
  > END
  $ dolphin check open.dol
  open.dol: no errors
  open.fleet: no errors
  $ dolphin exec open.dol --journal open.run | grep -A1 ' says'
     1:04  program     says: far failed on a: not started: the way to 1.Goto breaks fence inside map('basin.geojson').basin, margin: 5.m (open.fleet:2) by 371.8 m, at (41.191303, -8.704808)
     1:04  program     releases a
  $ dolphin trace check open.dol open.run
  open.run: a run, of 9 transitions in 1:04; completed

Any plan may fail then: where nobody handles that, exploring says so.

  $ printf "v = pick { type 'UUV' }\nexecute task('drift')[v]\n" > drift.dol
  $ dolphin explore drift.dol --fleet open.fleet | grep 'unhandled'
  no unhandled error: violated after 5 steps: an unhandled error ends the program
  no unhandled error: a shortest run in which an unhandled error ends the program
  $ grep -v fence open.fleet > free.fleet
  $ dolphin explore drift.dol --fleet free.fleet | grep 'unhandled'
  no unhandled error: holds

What is known before the run is told with the program, of each command that takes a fleet.

  $ cat > known.dol <<'END'
  > v = pick { type 'UUV' }
  > execute imcPlan { planName 'deep'; locate location(41.186, -8.705); z 20, Z.Units.DEPTH; goTo() }[v]
  > END
  $ dolphin check known.dol --fleet open.fleet
  known.dol:2:90: error: plan 'deep': 1.Goto breaks fence depth 12.m (open.fleet:3) by 8.0 m
    2 | execute imcPlan { planName 'deep'; locate location(41.186, -8.705); z 20, Z.Units.DEPTH; goTo() }[v]
      |                                                                                          ^^^^^^
  known.dol: 1 error
  open.fleet: no errors
  [2]
  $ for c in exec explore time plan lts 'tla --output x'; do dolphin $c known.dol --fleet open.fleet 2>&1 | grep -c 'breaks fence depth 12.m (open.fleet:3)'; done
  1
  1
  1
  1
  1
  1
  $ dolphin check known.dol
  known.dol: no errors

A fleet without fences: nothing stands against the plan.

  $ dolphin exec known.dol --fleet free.fleet | tail -1
     1:05  program     ends

What is wrong with a fence of a fleet is told at its place; so are its variables, of which fleets have none.

  $ echo "fence inside basin" > wrong.fleet; echo "fence outside map('nowhere.kml').rock" >> wrong.fleet
  $ dolphin check open.dol --fleet wrong.fleet
  wrong.fleet:1:14: error: unknown name 'basin'
    1 | fence inside basin
      |              ^^^^^
      hint: a fleet has no variables: write the area itself, or map('harbour.geojson').basin
  wrong.fleet:2:19: error: the map cannot be read: nowhere.kml: No such file or directory
    2 | fence outside map('nowhere.kml').rock
      |                   ^^^^^^^^^^^^^
  wrong.fleet: 2 errors
  open.dol: no errors
  [2]

The contents of a fleet's maps are part of it: a run is not resumed with others.

  $ sed -i 's/41.188/41.189/g' basin.geojson
  $ head -n 8 open.run > half.run; dolphin exec --resume half.run open.dol
  dolphin: open.fleet: this is not the fleet that the run was on, or it has changed since
  [2]

Plans that may run side by side and come nearer than vehicles may: dolphin explore tells all pairs, dolphin time those that
run at the same time. Of what nobody knows nothing is claimed.

  $ cat > lanes.dol <<'EOF'
  > quay = location 41.1850, -8.7060
  > fence distance 30.m
  > def lane(name, north) {
  >     imcPlan {
  >         planName name
  >         locate quay.displace(north, 0)
  >         speed 1.5, Speed.Units.METERS_PS
  >         goTo()
  >         goTo location: quay.displace(north, 300)
  >     }
  > }
  > parameter gap = 20
  > vs = pick { type 'UUV'; count 2 }
  > def tried(t) { watch t onError { e -> ignore() } }
  > execute tried(lane('south', 50)[vs[0]]) | tried(lane('north', 50 + gap)[vs[1]])
  > EOF
  $ cat > lanes.fleet <<'EOF'
  > vehicle 'n1', { type 'UUV'; at 41.1852, -8.7055 }
  > vehicle 'n2', { type 'UUV'; at 41.1852, -8.7055 }
  > plan 'drift', { duration 10.min }
  > EOF
  $ explored() { dolphin explore "$@" > found; echo "status $?"; grep -A9 '^fence' found | sed 's/^[0-9]* states.*; \([0-9]* states for plans\)/\1/'; }
  $ explored lanes.dol
  status 1
  fence distance 30.m: violated after 5 steps: plans run side by side whose ways come nearer to each other
  13 states for plans side by side
  
  plans that may run side by side:
    lanes.dol:4:5: plan 'south' on n1, beside lanes.dol:4:5: plan 'north' on n2: 20.0 m between 1.Goto and 1.Goto, at (41.185450, -8.706000)
  
  fence distance 30.m: a shortest run in which plans run side by side whose ways come nearer to each other
      program                         n1            n2            where         variables
  1   pick(2 vehicles of type 'UUV')                              lanes.dol:13  quay = (41.185000, -8.706000), gap = 20
  2   picks n1, n2                                                lanes.dol:13
  3   execute                                                     lanes.dol:15  vs = [n1, n2]
  4                                   starts south                lanes.dol:4
  5                                                 starts north  lanes.dol:4
  $ explored lanes.dol --set gap=40
  status 0
  fence distance 30.m: holds
  13 states for plans side by side
  $ dolphin explore lanes.dol --json | python3 -c '
  > import json, sys
  > v = json.load(sys.stdin)["verdicts"][-1]
  > print(v["property"], v["verdict"], v["run"], json.dumps(v["pairs"]))'
  fence distance 30.m violated ["pick(2 vehicles of type 'UUV')", 'bind(n1, n2)', 'execute', 'start(n1, south)', 'start(n2, north)'] [{"one": {"plan": "south", "vehicle": "n1", "at": "lanes.dol:4:5", "maneuver": "1.Goto"}, "other": {"plan": "north", "vehicle": "n2", "at": "lanes.dol:4:5", "maneuver": "1.Goto"}, "metres": 20.0, "latitude": 41.1854502, "longitude": -8.706}]
  $ dolphin time lanes.dol | grep -A3 '^fence\|^plans'
  fence distance 30.m: violated: plans run side by side whose ways come nearer to each other
  task   vehicle  starts  ends                  fails             where
  south  n1       0:00    3:30.191 to 4:16.901  0:00 to 4:16.901  lanes.dol:4
  north  n2       0:00    3:38.153 to 4:26.632  0:00 to 4:26.632  lanes.dol:4
  --
  plans that may run side by side:
    lanes.dol:4:5: plan 'south' on n1, beside lanes.dol:4:5: plan 'north' on n2: 20.0 m between 1.Goto and 1.Goto, at (41.185450, -8.706000)
  
  a run that ends last:
  $ dolphin explore lanes.dol --sarif found.sarif --junit found.xml > found; grep -c least-distance found.sarif; grep -c 'type="fence distance 30.m"' found.xml
  2
  1

By its order 'south' may run beside 'north', by time it is over before: so dolphin time finds nothing.

  $ sed 's/| tried(/| idle(20.min) >> tried(/' lanes.dol > later.dol
  $ explored later.dol --fleet lanes.fleet
  status 1
  fence distance 30.m: violated after 6 steps: plans run side by side whose ways come nearer to each other
  16 states for plans side by side
  
  plans that may run side by side:
    later.dol:4:5: plan 'south' on n1, beside later.dol:4:5: plan 'north' on n2: 20.0 m between 1.Goto and 1.Goto, at (41.185450, -8.706000)
  
  fence distance 30.m: a shortest run in which plans run side by side whose ways come nearer to each other
      program                         n1            n2            where         variables
  1   pick(2 vehicles of type 'UUV')                              later.dol:13  quay = (41.185000, -8.706000), gap = 20
  2   picks n1, n2                                                later.dol:13
  3   execute                                                     later.dol:15  vs = [n1, n2]
  4                                   starts south                later.dol:4
  5   timeout                                                     later.dol:15
  6                                                 starts north  later.dol:4
  $ dolphin time later.dol --fleet lanes.fleet > found; echo "status $?"; grep '^fence' found
  status 0
  fence distance 30.m: holds

Where vehicles know a plan by its name only, at an unknown distance it comes.

  $ sed "s/lane('south', 50)/task('drift')/" lanes.dol > drift.dol
  $ explored drift.dol --fleet lanes.fleet
  status 3
  fence distance 30.m: inconclusive, the distance between 'drift' and 'north', which may run side by side, is unknown
  13 states for plans side by side
  
  plans that may run side by side:
    drift.dol:15:15: plan 'drift' on n1, beside drift.dol:4:5: plan 'north' on n2: distance unknown
  $ dolphin time drift.dol --fleet lanes.fleet > found; echo "status $?"; grep -A2 '^fence\|^plans' found
  status 3
  fence distance 30.m: inconclusive, plans run side by side at an unknown distance
  task   vehicle  starts  ends                  fails             where
  drift  n1       0:00    10:00                 0:00 to 10:00     drift.dol:15
  --
  plans that may run side by side:
    drift.dol:15:15: plan 'drift' on n1, beside drift.dol:4:5: plan 'north' on n2: distance unknown
  

One after the other they come as near as they like.

  $ sed 's/ | tried/ >> tried/' lanes.dol > after.dol
  $ explored after.dol --fleet lanes.fleet
  status 0
  fence distance 30.m: holds
  9 states for plans side by side

A bound that is met before all states were seen is told.

  $ explored lanes.dol --set gap=40 --max-states 5
  status 3
  fence distance 30.m: inconclusive, the bound on states was met
  6 states for plans side by side
