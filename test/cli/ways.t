Where simulated vehicles go, and how deep: they fly the z of their plans. Divers sink and rise half a metre a second,
what flies three, and boats stay on the surface.

  $ cat > levels.fleet <<'END'
  > vehicle 'diver', { type 'UUV'; at 41.1850, -8.7060; speed 1.0 }
  > vehicle 'plane', { type 'UAV'; at 41.1850, -8.7060; speed 10.0 }
  > vehicle 'boat', { type 'USV'; at 41.1850, -8.7060; speed 1.0 }
  > END
  $ cat > levels.dol <<'END'
  > diver = pick { type 'UUV' }
  > plane = pick { type 'UAV' }
  > boat = pick { type 'USV' }
  > p = location 41.1850, -8.7060
  > dive = imcPlan {
  >     planName 'dive'
  >     z 10, Z.Units.DEPTH
  >     locate p.displace(0, 60)
  >     goTo()
  >     yoyo location: p.displace(0, 160), max_depth: 16, min_depth: 4, pitch: 30.degrees
  >     popup waitAtSurface: true, duration: 60
  > }
  > fly = mission { name 'fly'; takeOff 60; moveFromHome 300, 0; returnHomeAndLand() }
  > sail = imcPlan { planName 'sail'; z 10, Z.Units.DEPTH; locate p.displace(0, 100); goTo() }
  > execute dive[diver] | fly[plane] | sail[boat]
  > END
  $ dolphin exec levels.dol --journal levels.run
     0:00  program     picks diver
     0:00  program     picks plane
     0:00  program     picks boat
     0:00  diver       starts dive
     0:00  plane       starts fly
     0:00  boat        starts sail
     1:00  plane       ends fly
     1:40  boat        ends sail
     3:40  diver       ends dive
     3:40  program     releases diver, plane, boat
     3:40  program     ends
  $ dolphin trace check levels.dol levels.run
  levels.run: a run, of 14 transitions in 3:40; completed
  $ heights() { dolphin trace export levels.run --to csv | awk -F, -v v="$1" '$3 == v { print $1, $7 }'; }
  $ heights diver | awk '$1 % 20 == 0'
  0 0
  20 -10
  40 -10
  60 -10
  80 -12
  100 -6
  120 -16
  140 -6
  160 -12
  180 -2
  200 0
  220 0
  $ heights plane | awk '$1 % 10 == 0'
  0 0
  10 30
  40 30
  50 0
  $ heights boat | awk '$2 != 0'

The picture of the run has a chart of heights, and depths are in the journal.

  $ dolphin trace draw levels.run -o levels.svg && grep -o '>[-0-9]* m<' levels.svg | sort -u
  >-20 m<
  >0 m<
  >100 m<
  >20 m<
  >40 m<
  >60 m<
  $ grep -c '"depth":' levels.run
  36

A plan of many points is drawn as it is planned: of 3,000, journals leave out those on the way between others.

  $ cat > long.dol <<'END'
  > v = pick { id 'diver' }
  > points = []
  > for (i in 0..1499) { points = points << [i * 0.1, 0] }
  > for (i in 0..1499) { points = points << [150, i * 0.1] }
  > points = points << [150, 151] << [153, 151] << [153, 0]
  > execute imcPlan { planName 'long'; locate location(41.1850, -8.7060); followPath points: points }
  > END
  $ dolphin exec long.dol --fleet levels.fleet --journal long.run
     0:00  program     picks diver
     0:00  diver       starts long
     7:34  diver       ends long
     7:34  program     releases diver
     7:34  program     ends
  $ dolphin trace check long.dol long.run
  long.run: a run, of 8 transitions in 7:34; completed
  $ grep -o '"ways":{[^}]*}' long.run | tr -s '[]' '\n\n' | grep '^[0-9]'
  41.185,-8.706
  41.1858995,-8.706
  41.1863507,-8.706
  41.1863507,-8.7054052
  41.1863506,-8.7042133
  41.1863506,-8.7042002
  41.1863777,-8.7042002
  41.1863777,-8.706
