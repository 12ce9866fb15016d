Formulas are asked of states up to the exchange of vehicles that they do not name.

  $ cat > mission.dol <<'END'
  > include 'prelude'
  > vs = pick { count 4 }
  > execute par([task('survey')[vs[0]] >> action { post met: vs[0] }, task('survey')[vs[1]], task('survey')[vs[2]],
  >              task('survey')[vs[3]]])
  > a = pick { type 'UUV' }
  > b = pick { type 'UUV' }
  > execute task('look')[a] | task('look')[b]
  > release a + b + vs
  > END
  $ for n in 0 1 2 3 4 5 6 7; do echo "vehicle 'v$n', { type 'UUV' }"; done > mission.fleet
  $ asked() {
  >   for reduction in none all; do
  >     dolphin explore mission.dol --ltl "$1" --reduction $reduction |
  >       sed -n -e 's/.*; \([0-9]* states for formulas\)/\1/p' -e '/^formula.*: [hv]/p'
  >   done
  > }
  $ asked 'G (start(survey) -> F done(survey))'
  formula G (start(survey) -> F done(survey)): holds
  26532 states for formulas
  formula G (start(survey) -> F done(survey)): holds
  243 states for formulas
  $ asked 'F ended'
  formula F ended: holds
  17502 states for formulas
  formula F ended: holds
  125 states for formulas

A run that violates it is as long as that of the plain search.

  $ asked 'G !(poll(met: _) & running(look))'
  formula G !(poll(met: _) & running(look)): violated after 18 steps: it does not hold
  11622 states for formulas
  formula G !(poll(met: _) & running(look)): violated after 18 steps: it does not hold
  118 states for formulas
  $ asked 'G (start(look) -> F done(look, v3))'
  formula G (start(look) -> F done(look, v3)): violated after 23 steps: it does not hold
  20652 states for formulas
  formula G (start(look) -> F done(look, v3)): violated after 23 steps: it does not hold
  1322 states for formulas

The run that is shown has the fleet's own names.

  $ dolphin explore mission.dol --ltl 'G !done(look, v7)' | sed -n '/shortest run/,$p'
  formula G !done(look, v7): a shortest run in which it does not hold
       program                         v0             v1             v2             v3             v7           v4           where          variables
   1   pick(4 vehicles)                                                                                                      mission.dol:2
   2   picks v0, v1, v2, v3                                                                                                  mission.dol:2
   3   execute                                                                                                               mission.dol:3  vs = [v0, v1, v2, v3]
   4                                   starts survey                                                                         mission.dol:3
   5                                   ends survey                                                                           mission.dol:3
   6   act(post met:v0)                                                                                                      mission.dol:3
   7                                                  starts survey                                                          mission.dol:3
   8                                                  ends survey                                                            mission.dol:3
   9                                                                 starts survey                                           mission.dol:3
  10                                                                 ends survey                                             mission.dol:3
  11                                                                                starts survey                            mission.dol:4
  12                                                                                ends survey                              mission.dol:4
  13   pick(1 vehicle of type 'UUV')                                                                                         mission.dol:5
  14   picks v4                                                                                                              mission.dol:5
  15   pick(1 vehicle of type 'UUV')                                                                                         mission.dol:6  a = v4
  16   picks v7                                                                                                              mission.dol:6
  17   execute                                                                                                               mission.dol:7  b = v7
  18                                                                                               starts look               mission.dol:7
  19                                                                                               ends look                 mission.dol:7
       decides the formula: the rest of the run does not matter
  20                                                                                                            starts look  mission.dol:7
  21                                                                                                            ends look    mission.dol:7
  22   release v4, v7, v0, v1, v2, v3                                                                                        mission.dol:8
  23   end
  tuples then: {met:v0}
