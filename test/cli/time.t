How long the paper's mission takes.

  $ timeless() { sed 's/[0-9.]* s, [0-9]* MiB/T/'; }
  $ dolphin time ../../examples/rendezvous.dol | timeless | head -16
  completed: 15:55.125 at the earliest, 19:20.71 at the latest
  task     vehicle     starts        ends                    where
  survey1  noptilus-1  0:00          4:00 to 7:00            rendezvous.dol:18
  survey2  noptilus-2  0:00          4:00 to 7:00            rendezvous.dol:18
  survey3  noptilus-3  0:00          4:00 to 7:00            rendezvous.dol:18
  sk1      noptilus-1  4:00 to 7:00  15:00.321 to 18:13.727  rendezvous.dol:20
  sk2      noptilus-2  4:00 to 7:00  15:25.617 to 18:44.644  rendezvous.dol:20
  sk3      noptilus-3  4:00 to 7:00  15:55.125 to 19:20.71   rendezvous.dol:20
  rv1      x8-02       4:00 to 9:40  4:40 to 11:00           rendezvous.dol:33
  rv2      x8-02       4:00 to 9:40  4:40 to 11:00           rendezvous.dol:35
  rv3      x8-02       4:00 to 9:40  4:40 to 11:00           rendezvous.dol:37
  vehicle     least battery
  noptilus-1  96.9 %
  noptilus-2  96.8 %
  noptilus-3  96.7 %
  x8-02       98.6 %

A deadline that holds, and one that does not, with the run that breaks it.

  $ cat > relay.dol << 'X'
  > a = pick { id 'a' }
  > b = pick { id 'b' }
  > execute (task('survey')[a] >> action { post ready: 1 } >> task('home')[a])
  >   | waitFor { consume ready: 1 } then task('visit')[b]
  > X
  $ cat > relay.fleet << 'X'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UAV' }
  > plan 'survey', { duration 4.min, 7.min }
  > plan 'home', { duration 90.seconds }
  > plan 'visit', { duration 1.min, 2.min }
  > X
  $ dolphin time relay.dol --deadline 9.min | timeless
  completed: 5:30 at the earliest, 9:00 at the latest
  deadline 9:00: holds
  task    vehicle  starts        ends          where
  survey  a        0:00          4:00 to 7:00  relay.dol:3
  home    a        4:00 to 7:00  5:30 to 8:30  relay.dol:3
  visit   b        4:00 to 7:00  5:00 to 9:00  relay.dol:4
  vehicle  least battery
  a        98.5 %
  b        99.3 %
  34 states, depth 13, T
  
  a run that ends last:
         program                      a              b             where        variables
  0:00   pick(1 vehicle with id 'a')                               relay.dol:1
  0:00   picks a                                                   relay.dol:1
  0:00   pick(1 vehicle with id 'b')                               relay.dol:2  a = a
  0:00   picks b                                                   relay.dol:2
  0:00   execute                                                   relay.dol:3  b = b
  0:00                                starts survey                relay.dol:3
  7:00                                ends survey                  relay.dol:3
  7:00   act(post ready:1)                                         relay.dol:3
  7:00                                starts home                  relay.dol:3
  7:00   check(consume ready:1)                                    relay.dol:4
  7:00                                               starts visit  relay.dol:4
  8:30                                ends home                    relay.dol:3
  9:00                                               ends visit    relay.dol:4
  9:00   end
  its end depends on: relay.dol:3:10: survey on a (7:00), then relay.dol:4:39: visit on b (2:00)
  $ dolphin time relay.dol --deadline 8.min | timeless
  completed: 5:30 at the earliest, 9:00 at the latest
  deadline 8:00: violated
  task    vehicle  starts        ends          where
  survey  a        0:00          4:00 to 7:00  relay.dol:3
  home    a        4:00 to 7:00  5:30 to 8:30  relay.dol:3
  visit   b        4:00 to 7:00  5:00 to 9:00  relay.dol:4
  vehicle  least battery
  a        98.5 %
  b        99.3 %
  34 states, depth 13, T
  
  a run that is not over at the deadline, 8:00:
         program                      a              b             where        variables
  0:00   pick(1 vehicle with id 'a')                               relay.dol:1
  0:00   picks a                                                   relay.dol:1
  0:00   pick(1 vehicle with id 'b')                               relay.dol:2  a = a
  0:00   picks b                                                   relay.dol:2
  0:00   execute                                                   relay.dol:3  b = b
  0:00                                starts survey                relay.dol:3
  7:00                                ends survey                  relay.dol:3
  7:00   act(post ready:1)                                         relay.dol:3
  7:00                                starts home                  relay.dol:3
  7:00   check(consume ready:1)                                    relay.dol:4
  7:00                                               starts visit  relay.dol:4
  8:30                                ends home                    relay.dol:3
  9:00                                               ends visit    relay.dol:4
  9:00   end
  its end depends on: relay.dol:3:10: survey on a (7:00), then relay.dol:4:39: visit on b (2:00)
  $ dolphin time relay.dol --deadline 8.min > /dev/null
  [1]
  $ dolphin time relay.dol --deadline soon 2>&1 | head -1
  dolphin: option '--deadline': 'soon' is not a time such as 40.min or

