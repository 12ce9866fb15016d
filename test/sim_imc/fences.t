Fences over IMC: what breaks one is not started; a vehicle that is seen beyond one is stopped, and its task fails.

  $ cat > quay.fleet <<'EOF'
  > vehicle 'noptilus-1', { type 'UUV'; at 41.1850, -8.7060; speed 5.0 }
  > plan 'drift', { duration 20.min; at 41.3000, -8.7060 }
  > EOF
  $ cat > m.dol <<'EOF'
  > quay = location 41.1850, -8.7060
  > fence inside quay ^ 200.m
  > def go(name, metres) { imcPlan { planName name; locate quay.displace(metres, 0); goTo() } }
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > v = pick { type 'UUV'; timeout 1.min }
  > execute tried(go('near', 50)[v])
  > execute tried(go('far', 300)[v])
  > execute task('drift')[v]
  > EOF
  $ dolphin sim quay.fleet --imc --speed 20 --announce 0.5 --contact 0.2 --discovery-ports 21900-21904 --port 21910 \
  >   --log log.jsonl --for 300 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ timeout 240 dolphin exec m.dol --imc-loopback --imc-discovery-ports 21900-21904 --journal m.run > log 2> err
  [1]
  $ kill $vehicles; wait $vehicles || true
  $ cut -c 10- log | grep -E '  (picks|starts|ends|fails|says|releases)' | sed 's/ by .*//'
  program     picks noptilus-1
  noptilus-1  starts near
  noptilus-1  ends near
  noptilus-1  starts far
  noptilus-1  fails in far: not started: the way to 1.Goto breaks fence inside quay ^ 200.m (m.dol:2)
  program     says: far failed on noptilus-1: not started: the way to 1.Goto breaks fence inside quay ^ 200.m (m.dol:2)
  noptilus-1  starts drift
  noptilus-1  fails in drift: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  program     releases noptilus-1
  program     fails: drift failed on noptilus-1: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  $ dolphin trace check m.dol m.run | sed 's/, of [^;]*;/;/; s/ by .*//'
  m.run: a run; failed: drift failed on noptilus-1: stopped: the vehicle breaks fence inside quay ^ 200.m (m.dol:2)
  $ grep -c '"plan":"far"' log.jsonl
  0
  [1]

Depths and heights are watched too: those of EstimatedState. What is remarked of vehicles depends on when they are
heard, and is left out.

  $ cat > levels.fleet <<'EOF'
  > vehicle 'noptilus-1', { type 'UUV'; at 41.1850, -8.7060; speed 5.0 }
  > vehicle 'x8-02', { type 'UAV'; at 41.1850, -8.7060; speed 20.0 }
  > plan 'dive', { duration 10.min; at 41.1900, -8.7060, -60 }
  > plan 'climb', { duration 10.min; at 41.2100, -8.7060, 300 }
  > EOF
  $ cat > levels.dol <<'EOF'
  > fence depth 20.m
  > fence height 100.m
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > diver = pick { type 'UUV'; timeout 1.min }
  > plane = pick { type 'UAV'; timeout 1.min }
  > execute tried(task('dive')[diver])
  > execute task('climb')[plane]
  > EOF
  $ dolphin sim levels.fleet --imc --speed 20 --announce 0.5 --contact 0.2 --discovery-ports 21905-21909 --port 21912 \
  >   --for 300 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ timeout 240 dolphin exec levels.dol --imc-loopback --imc-discovery-ports 21905-21909 --journal levels.run > log 2> err
  [1]
  $ kill $vehicles; wait $vehicles || true
  $ cut -c 10- log | grep -E '  (picks|starts|ends|fails|says|releases)' | sed 's/ by .*//'
  program     picks noptilus-1
  program     picks x8-02
  noptilus-1  starts dive
  noptilus-1  fails in dive: stopped: the vehicle breaks fence depth 20.m (levels.dol:1)
  program     says: dive failed on noptilus-1: stopped: the vehicle breaks fence depth 20.m (levels.dol:1)
  x8-02       starts climb
  x8-02       fails in climb: stopped: the vehicle breaks fence height 100.m (levels.dol:2)
  program     releases noptilus-1, x8-02
  program     fails: climb failed on x8-02: stopped: the vehicle breaks fence height 100.m (levels.dol:2)
  $ dolphin trace check levels.dol levels.run | sed 's/, of [^;]*;/;/; s/ by .*//'
  levels.run: a run; failed: climb failed on x8-02: stopped: the vehicle breaks fence height 100.m (levels.dol:2)
  $ grep -q '"altitude":' levels.run && grep -q '"depth":' levels.run
