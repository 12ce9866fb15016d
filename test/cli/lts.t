The state graph of a program, in the Aldebaran format.

  $ cat > two.dol <<'END'
  > v = pick { count 2; type 'UUV' }
  > execute imcPlan('a') | imcPlan('b')
  > END
  $ cat > swapped.dol <<'END'
  > v = pick { count 2; type 'UUV' }
  > execute imcPlan('b') | imcPlan('a')
  > END
  $ cat > once.dol <<'END'
  > v = pick { count 2; type 'UUV' }
  > execute imcPlan('a') >> imcPlan('b')
  > END
  $ dolphin lts two.dol
  des (0, 46, 35)
  (0,"pick(2 vehicles of type 'UUV')",1)
  (1,"bind(noptilus-1, noptilus-2)",2)
  (1,"bind(noptilus-1, noptilus-3)",3)
  (1,"bind(noptilus-2, noptilus-3)",4)
  (2,"execute",5)
  (3,"execute",6)
  (4,"execute",7)
  (5,"start(noptilus-1, a)",8)
  (5,"start(noptilus-2, b)",9)
  (6,"start(noptilus-1, a)",10)
  (6,"start(noptilus-3, b)",11)
  (7,"start(noptilus-3, b)",13)
  (7,"start(noptilus-2, a)",12)
  (8,"start(noptilus-2, b)",15)
  (8,"done(noptilus-1, a)",14)
  (9,"start(noptilus-1, a)",15)
  (9,"done(noptilus-2, b)",16)
  (10,"start(noptilus-3, b)",18)
  (10,"done(noptilus-1, a)",17)
  (11,"start(noptilus-1, a)",18)
  (11,"done(noptilus-3, b)",19)
  (12,"start(noptilus-3, b)",21)
  (12,"done(noptilus-2, a)",20)
  (13,"start(noptilus-2, a)",21)
  (13,"done(noptilus-3, b)",22)
  (14,"start(noptilus-2, b)",23)
  (15,"done(noptilus-1, a)",23)
  (15,"done(noptilus-2, b)",24)
  (16,"start(noptilus-1, a)",24)
  (17,"start(noptilus-3, b)",25)
  (18,"done(noptilus-1, a)",25)
  (18,"done(noptilus-3, b)",26)
  (19,"start(noptilus-1, a)",26)
  (20,"start(noptilus-3, b)",27)
  (21,"done(noptilus-3, b)",28)
  (21,"done(noptilus-2, a)",27)
  (22,"start(noptilus-2, a)",28)
  (23,"done(noptilus-2, b)",29)
  (24,"done(noptilus-1, a)",29)
  (25,"done(noptilus-3, b)",30)
  (26,"done(noptilus-1, a)",30)
  (27,"done(noptilus-3, b)",31)
  (28,"done(noptilus-2, a)",31)
  (29,"end",32)
  (30,"end",33)
  (31,"end",34)

The smallest one that behaves alike, for Graphviz.

  $ dolphin lts two.dol --quotient strong --format dot | head -3
  digraph "lts" {
    node [shape=box, style=rounded];
    initial [shape=point, label=""];

A graph is bisimilar to itself, from a file too, and so is that of its quotient.

  $ dolphin lts two.dol --quotient strong -o two.aut
  $ dolphin lts two.dol --compare two.aut
  strongly bisimilar
  $ dolphin lts two.dol --format json -o two.json
  $ dolphin lts two.json --compare two.aut
  strongly bisimilar

Two steps with one label that lead to one state are two transitions, as `dolphin explore` counts them; one in what is
minimised.

  $ cat > alike.dol <<'END'
  > t = action { post x: 1 }
  > execute t | t
  > END
  $ dolphin lts alike.dol
  des (0, 5, 5)
  (0,"execute",1)
  (1,"act(post x:1)",2)
  (1,"act(post x:1)",2)
  (2,"act(post x:1)",3)
  (3,"end",4)
  $ dolphin explore alike.dol --reduction none | grep -o '[0-9]* states, [0-9]* transitions'
  5 states, 5 transitions
  $ dolphin lts alike.dol --quotient strong | head -1
  des (0, 4, 5)

Programs that behave differently.

  $ dolphin lts two.dol --compare once.dol
  not bisimilar
  Only the left one satisfies <pick(2 vehicles of type 'UUV')> <bind(noptilus-1, noptilus-2)> <execute> <start(noptilus-2, b)>
  Only the left one has the trace
    pick(2 vehicles of type 'UUV') bind(noptilus-1, noptilus-2) execute
    start(noptilus-2, b)
  [1]

Files that are none.

  $ echo 'des (0, 1' > broken.aut
  $ dolphin lts broken.aut
  dolphin: broken.aut: line 1: expected "des (initial state, transitions, states)", not "des (0, 1"
  [2]
  $ dolphin lts missing.aut
  dolphin: missing.aut: No such file or directory
  [2]

Bounds, and how many search.

  $ dolphin lts two.dol --max-states 5
  dolphin: two.dol has more than 5 states: see --max-states
  [3]
  $ dolphin lts two.dol --timeout 0
  dolphin: two.dol: the time was up
  [3]
  $ dolphin lts two.dol --workers 0
  dolphin: option '--workers': '0' is not a number from 1 on
  Usage: dolphin lts [OPTION]… PROG
  Try 'dolphin lts --help' or 'dolphin --help' for more information.
  [2]
  $ dolphin lts two.dol -o default.aut
  $ dolphin lts two.dol --workers 2 -o of_two.aut
  $ cmp default.aut of_two.aut

Programs of which nobody knows what they do first.

  $ cat > open.dol <<'END'
  > message 5 / now()
  > END
  $ dolphin lts open.dol
  open.dol:1:9: error: the value of now() is open, and more than a comparison depends on it: a fleet may list the values of batteries, positions and measurements
    1 | message 5 / now()
      |         ^^^^^^^^^
  [3]