A battery that runs empty in some run, ones that are charged in time, one that the program looks at, and one of which it
is not known.

  $ sed "s/vehicle 'a'.*/vehicle 'a', { type 'UUV'; battery 10.percent; drain 1 }/" relay.fleet > low.fleet
  $ dolphin time relay.dol --fleet low.fleet --deadline 9.min | timeless
  completed: 5:30 at the earliest, 9:00 at the latest
  deadline 9:00: holds
  task    vehicle  starts        ends          where
  survey  a        0:00          4:00 to 7:00  relay.dol:3
  home    a        4:00 to 7:00  5:30 to 8:30  relay.dol:3
  visit   b        4:00 to 7:00  5:00 to 9:00  relay.dol:4
  vehicle  least battery
  a        runs empty
  b        99.3 %
  34 states, depth 13, T
  
  a run in which the battery of a runs empty:
         program                      a              b             where        variables
  0:00   pick(1 vehicle with id 'a')                               relay.dol:1
  0:00   picks a                                                   relay.dol:1
  0:00   pick(1 vehicle with id 'b')                               relay.dol:2  a = a
  0:00   picks b                                                   relay.dol:2
  0:00   execute                                                   relay.dol:3  b = b
  0:00                                starts survey                relay.dol:3
  7:00                                ends survey                  relay.dol:3
  7:00   act(post ready:1)                                         relay.dol:3
  7:00                                starts home                  relay.dol:3
  7:00   check(consume ready:1)                                    relay.dol:4
  7:00                                               starts visit  relay.dol:4
  8:30                                ends home                    relay.dol:3
  9:00                                               ends visit    relay.dol:4
  9:00   end
  $ dolphin time relay.dol --fleet low.fleet --json | python3 -c '
  > import json, sys
  > o = json.load(sys.stdin)
  > print(o["verdict"], o["shown"]["what"])
  > for b in o["batteries"]: print(b["vehicle"], b["verdict"], b["least"], b["lowest"], b["run"]["dates"][-1])'
  violated a run in which the battery of a runs empty
  a violated 0.0 0.0 540
  b holds 0.99375 0.99375 540
  $ dolphin time relay.dol --fleet low.fleet --fewest | head -2
  no fleet of these 2 vehicles will do
  with all of them: battery empty
  $ cat > rounds.dol << 'X'
  > a = pick { id 'a' }
  > execute repeat 4, (task('survey')[a] >> idle(20.min))
  > X
  $ sed "s/drain 1 /drain 15.percent; charge 60.percent /" low.fleet > charged.fleet
  $ dolphin time rounds.dol --fleet charged.fleet | timeless | head -5
  completed: 1:36:00 at the earliest, 1:48:00 at the latest
  task    vehicle  starts           ends             where
  survey  a        0:00 to 1:21:00  4:00 to 1:28:00  rounds.dol:2
  vehicle  least battery
  a        8.2 %
  $ sed "s/battery 10/battery 5/" charged.fleet > lower.fleet
  $ dolphin time rounds.dol --fleet lower.fleet | timeless | head -5
  completed: 1:36:00 at the earliest, 1:48:00 at the latest
  task    vehicle  starts           ends             where
  survey  a        0:00 to 1:21:00  4:00 to 1:28:00  rounds.dol:2
  vehicle  least battery
  a        3.2 %
  $ cat > looks.dol << 'X'
  > a = pick { id 'a' }
  > execute a: (until { battery(a) < 0.09 } run task('survey')) >> task('home')
  > X
  $ dolphin time looks.dol --fleet charged.fleet | timeless | head -6
  completed: 1:30 at the earliest, 8:30 at the latest
  task    vehicle  starts        ends          stopped       where
  survey  a        0:00          4:00 to 7:00  0:00 to 7:00  looks.dol:2
  home    a        0:00 to 7:00  1:30 to 8:30                looks.dol:2
  vehicle  least battery
  a        8.6 % or more
  $ sed "s/until { battery(a) < 0.09 } run/condition { battery(a) > 0.01 } >>/" looks.dol > waits.dol
  $ sed "s/drain 15/drain 99/" charged.fleet > thirsty.fleet
  $ dolphin time waits.dol --fleet thirsty.fleet | timeless | head -6
  completed: 5:30 at the earliest, no latest time
  task    vehicle  starts         ends           where
  survey  a        0:00 or later  4:00 or later  waits.dol:2
  home    a        4:00 or later  5:30 or later  waits.dol:2
  20 states, depth 9, T
  $ dolphin time waits.dol --fleet thirsty.fleet > /dev/null
  [3]

