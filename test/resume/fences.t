A console that dies while vehicles are kept to fences, and another one that goes on: what the two tell together is what one
would have told. Plans that were refused were never started, who broke a fence was told to stop.

  $ cat > late.dol <<'END'
  > quay = location 41.1850, -8.7060
  > fence inside polygon([quay, quay.displace(0, 500), quay.displace(300, 500), quay.displace(300, 0)])
  > fence distance 30.m
  > fence depth 20.m
  > def go(name, north, east) { imcPlan { planName name; locate quay.displace(north, east); goTo() } }
  > vs = pick { type 'UUV'; count 2 }
  > one = vs[0]
  > other = vs[1]
  > def tried(t) { watch t onError { e -> message e.message; ignore() } }
  > execute tried(go('out', 310, 20)[one])
  > execute tried(go('west', 100, 100)[one]) | tried(go('east', 100, 400)[other])
  > execute tried(go('meets', 250, 400)[one]) | tried(go('crosses', 200, 100)[other])
  > execute tried(task('drift')[one])
  > execute tried(go('back', 100, 50)[one])
  > execute tried(task('deep')[other])
  > execute tried(task('stays')[one]) | tried(task('nears')[other])
  > END
  $ cat > late.fleet <<'END'
  > vehicle 'a', { type 'UUV'; at 41.1852, -8.7055 }
  > vehicle 'b', { type 'UUV'; at 41.1852, -8.7030 }
  > plan 'drift', { duration 5.min, 10.min; at 41.1840, -8.7050 }
  > plan 'deep', { duration 5.min; at 41.1859, -8.7030, -40 }
  > plan 'stays', { duration 20.min; at 41.1859, -8.7054 }
  > plan 'nears', { duration 20.min; at 41.1859, -8.7054 }
  > END
  $ dolphin exec late.dol --journal whole.run > whole.log
  $ grep -c 'not started\|stopped' whole.log
  12
  $ die_at() { prlimit --fsize=$1 --core=0 dolphin exec late.dol --journal $2 > $3 2> /dev/null; }
  $ size=$(wc -c < whole.run)
  $ for part in 5 10 15 20 25 30 35 40 45 50 55 60 65 70 75 80 85 90 95 99; do
  >   rm -f died.run; (die_at $((size * part / 100)) died.run first.log) 2> /dev/null
  >   dolphin exec --resume died.run late.dol > second.log
  >   cat first.log second.log | diff - whole.log && dolphin trace check late.dol died.run
  > done | sort | uniq -c
       20 died.run: a run, of 30 transitions in 14:41; completed

Also right before and after each failure at a fence.

  $ grep -b 'not started\|stopped:' whole.run | cut -d: -f1 > at
  $ for at in $(cat at); do for more in -1 20 400; do
  >   rm -f died.run; (die_at $((at + more)) died.run first.log) 2> /dev/null
  >   dolphin exec --resume died.run late.dol > second.log
  >   cat first.log second.log | diff - whole.log && dolphin trace check late.dol died.run
  > done; done | sort | uniq -c
       36 died.run: a run, of 30 transitions in 14:41; completed
