`dolphin tla` writes a program as a model in TLA+, with the specification beside it.

  $ cat > mission.dol <<'END'
  > v = pick { type 'UAV' }
  > execute v: imcPlan('patrol')
  > message 'back'
  > END
  $ dolphin tla mission.dol -o out/model
  $ ls out/model
  Abstract.tla
  Coverage.cfg
  Dolphin.tla
  DolphinChecking.tla
  DolphinEnvironment.tla
  DolphinMachine.tla
  DolphinRefinement.tla
  DolphinValues.tla
  Graph.cfg
  MC.cfg
  MC.tla
  MCRefinement.tla
  MCTimed.tla
  Refinement.cfg
  Timed.cfg
  Timed.tla
  Told.cfg
  $ head -3 out/model/MC.tla
  ---- MODULE MC ----
  \* mission.dol in its world. Made by dolphin tla: generate it again rather than edit it.
  EXTENDS DolphinChecking
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
  INIT CheckedInit
  NEXT GraphNext
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
    OnInterrupt <- MCOnInterrupt
    GlobalNames <- MCGlobalNames
    OrderedKeys <- MCOrderedKeys
    OrderedPrefixes <- MCOrderedPrefixes
    Prompts <- MCPrompts
    Failures <- MCFailures
    Losses <- MCLosses
    Latecomers <- MCLatecomers
    MayBeLate <- MCMayBeLate
    Calls <- MCCalls
    Inputs <- MCInputs
    InputKeys <- MCInputKeys
    SiteOf <- MCSiteOf
    Ending <- MCEnding
    Answers <- MCAnswers
    Confirmations <- MCConfirmations
    HostReplies <- MCHostReplies
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

So are interruptions, and what a supplier may reply.

  $ dolphin tla ../../examples/supplier.dol --faults interrupt -o out/supplier
  $ grep Interruptions out/supplier/MC.cfg
    Interruptions = TRUE
  $ grep MCCalls out/supplier/MC.tla
  MCCalls == { "supplier.active", "queue.await" }
  $ grep -A 6 'MCHostReplies' out/supplier/MC.tla
  MCHostReplies(call, at) ==
    CASE call = "getSupplier" -> << << << "value", << "host", "supplier" >> >> >> >>
      [] call = "supplier.active" -> << << << "value", << "boolean", TRUE >> >> >>, << << "value", << "boolean", TRUE >> >>, << "value", << "boolean", FALSE >> >> >>, << << "value", << "boolean", TRUE >> >>, << "value", << "boolean", FALSE >> >> >>, << << "value", << "boolean", FALSE >> >> >> >>
      [] call = "supplier.queue" -> << << << "value", << "host", "queue" >> >> >> >>
      [] call = "queue.await" -> << << << "value", << "task", [ op |-> "platform", name |-> "photograph_pier", plan |-> 0, at |-> at ] >> >> >>, << << "value", << "task", [ op |-> "platform", name |-> "look_for_oil", plan |-> 0, at |-> at ] >> >> >>, << << "value", << "task", [ op |-> "platform", name |-> "follow_coast", plan |-> 0, at |-> at ] >> >> >> >>
      [] OTHER -> << >>
  

What TLA+ has no words for is refused, all of it, and nothing is written.

  $ cat > odd.dol <<'END'
  > height = 10
  > place = location 41, -8, height
  > supplier = getSupplier()
  > message supplier.place.latitude
  > END
  $ dolphin tla odd.dol -o out/odd
  odd.dol:2:9: error: cannot be translated to TLA+: a location whose coordinates are not constants
    2 | place = location 41, -8, height
      |         ^^^^^^^^^^^^^^^^^^^^^^^
      hint: the translator computes distances, so it must know the coordinates
  odd.dol:4:9: error: cannot be translated to TLA+: '.latitude' of a value that is not a constant: TLA+ has no such numbers
    4 | message supplier.place.latitude
      |         ^^^^^^^^^^^^^^^^^^^^^^^
  [2]
  $ cat > mission.fleet <<'END'
  > vehicle 'x8-02', { type 'UAV' }
  > reply 'getSupplier', object('supplier')
  > reply 'supplier.number', 1, either(2, [3, 10000000000]), 0.12345678901
  > END
  $ dolphin tla mission.dol -o out/odd
  mission.fleet:3:7: error: cannot be translated to TLA+: 10000000000 is beyond TLC's whole numbers, which have 32 bits
    3 | reply 'supplier.number', 1, either(2, [3, 10000000000]), 0.12345678901
      |       ^^^^^^^^^^^^^^^^^
  mission.fleet:3:7: error: cannot be translated to TLA+: the number 0.123457: TLC's whole numbers, which have 32 bits, cannot hold it as a fraction
    3 | reply 'supplier.number', 1, either(2, [3, 10000000000]), 0.12345678901
      |       ^^^^^^^^^^^^^^^^^
  [2]
  $ ls out
  faults
  model
  supplier