How much longer each task may take before the latest end is later; that of the survey decides.

  $ dolphin time relay.dol --slack | timeless | head -5
  completed: 5:30 at the earliest, 9:00 at the latest
  task    vehicle  starts        ends          slack  where
  survey  a        0:00          4:00 to 7:00  0:00   relay.dol:3
  home    a        4:00 to 7:00  5:30 to 8:30  0:30   relay.dol:3
  visit   b        4:00 to 7:00  5:00 to 9:00  0:00   relay.dol:4
  $ dolphin time relay.dol --slack --json | python3 -c '
  > import json, sys
  > print([t["slack"] for t in json.load(sys.stdin)["tasks"]])'
  [0, 30, 0]
  $ dolphin time relay.dol --slack --fewest
  dolphin: --slack is for one program and its whole fleet: give no --fewest, and --set no range
  [2]

With failures, for programs.

  $ dolphin time relay.dol --faults fail=1 --json | sed 's/"seconds":[0-9.e-]*,"bytes":[0-9]*//' | python3 -c '
  > import json, sys
  > o = json.loads(sys.stdin.read().replace(",}", "}"))
  > print(o["verdict"], o["ends"])
  > for t in o["tasks"]: print(t)
  > print(o["last"]["dates"], o["last"]["chain"])'
  holds {'completed': {'earliest': 330, 'latest': 540}, 'failed': {'earliest': 0, 'latest': 540}}
  {'task': 'survey', 'vehicle': 'a', 'at': 'relay.dol:3:10', 'starts': {'earliest': 0, 'latest': 0}, 'ends': {'earliest': 240, 'latest': 420}, 'fails': {'earliest': 0, 'latest': 420}}
  {'task': 'home', 'vehicle': 'a', 'at': 'relay.dol:3:59', 'starts': {'earliest': 240, 'latest': 420}, 'ends': {'earliest': 330, 'latest': 510}, 'fails': {'earliest': 240, 'latest': 510}, 'stopped': {'earliest': 240, 'latest': 510}}
  {'task': 'visit', 'vehicle': 'b', 'at': 'relay.dol:4:39', 'starts': {'earliest': 240, 'latest': 420}, 'ends': {'earliest': 300, 'latest': 540}, 'fails': {'earliest': 240, 'latest': 540}, 'stopped': {'earliest': 240, 'latest': 510}}
  [0, 0, 0, 0, 0, 0, 420, 420, 420, 420, 420, 510, 540, 540] [{'what': 'relay.dol:3:10: survey on a', 'seconds': 420}, {'what': 'relay.dol:4:39: visit on b', 'seconds': 120}]

A task that may not be done within its time.

  $ sed "s/task('survey')\[a\]/(task('survey')[a] within 5.min)/" relay.dol > within.dol
  $ dolphin time within.dol --fleet relay.fleet | timeless
  completed: 5:30 at the earliest, 7:00 at the latest
  failed: 5:00 at the earliest, 5:00 at the latest
  within.dol:3:10: within: missed, at 5:00
  task    vehicle  starts        ends          stopped  where
  survey  a        0:00          4:00 to 5:00  5:00     within.dol:3
  home    a        4:00 to 5:00  5:30 to 6:30           within.dol:3
  visit   b        4:00 to 5:00  5:00 to 7:00           within.dol:4
  vehicle  least battery
  a        98.8 %
  b        99.4 %
  36 states, depth 13, T
  
  a run in which a task is not done within its time:
         program                      a              where         variables
  0:00   pick(1 vehicle with id 'a')                 within.dol:1
  0:00   picks a                                     within.dol:1
  0:00   pick(1 vehicle with id 'b')                 within.dol:2  a = a
  0:00   picks b                                     within.dol:2
  0:00   execute                                     within.dol:3  b = b
  0:00                                starts survey  within.dol:3
  5:00   timeout                                     within.dol:3

