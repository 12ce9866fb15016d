Fences over an adapter: what breaks one is not started; a vehicle that is seen beyond one is stopped, and its task fails.

  $ cat > m.dol <<'EOF'
  > quay = location 41.1850, -8.7060
  > fence inside quay ^ 200.m
  > def go(name, metres) { imcPlan { planName name; locate quay.displace(metres, 0); goTo() } }
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > v = pick { type 'UAV' }
  > execute tried(go('near', 100)[v])
  > execute tried(go('far', 300)[v])
  > execute tried(task('drift')[v])
  > execute go('home', 20)[v]
  > execute task('drift')[v]
  > EOF
  $ cat > vehicles.fleet <<'EOF'
  > vehicle 'uav-1', { type 'UAV'; at 41.1850, -8.7060; speed 20.0 }
  > plan 'drift', { duration 10.min; at 41.3000, -8.7060 }
  > EOF
  $ timeout 300 dolphin exec m.dol --journal m.run --platform 'dolphin sim vehicles.fleet --platform --speed 20' > log 2> err
  [1]
  $ cut -c 10- log | grep -E '  (picks|starts|ends|fails|says|releases)' | sed 's/ by .*//'
  program     picks uav-1
  uav-1       starts near
  uav-1       ends near
  uav-1       starts far
  uav-1       fails in far: not started: the way to 1.Goto breaks fence inside quay ^ 200.m (m.dol:2)
  program     says: far failed on uav-1: not started: the way to 1.Goto breaks fence inside quay ^ 200.m (m.dol:2)
  uav-1       starts drift
  uav-1       fails in drift: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  program     says: drift failed on uav-1: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  uav-1       starts home
  uav-1       ends home
  uav-1       starts drift
  uav-1       fails in drift: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  program     releases uav-1
  program     fails: drift failed on uav-1: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  $ dolphin trace check m.dol m.run | sed 's/, of [^;]*;/;/; s/ by .*//'
  m.run: a run; failed: drift failed on uav-1: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)

Depths and heights are watched too: what an adapter tells of them, else the height above the ellipsoid.

  $ cat > levels.dol <<'EOF'
  > fence depth 20.m
  > fence height 100.m
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > diver = pick { type 'UUV' }
  > plane = pick { type 'UAV' }
  > execute tried(task('dive')[diver])
  > execute task('climb')[plane]
  > EOF
  $ cat > levels.fleet <<'EOF'
  > vehicle 'uuv-1', { type 'UUV'; at 41.1850, -8.7060; speed 5.0 }
  > vehicle 'uav-1', { type 'UAV'; at 41.1850, -8.7060; speed 20.0 }
  > plan 'dive', { duration 10.min; at 41.1900, -8.7060, -60 }
  > plan 'climb', { duration 10.min; at 41.2100, -8.7060, 300 }
  > EOF
  $ timeout 300 dolphin exec levels.dol --journal levels.run \
  >   --platform 'dolphin sim levels.fleet --platform --speed 20' > log 2> err
  [1]
  $ cut -c 10- log | grep -E '  (picks|starts|ends|fails|says|releases)' | sed 's/ by .*//'
  program     picks uuv-1
  program     picks uav-1
  uuv-1       starts dive
  uuv-1       fails in dive: stopped: the vehicle breaks fence depth 20.m (levels.dol:1)
  program     says: dive failed on uuv-1: stopped: the vehicle breaks fence depth 20.m (levels.dol:1)
  uav-1       starts climb
  uav-1       fails in climb: stopped: the vehicle breaks fence height 100.m (levels.dol:2)
  program     releases uuv-1, uav-1
  program     fails: climb failed on uav-1: stopped: the vehicle breaks fence height 100.m (levels.dol:2)
  $ dolphin trace check levels.dol levels.run | sed 's/, of [^;]*;/;/; s/ by .*//'
  levels.run: a run; failed: climb failed on uav-1: stopped: the vehicle breaks fence height 100.m (levels.dol:2)

A run goes on with the fences of the fleet that it began with: with that fleet, named again or not; not with another one,
nor with one that has changed since; nor with any that has fences, if it began without.

  $ echo "vehicle 'uav-1', { type 'UAV'; at 41.1850, -8.7060; speed 20.0 }" > one.fleet
  $ echo "fence inside location(41.1850, -8.7060) ^ 500.m" > kept.fleet
  $ echo "fence inside location(41.1850, -8.7060) ^ 5.km" > wide.fleet
  $ cat > go.dol <<'EOF'
  > quay = location 41.1850, -8.7060
  > def go(name, metres) { imcPlan { planName name; locate quay.displace(metres, 0); goTo() } }
  > v = pick { type 'UAV' }
  > execute go('near', 100)[v]
  > execute watch go('far', 900)[v] onError { e -> message e.message; ignore() }
  > execute go('home', 0)[v]
  > EOF
  $ run() { timeout 100 dolphin exec go.dol --platform 'dolphin sim one.fleet --platform --speed 20' "$@"; }
  $ told() { cut -c 10- | grep -E '  (starts|ends|fails)' | sed 's/ by .*//'; }
  $ run --fleet kept.fleet --journal whole.run | told
  uav-1       starts near
  uav-1       ends near
  uav-1       starts far
  uav-1       fails in far: not started: the way to 1.Goto breaks fence inside location(41.185, -8.706) ^ 500.m (kept.fleet:1)
  uav-1       starts home
  uav-1       ends home
  program     ends
  $ until_far() { awk '/"start\(uav-1, far\)"/ { exit } { print }' $1 > $2; }
  $ until_far whole.run named.run && run --resume named.run --fleet kept.fleet | told
  uav-1       starts far
  uav-1       fails in far: not started: the way to 1.Goto breaks fence inside location(41.185, -8.706) ^ 500.m (kept.fleet:1)
  uav-1       starts home
  uav-1       ends home
  program     ends
  $ until_far whole.run unnamed.run && run --resume unnamed.run | told
  uav-1       starts far
  uav-1       fails in far: not started: the way to 1.Goto breaks fence inside location(41.185, -8.706) ^ 500.m (kept.fleet:1)
  uav-1       starts home
  uav-1       ends home
  program     ends
  $ dolphin trace check go.dol unnamed.run | sed 's/, of [^;]*;/;/'
  unnamed.run: a run; completed
  $ until_far whole.run other.run && run --resume other.run --fleet wide.fleet
  dolphin: wide.fleet: this is not the fleet that the run was on, or it has changed since
  [2]
  $ until_far whole.run other.run && cp wide.fleet kept.fleet && run --resume other.run
  dolphin: kept.fleet: this is not the fleet that the run was on, or it has changed since
  [2]
  $ run --journal free.run | told
  uav-1       starts near
  uav-1       ends near
  uav-1       starts far
  uav-1       ends far
  uav-1       starts home
  uav-1       ends home
  program     ends
  $ until_far free.run begun.run && run --resume begun.run --fleet wide.fleet
  dolphin: wide.fleet: a run goes on with the fences that it began with, and it had no fleet
  [2]
