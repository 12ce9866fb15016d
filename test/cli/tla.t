`dolphin tla` writes a program as a model in TLA+, with the specification beside it.

  $ cat > mission.dol <<'END'
  > v = pick { type 'UAV' }
  > execute v: imcPlan('patrol')
  > message 'back'
  > END
  $ dolphin tla mission.dol -o out/model
  $ ls out/model
  Coverage.cfg
  Dolphin.tla
  DolphinMachine.tla
  DolphinValues.tla
  Graph.cfg
  MC.cfg
  MC.tla
  Told.cfg
  $ head -3 out/model/MC.tla
  ---- MODULE MC ----
  \* mission.dol in its world. Made by dolphin tla: make it anew rather than change it.
  EXTENDS Dolphin
  $ grep -c 'at mission.dol:2' out/model/MC.tla
  4
  $ grep MCOrderedKeys out/model/MC.tla
  MCOrderedKeys == { }
  $ grep -A1 'MCFailures\|MCEnding' out/model/MC.tla
  MCFailures == -1
  
  --
  MCEnding(v, p) ==
    "succeeds"
  $ cat out/model/Graph.cfg
  INIT Init
  NEXT Next
  CONSTANTS
    Known <- ComputedOnce
    Fleet <- TheFleet
    Code <- TheCode
    Lambdas <- TheLambdas
    LambdaNames <- TheLambdaNames
    Places <- ThePlaces
    Distances <- TheDistances
    Plans <- ThePlans
    Main <- MCMain
    GlobalNames <- MCGlobalNames
    OrderedKeys <- MCOrderedKeys
    Prompts <- MCPrompts
    Failures <- MCFailures
    Losses <- MCLosses
    Latecomers <- MCLatecomers
    MayBeLate <- MCMayBeLate
    HostReplies <- MCHostReplies
    SiteOf <- MCSiteOf
    Ending <- MCEnding
    Answers <- MCAnswers
    Interruptions = FALSE
    ScriptFuel = 10000
    AtomicFuel = 2000000
    MaximumCalls = 10000
  INVARIANT PrintGraph
  CHECK_DEADLOCK FALSE

Faults are part of the world.

  $ dolphin tla mission.dol --faults fail=2 -o out/faults
  $ grep -A1 'MCFailures\|MCEnding' out/faults/MC.tla
  MCFailures == 2
  
  --
  MCEnding(v, p) ==
    "may fail"

What TLA+ has no words for is refused, all of it, and nothing is written.

  $ cat > odd.dol <<'END'
  > height = 10
  > place = location 41, -8, height
  > supplier = getSupplier()
  > END
  $ dolphin tla odd.dol -o out/odd
  odd.dol:2:9: error: cannot be translated to TLA+: a location whose coordinates are not constants
    2 | place = location 41, -8, height
      |         ^^^^^^^^^^^^^^^^^^^^^^^
      hint: the translator computes distances, so it must know the coordinates
  odd.dol:3:12: error: cannot be translated to TLA+: a call of the host
    3 | supplier = getSupplier()
      |            ^^^^^^^^^^^^^
      hint: what the procedures of a supplier answer is known only when the program runs
  [2]
  $ ls out
  faults
  model