A run whose tasks took as long as they may, and the same with a fleet that says otherwise.

  $ dolphin exec relay.dol --journal relay.run --seed 3 > /dev/null
  $ dolphin trace check relay.dol relay.run --timed
  relay.run: a run, of 14 transitions in 8:49; completed
  $ sed "s/plan 'survey'.*/plan 'survey', { duration 1.min, 2.min }/; s/90.seconds/5.min/" relay.fleet > other.fleet
  $ dolphin trace check relay.dol relay.run --timed --fleet other.fleet
  relay.run: a run, of 14 transitions in 8:49; completed
  6:59.112: relay.dol:3:10: survey on a was not over before 6:59.112, and takes 2:00 at most
  8:29.112: relay.dol:3:59: home on a was over after 1:30, and takes 5:00 at least
  [1]

Virtual time is exact; how much more or less is nothing can be said.

  $ sed "s/duration 4.min, 7.min/duration 4.min, 419.1/" relay.fleet > short.fleet
  $ dolphin trace check relay.dol relay.run --timed --fleet short.fleet
  relay.run: a run, of 14 transitions in 8:49; completed
  6:59.112: relay.dol:3:10: survey on a was not over before 6:59.112, and takes 6:59.1 at most
  [1]
  $ dolphin trace check relay.dol relay.run --timed --fleet short.fleet --tolerance 0.5
  relay.run: a run, of 14 transitions in 8:49; completed
  $ dolphin trace check relay.dol relay.run --fleet short.fleet --tolerance 0
  relay.run: a run, of 14 transitions in 8:49; completed
  6:59.112: relay.dol:3:10: survey on a was not over before 6:59.112, and takes 6:59.1 at most
  [1]
  $ sed '1s/"speed":null/"speed":10/' relay.run > real.run
  $ dolphin trace check relay.dol real.run --timed --fleet short.fleet
  real.run: a run, of 14 transitions in 8:49; completed
  $ dolphin trace check relay.dol relay.run --tolerance=-1 2>&1 | head -n 1
  dolphin: option '--tolerance': -1 is not a number of seconds, 0 or more

  $ dolphin trace check relay.dol - --timed < relay.run
  -: a run, of 14 transitions in 8:49; completed
  dolphin: --timed reads the journal twice, so it must be a file
  [2]

A plan of which the fleet does not say how long it takes.

  $ sed -i "s/plan 'visit'.*/plan 'visit'/" relay.fleet
  $ dolphin time relay.dol | timeless
  completed: 5:30 at the earliest, no latest time
  duration unknown: relay.dol:4:39: visit on b; in the fleet: plan 'visit', { duration 3.min, 9.min }
  task    vehicle  starts        ends           where
  survey  a        0:00          4:00 to 7:00   relay.dol:3
  home    a        4:00 to 7:00  5:30 to 8:30   relay.dol:3
  visit   b        4:00 to 7:00  4:00 or later  relay.dol:4
  38 states, depth 14, T

It is said once, however often the program starts it.

  $ cat > again.dol << 'X'
  > b = pick { id 'b' }
  > for (i in 1..2) { execute task('visit')[b] }
  > X
  $ dolphin time again.dol --fleet relay.fleet | grep unknown
  duration unknown: again.dol:2:27: visit on b; in the fleet: plan 'visit', { duration 3.min, 9.min }

