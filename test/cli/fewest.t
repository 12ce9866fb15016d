How many vehicles it takes: six lanes, shared by as many vehicles as a parameter says.

  $ cat > lanes.dol <<'END'
  > include 'prelude'
  > parameter n = 2, 'how many vehicles'
  > pick {
  >     type 'UUV'
  >     count n
  > }
  > execute par((1..n).collect { i -> repeat [6, 3, 2][n - 1], imcPlan('lane') })
  > END
  $ cat > lanes.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > vehicle 'c', { type 'UUV' }
  > plan 'lane', { duration 8.min, 10.min }
  > END
  $ dolphin time lanes.dol --set n=1..4 --deadline 35.min
  n  earliest  latest   states  verdict
  1  48:00     1:00:00  36      late
  2  24:00     30:00    48      holds
  3  16:00     20:00    24      holds
  4  0:10      0:10     6       fails
  fewest: n=2
  
  n=1:
  a run that is not over at the deadline, 35:00:
            program                        a            where        variables
     0:00   pick(1 vehicle of type 'UUV')               lanes.dol:3  n = 1
     0:00   picks a                                     lanes.dol:3
     0:00   execute                                     lanes.dol:7
     0:00                                  starts lane  lanes.dol:7
    10:00                                  ends lane    lanes.dol:7
    10:00                                  starts lane  lanes.dol:7
    20:00                                  ends lane    lanes.dol:7
    20:00                                  starts lane  lanes.dol:7
    30:00                                  ends lane    lanes.dol:7
    30:00                                  starts lane  lanes.dol:7
    40:00                                  ends lane    lanes.dol:7
    40:00                                  starts lane  lanes.dol:7
    50:00                                  ends lane    lanes.dol:7
    50:00                                  starts lane  lanes.dol:7
  1:00:00                                  ends lane    lanes.dol:7
  1:00:00   end
  its end depends on: lanes.dol:7:60: lane on a (10:00), then lanes.dol:7:60: lane on a (10:00), then lanes.dol:7:60: lane on a (10:00), then lanes.dol:7:60: lane on a (10:00), then lanes.dol:7:60: lane on a (10:00), then lanes.dol:7:60: lane on a (10:00)
  
  n=2:
  a run that ends last:
          program                         a            b            where        variables
   0:00   pick(2 vehicles of type 'UUV')                            lanes.dol:3  n = 2
   0:00   picks a, b                                                lanes.dol:3
   0:00   execute                                                   lanes.dol:7
   0:00                                   starts lane               lanes.dol:7
   0:00                                                starts lane  lanes.dol:7
  10:00                                   ends lane                 lanes.dol:7
  10:00                                   starts lane               lanes.dol:7
  10:00                                                ends lane    lanes.dol:7
  10:00                                                starts lane  lanes.dol:7
  20:00                                   ends lane                 lanes.dol:7
  20:00                                   starts lane               lanes.dol:7
  20:00                                                ends lane    lanes.dol:7
  20:00                                                starts lane  lanes.dol:7
  30:00                                   ends lane                 lanes.dol:7
  30:00                                                ends lane    lanes.dol:7
  30:00   end
  its end depends on: lanes.dol:7:60: lane on b (10:00), then lanes.dol:7:60: lane on b (10:00), then lanes.dol:7:60: lane on b (10:00)
  $ dolphin time lanes.dol --set n=3..1 --deadline 15.min | head -5
  n  earliest  latest   states  verdict
  3  16:00     20:00    24      late
  2  24:00     30:00    48      late
  1  48:00     1:00:00  36      late
  fewest: none of them

Each line is the answer for that value alone.

  $ numbers='import json, sys
  > def ends(o): return o["ends"], o["states"], o["verdict"]
  > o = json.load(sys.stdin)
  > print("\n".join(str((v["value"], ends(v["found"]))) for v in o["values"]) if "values" in o else ends(o))'
  $ dolphin time lanes.dol --set n=1..3 --json | python3 -c "$numbers"
  (1, ({'completed': {'earliest': 2880, 'latest': 3600}}, 36, 'holds'))
  (2, ({'completed': {'earliest': 1440, 'latest': 1800}}, 48, 'holds'))
  (3, ({'completed': {'earliest': 960, 'latest': 1200}}, 24, 'holds'))
  $ for n in 1 2 3; do dolphin time lanes.dol --set n=$n --json | python3 -c "$numbers"; done
  ({'completed': {'earliest': 2880, 'latest': 3600}}, 36, 'holds')
  ({'completed': {'earliest': 1440, 'latest': 1800}}, 48, 'holds')
  ({'completed': {'earliest': 960, 'latest': 1200}}, 24, 'holds')

What is not known is not said.

  $ dolphin time lanes.dol --set n=1..3 --max-states 8 | head -5
  n  earliest  latest  states  verdict
  1                    18      inconclusive
  2                    18      inconclusive
  3                    18      inconclusive
  fewest: none of which it is known

All runs, not only in time.

  $ dolphin explore lanes.dol --set n=3..4
  n  states  verdict
  3  17      holds
  4  3       violated: vehicles for all picks
  fewest: n=3
  $ dolphin explore lanes.dol --set n=4..5 > /dev/null
  [1]
  $ dolphin explore lanes.dol --set n=1..2 --json | python3 -c '
  > import json, sys
  > o = json.load(sys.stdin)
  > print(o["parameter"], o["fewest"], o["least"], [(v["value"], v["verdict"], v["found"]["states"]) for v in o["values"]])'
  n 1 True [(1, 'holds', 17), (2, 'holds', 17)]