A program that goes round for ever, and one that waits in vain.

  $ cat > patrol.dol << 'X'
  > a = pick { id 'a' }
  > execute repeat task('home')[a]
  > X
  $ dolphin time patrol.dol --fleet relay.fleet | timeless
  no run ends
  task  vehicle  starts         ends           where
  home  a        0:00 or later  1:30 or later  patrol.dol:2
  12 states, depth 6, T
  
  a run that may never end:
      program                      where         variables
  1   pick(1 vehicle with id 'a')  patrol.dol:1
  2   picks a                      patrol.dol:1
  3   execute                      patrol.dol:2  a = a
  and from there, again and again:
      program  a            where
  4            starts home  patrol.dol:2
  5            ends home    patrol.dol:2
  it goes round in the repeat at patrol.dol:2:9
  $ cat > loop.dol << 'X'
  > a = pick { id 'a' }
  > while (true) {
  >   execute task('home')[a]
  > }
  > X
  $ dolphin time loop.dol --fleet relay.fleet | grep 'goes round'
  it goes round in the script at loop.dol:3:3
  $ dolphin time patrol.dol --fleet relay.fleet --json | grep -o '"round":"[^"]*"'
  "round":"the repeat at patrol.dol:2:9"
  $ cat > asked.dol << 'X'
  > a = pick { id 'a' }
  > execute (confirm('Is the boat away?') >> task('home')[a])
  > X
  $ dolphin time asked.dol --fleet relay.fleet | grep 'duration unknown'
  duration unknown: an answer to 'Is the boat away?'
  $ cat > vain.dol << 'X'
  > a = pick { id 'a' }
  > execute waitFor { consume ready: 1 } then task('home')[a]
  > X
  $ dolphin time vain.dol --fleet relay.fleet | timeless
  no run ends
  8 states, depth 3, T
  
  a run in which nothing more happens:
         program                      where       variables
  0:00   pick(1 vehicle with id 'a')  vain.dol:1
  0:00   picks a                      vain.dol:1
  0:00   execute                      vain.dol:2  a = a
  waits for the condition at vain.dol:2:19, consume ready: 1