What cannot be asked.

  $ dolphin time lanes.dol --set n=1..0.5
  dolphin: --set n=1..0.5: 'n' is a whole number, as in n = 2 (how many vehicles)
  [2]
  $ dolphin time lanes.dol --set n=1..5000
  dolphin: --set n=1..5000: 'n' is a whole number, as in n = 2 (how many vehicles)
  [2]
  $ dolphin exec lanes.dol --set n=1..3
  dolphin: --set n=1..3: 'n' is a whole number, as in n = 2 (how many vehicles)
  [2]
  $ dolphin explore lanes.dol --set n=1..3 --junit verdicts.xml
  dolphin: --trace, --draw, --junit, --sarif, --certify and --cache are for one program: give --set no range of values
  [2]
  $ dolphin time lanes.dol --set n=1..3 --fewest
  dolphin: --fewest looks for the least fleet of one program: give --set no range with it
  [2]
  $ sed "s/^parameter.*/parameter n = 2\nparameter m = 1\nparameter name = 'x'/" lanes.dol > several.dol
  $ dolphin time several.dol --fleet lanes.fleet --set n=1..3 --set m=1..2
  dolphin: only one parameter may have a range of values, not both n and m
  [2]
  $ dolphin time several.dol --fleet lanes.fleet --set name=1..3 | head -1
  completed: 24:00 at the earliest, 30:00 at the latest

The least part of a fleet: the lanes are shared by all that are there.

  $ cat > all.dol <<'END'
  > include 'prelude'
  > vs = pick {
  >     type 'UUV'
  >     count _
  > }
  > execute par((1..vs.size()).collect { i -> repeat [6, 3, 2][vs.size() - 1], imcPlan('lane') })
  > END
  $ dolphin time all.dol --fleet lanes.fleet --fewest --deadline 35.min
  fewest: 2 of 3 vehicles: a, b
  without a: late
  without b: late
  5 fleets looked at
  
  without a:
  a run that is not over at the deadline, 35:00:
            program                           b            where      variables
     0:00   pick(all vehicles of type 'UUV')               all.dol:2
     0:10   picks b                                        all.dol:2
     0:10   execute                                        all.dol:6  vs = b
     0:10                                     starts lane  all.dol:6
    10:10                                     ends lane    all.dol:6
    10:10                                     starts lane  all.dol:6
    20:10                                     ends lane    all.dol:6
    20:10                                     starts lane  all.dol:6
    30:10                                     ends lane    all.dol:6
    30:10                                     starts lane  all.dol:6
    40:10                                     ends lane    all.dol:6
    40:10                                     starts lane  all.dol:6
    50:10                                     ends lane    all.dol:6
    50:10                                     starts lane  all.dol:6
  1:00:10                                     ends lane    all.dol:6
  1:00:10   end
  its end depends on: all.dol:2:6: a timer of the program (0:10), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00)
  
  with a, b:
  a run that ends last:
          program                           a            b            where      variables
   0:00   pick(all vehicles of type 'UUV')                            all.dol:2
   0:10   picks a, b                                                  all.dol:2
   0:10   execute                                                     all.dol:6  vs = [a, b]
   0:10                                     starts lane               all.dol:6
   0:10                                                  starts lane  all.dol:6
  10:10                                     ends lane                 all.dol:6
  10:10                                     starts lane               all.dol:6
  10:10                                                  ends lane    all.dol:6
  10:10                                                  starts lane  all.dol:6
  20:10                                     ends lane                 all.dol:6
  20:10                                     starts lane               all.dol:6
  20:10                                                  ends lane    all.dol:6
  20:10                                                  starts lane  all.dol:6
  30:10                                     ends lane                 all.dol:6
  30:10                                                  ends lane    all.dol:6
  30:10   end
  its end depends on: all.dol:2:6: a timer of the program (0:10), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00), then all.dol:6:76: lane on b (10:00)
  $ dolphin time all.dol --fleet lanes.fleet --fewest --deadline 35.min --json | python3 -c '
  > import json, sys
  > o = json.load(sys.stdin)
  > print(o["fewest"], o["vehicles"], {v: t["why"] for v, t in o["without"].items()}, o["unsure"], o["fleets"])
  > print(o["timed"]["ends"])'
  2 ['a', 'b'] {'a': 'late', 'b': 'late'} [] 5
  {'completed': {'earliest': 1450, 'latest': 1810}}
  $ dolphin time all.dol --fleet lanes.fleet --fewest --deadline 25.min | head -3
  fewest: 3 of 3 vehicles: a, b, c
  without a: late
  without b: late
  $ dolphin time all.dol --fleet lanes.fleet --fewest --deadline 15.min | head -5
  no fleet of these 3 vehicles will do
  with all of them: late
  8 fleets looked at
  
  a run that is not over at the deadline, 15:00:
  $ dolphin time all.dol --fleet lanes.fleet --fewest --max-states 10
  no fleet of these 3 vehicles is known to do
  inconclusive: a
  inconclusive: b
  inconclusive: c
  inconclusive: a, b
  inconclusive: a, c
  inconclusive: b, c
  with all of them: inconclusive: the bound on states was met
  8 fleets looked at
  [3]
  $ dolphin time ../../examples/rendezvous.dol --fewest --deadline 20.min | head -6
  fewest: 4 of 4 vehicles: noptilus-1, noptilus-2, noptilus-3, x8-02
  without noptilus-1: vehicles for all picks: violated
  without noptilus-2: vehicles for all picks: violated
  without noptilus-3: vehicles for all picks: violated
  without x8-02: vehicles for all picks: violated
  16 fleets looked at

What was found flies.

  $ dolphin exec lanes.dol --set n=3 | tail -1
    18:46  program     ends
  $ check-journals