The run that is shown, in a file that can be followed: here, and where there is one for the deadline.

  $ dolphin time vain.dol --fleet relay.fleet --trace vain.witness > vain
  [1]
  $ dolphin exec vain.dol --fleet relay.fleet --follow vain.witness
  breaks: every run ends
     2  program     picks a
        here the recorded run stops
  $ dolphin time relay.dol --deadline 6.min --trace late.witness --json | grep -o '"shown":{"what":"[^"]*"'
  "shown":{"what":"a run that is not over at the deadline, 6:00"
  $ dolphin exec relay.dol --follow late.witness
  breaks: deadline 6:00
     2  program     picks a
     4  program     picks b
     6  a           starts survey
     7  a           ends survey
     8  program     posts ready:1
     9  a           starts home
    10  program     consumes ready:1
    11  b           starts visit
    12  a           ends home
    13  b           ends visit
    14  program     releases a, b
    14  program     ends
  $ dolphin time relay.dol --trace relay.svg
  dolphin: option '--trace': 'relay.svg' is the name of a picture, but JSON
           would be written
  Usage: dolphin time [OPTION]… PROG
  Try 'dolphin time --help' or 'dolphin --help' for more information.
  [2]

A bound.

  $ dolphin time relay.dol --max-states 5 | timeless
  inconclusive: the bound on states was met; times are of the runs until then
  12 states, depth 4, T
  $ dolphin time relay.dol --max-states 5 > /dev/null
  [3]

When tasks may run, as a picture: dark where a task runs in every run in which it runs.

  $ dolphin time relay.dol --fleet other.fleet --draw relay.svg --deadline 5.min > /dev/null
  [1]
  $ python3 -c '
  > import sys, xml.etree.ElementTree as tree
  > root = tree.parse("relay.svg").getroot()
  > svg = "{http://www.w3.org/2000/svg}"
  > for e in root.iter():
  >     kind = e.get("class") or ""
  >     if e.tag == svg + "rect" and kind.startswith("bar") and e.find(svg + "title") is not None:
  >         print(kind, e.get("width"), e.find(svg + "title").text)
  >     if e.tag == svg + "text" and kind in ("title", "bad", "axis bad"): print(kind, e.text)'
  title relay.dol
  bad some run is late
  bar v0 132.6 survey on a (relay.dol:3:10): starts 0:00, ends 1:00 to 2:00
  bar v0 open 132.6 survey on a (relay.dol:3:10): starts 0:00, ends 1:00 to 2:00
  bar v0 open 132.6 home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00
  bar v0 530.3 home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00
  bar v0 open 132.6 home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00
  bar v1 open 397.7 visit on b (relay.dol:4:39): starts 1:00 to 2:00, ends 2:00 to 4:00
  axis bad deadline 5:00
  $ dolphin time relay.dol --fleet other.fleet --draw relay.html > /dev/null
  $ grep -c '<svg' relay.html
  1
  $ sed 's/<[^>]*>/ /g' relay.html | grep 'relay.dol:3:59'
    home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00 home   home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00  
    home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00  
    home on a (relay.dol:3:59): starts 1:00 to 2:00, ends 6:00 to 7:00  
   relay.dol:3:59 
  $ dolphin time relay.dol --draw relay.png 2>&1 | head -1
  dolphin: option '--draw': 'relay.png' ends neither in .svg nor in .html
  $ dolphin time relay.dol --draw nowhere/relay.svg
  dolphin: the picture cannot be written: nowhere/relay.svg: No such file or directory
  [3]
  $ dolphin time relay.dol --trace nowhere/relay.run
  dolphin: nowhere/relay.run: No such file or directory
  [3]
  $ dolphin time relay.dol --draw relay.svg --fewest
  dolphin: --trace and --draw do not go with --fewest
  [2]

Who joins, leaves, or loses a link by the fleet does so then: the order to c waits, and nobody hears of a any more. With
--faults join all are there, unless they are late.

  $ cat > late.dol <<'END'
  > vs = pick { count 2 }
  > pause 2.5.min
  > execute watch imcPlan('survey')[vs[0]] | imcPlan('survey')[vs[1]] onError { ignore() }
  > END
  $ cat > late.fleet <<'END'
  > vehicle 'a', { type 'UUV'; leaves 5.min }
  > vehicle 'b', { type 'UUV'; joins 90.seconds }
  > vehicle 'c', { type 'UUV'; drops 2.min, 1.min }
  > plan 'survey', { duration 4.min, 7.min }
  > END
  $ dolphin time late.dol 2>&1 | sed 's/, [0-9.]* s, [0-9]* MiB//'
  completed: 6:00 at the earliest, 6:00 at the latest
  task    vehicle  starts  fails  stopped  where
  survey  a        2:30    6:00            late.dol:3
  survey  c        2:30           6:00     late.dol:3
  vehicle  least battery
  a        99.3 %
  c        99.3 %
  28 states, depth 13
  
  a run that ends last:
         program           a                                 c              where       variables
  0:00   pick(2 vehicles)                                                   late.dol:1
  0:00   picks a, c                                                         late.dol:1
         if b is missing
  0:00   pause(150)                                                         late.dol:2  vs = [a, c]
  2:30   resume                                                             late.dol:2
  2:30   execute                                                            late.dol:3
  2:30                     starts survey                                    late.dol:3
  2:30                                                       starts survey  late.dol:3
  6:00                     fails in survey: connection lost                 late.dol:3
  6:00   end
  its end depends on: a's link goes (5:00), then nothing is heard of a (1:00)
  $ dolphin time late.dol --faults join 2>&1 > /dev/null
  dolphin: by the fleet these leave, or lose their links: a, c; here they stay, unless --faults has loss
  $ cat > joins.dol <<'END'
  > vs = pick { count 3; timeout 2.min }
  > execute imcPlan('survey')[vs[2]]
  > END
  $ dolphin time joins.dol --fleet late.fleet 2> /dev/null | sed 's/, [0-9.]* s, [0-9]* MiB//'
  completed: 5:30 at the earliest, 8:30 at the latest
  task    vehicle  starts  ends          where
  survey  b        1:30    5:30 to 8:30  joins.dol:2
  vehicle  least battery
  b        98.7 %
  22 states, depth 10
  
  a run that ends last:
         program           b              where        variables
  0:00   pick(3 vehicles)                 joins.dol:1
  1:30   picks a, c, b                    joins.dol:1
         if b comes late
  1:30   execute                          joins.dol:2  vs = [a, c, b]
  1:30                     starts survey  joins.dol:2
  8:30                     ends survey    joins.dol:2
  8:30   end
  its end depends on: b joins (1:30), then joins.dol:2:9: survey on b (7:00)

While its order waits for a link, and once its task is over unheard, a vehicle rests: 32.2 % are left of 50 after 31 min
of rest, which take 0.25 % each, and 10 of work, which take 1 %. The simulator says the same.

  $ cat > waits.fleet <<'END'
  > vehicle 'a', { type 'UUV'; battery 50.percent; drain 60.percent; drops 1.min, 30.min }
  > plan 'p', { duration 10.min }
  > END
  $ cat > waits.dol <<'END'
  > va = pick { id 'a' }
  > setConnectionTimeout va, 1.hour
  > pause 61.seconds
  > execute task('p')[va]
  > message battery(va)
  > END
  $ dolphin time waits.dol 2>&1 | grep '^a .*%'
  a        32.2 % or more
  $ dolphin exec waits.dol
     0:00  program     picks a
     0:00  program     sets the connection timeout of a to 1 h
     0:00  program     pauses for 1 min 1 s
     1:00  a           loses its link
     1:01  a           starts p
    31:00  a           has its link back
    41:00  a           ends p
    41:00  program     says: 0.3225
    41:00  program     releases a
    41:00  program     ends

What follows is not known if it changes meanwhile how long nothing may be heard of a vehicle.

  $ cat > changes.dol <<'END'
  > v = pick { id 'a' }
  > execute task('p')[v] | (idle(70.seconds) >> action { setConnectionTimeout v, 5.min })
  > END
  $ dolphin time changes.dol --fleet waits.fleet 2>&1 | sed 's/, [0-9.]* s, [0-9]* MiB//'
  inconclusive: while nothing is heard of a, its connection timeout changes: the effect on time is unknown here; times are of the runs until then
  task  vehicle  starts  where
  p     a        0:00    changes.dol:2
  12 states, depth 5

In a narrow terminal rows of tables go on in further lines, and a run is a list.

  $ COLUMNS=44 dolphin time joins.dol --fleet late.fleet 2> /dev/null | sed 's/, [0-9.]* s, [0-9]* MiB//'
  completed: 5:30 at the earliest, 8:30 at
    the latest
  task    vehicle  starts  ends
    where
  survey  b        1:30    5:30 to 8:30
    joins.dol:2
  vehicle  least battery
  b        98.7 %
  22 states, depth 10
  
  a run that ends last:
         who      what             where
  0:00   program  pick(3 vehic...  joins.dol:1
  1:30   program  picks a, c, b    joins.dol:1
         if b comes late
  1:30   program  execute          joins.dol:2
         vs = [a, c, b]
  1:30   b        starts survey    joins.dol:2
  8:30   b        ends survey      joins.dol:2
  8:30   program  end
  its end depends on: b joins (1:30), then
    joins.dol:2:9: survey on b (7:00)
  $ dolphin explore late.dol --faults loss 2>&1 > /dev/null
  dolphin: by the fleet these join late: b; here they are there from the start, unless --faults has join

What code does with the date is exact where it compares it with constants. Else nothing is said, but where that is.

  $ cat > dusk.dol <<'END'
  > limit = 5.min
  > v = pick { id 'a' }
  > execute (repeat task('survey')[v] until { now() >= limit }) >> action { message "done at ${now()}" }
  > message 'it took ' + (now() / 60).round(1) + " min, ${limit - now()} s less than planned"
  > END
  $ cat > dusk.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'survey', { duration 2.min, 3.min }
  > END
  $ dolphin time dusk.dol | sed 's/, [0-9.]* s, [0-9]* MiB//'
  completed: 5:00 at the earliest, 8:00 at the latest
  task    vehicle  starts        ends          where
  survey  a        0:00 to 5:00  2:00 to 8:00  dusk.dol:3
  vehicle  least battery
  a        98.6 %
  41 states, depth 16
  
  a run that ends last:
         program                                   a              where       variables
  0:00   pick(1 vehicle with id 'a')                              dusk.dol:2  limit = 300
  0:00   picks a                                                  dusk.dol:2
  0:00   execute                                                  dusk.dol:3  v = a
  0:00                                             starts survey  dusk.dol:3
  3:00                                             ends survey    dusk.dol:3
  3:00   check                                                    dusk.dol:3
  3:00                                             starts survey  dusk.dol:3
  5:00                                             ends survey    dusk.dol:3
  5:00   check                                                    dusk.dol:3
  5:00                                             starts survey  dusk.dol:3
  8:00                                             ends survey    dusk.dol:3
  8:00   check                                                    dusk.dol:3
  8:00   act(message 'done at now()')                             dusk.dol:3
  8:00   message 'it took (now() / 60).round(1) min, 300 - now() s less than planned'                 dusk.dol:4
  8:00   end
  its end depends on: now() = 5:00 (5:00), then dusk.dol:3:17: survey on a (3:00)
  $ echo 'if (now() - 10 > limit) { message limit }' >> dusk.dol
  $ dolphin time dusk.dol 2>&1 | sed 's/, [0-9.]* s, [0-9]* MiB//'
  inconclusive: dusk.dol:5:5: now() is used other than in comparisons with constants such as now() < 20.min: its effect on time is unknown here; times are of the runs until then
  2 states, depth 0
  $ dolphin time dusk.dol > /dev/null 2>&1
  [3]

Locals and parameters of functions are constants if all their values are; what is kept of the date is not. That a
comparison held is.

  $ cat > kept.dol <<'END'
  > v = pick { id 'a' }
  > execute task('survey')[v]
  > early = now() < 150
  > execute { early ? task('survey') : task('survey') >> task('survey') }[v]
  > END
  $ dolphin time kept.dol --fleet dusk.fleet | head -1
  completed: 4:00 at the earliest, 9:00 at the latest
  $ cat > start.dol <<'END'
  > v = pick { id 'a' }
  > start = now()
  > execute task('survey')[v] until { now() - start > 1.min }
  > END
  $ dolphin time start.dol --fleet dusk.fleet 2>&1 | head -1
  inconclusive: start.dol:2:9: now() is used other than in comparisons with constants such as now() < 20.min: its effect on time is unknown here; times are of the runs until then
  $ cat > local.dol <<'END'
  > v = pick { id 'a' }
  > def survey(limit) { task('survey') until { now() >= limit } }
  > execute survey(1.min)[v]
  > END
  $ dolphin time local.dol --fleet dusk.fleet 2>&1 | head -1
  completed: 1:00 at the earliest, 1:00 at the latest

What nobody can tell of the very first state is said, too.

  $ cat > first.dol <<'END'
  > message 5 / now()
  > END
  $ dolphin time first.dol 2>&1 | sed 's/; times are.*//; s/, [0-9.]* s, [0-9]* MiB//'
  inconclusive: first.dol:1:9: the value of now() is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
  0 states, depth 0
  $ dolphin time first.dol > /dev/null 2>&1
  [3]

A plan may charge, and so may rest, if the fleet says so only near a charger: the bound is that of rest which never
charges, and of a run the place counts.

  $ least() { grep '^noptilus'; }
  $ dolphin time ../../examples/charging.dol | least
  noptilus-1  55 % or more
  noptilus-2  47.4 % or more
  $ dolphin exec ../../examples/charging.dol | grep says
  2:11:32  program     says: the dock: 100 %, the pier: 100 %
  $ sed '/charger/d' ../../examples/charging.fleet > anywhere.fleet
  $ dolphin time ../../examples/charging.dol --fleet anywhere.fleet | least
  noptilus-1  55 % or more
  noptilus-2  56.1 % or more
  $ sed 's/charger .*/charger 41.2, -8.7, 30.m/' ../../examples/charging.fleet > elsewhere.fleet
  $ dolphin exec ../../examples/charging.dol --fleet elsewhere.fleet | grep says
  2:11:32  program     says: the dock: 100 %, the pier: 48 %
  $ sed 's/; charges.*/ }/' ../../examples/charging.fleet > undocked.fleet
  $ dolphin time ../../examples/charging.dol --fleet undocked.fleet | least
  noptilus-1  36.6 % or more
  noptilus-2  47.4 % or more

A run that fails, or never ends, is shown without faults if there is one, although one with faults takes longer:

  $ cat > masked.dol <<'END'
  > parameter n = 1, 'rounds'
  > v = pick { type 'UUV' }
  > execute (watch task('p') onError { task('long') }) >> (repeat n, task('p')) >> action { x = 1 / 0 }
  > END
  $ cat > masked.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'p', { duration 1.min }
  > plan 'long', { duration 1.hours }
  > END
  $ dolphin time masked.dol --faults fail --set n=1..2 | grep -e ' p ' -e ' long ' -e broken
  0:00                                  starts p  masked.dol:3
  1:00                                  ends p    masked.dol:3
  1:00                                  starts p  masked.dol:3
  2:00                                  ends p    masked.dol:3
  2:00                                  starts p  masked.dol:3
  3:00                                  ends p    masked.dol:3
  3:00   broken(division by zero)                 masked.dol:3
  $ cat > endless.dol <<'END'
  > v = pick { type 'UUV' }
  > execute (watch task('p') onError { repeat task('long') }) >> task('p') >> repeat task('p')
  > END
  $ dolphin time endless.dol --fleet masked.fleet --faults fail | grep -e ' p ' -e ' long '
  4                                  starts p  endless.dol:2
  5                                  ends p    endless.dol:2
  6                                  starts p  endless.dol:2
  7                                  ends p    endless.dol:2
   8            starts p  endless.dol:2
   9            ends p    endless.dol:2
