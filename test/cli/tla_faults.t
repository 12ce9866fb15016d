What `dolphin tla` makes of faults.

  $ cat > pick.dol <<'END'
  > v = pick { type 'UUV' }
  > execute task('survey')[v]
  > END
  $ cat > pick.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV'; joins 30.seconds }
  > END
  $ faults() { dolphin tla pick.dol -o model "$@" && grep -E '^MC(Failures|Losses|Latecomers|MayBeLate) ==' model/MC.tla && grep Interr model/MC.cfg; }
  $ faults
  MCFailures == -1
  MCLosses == 0
  MCLatecomers == 0
  MCMayBeLate == { "b" }
    Interruptions = FALSE
  $ faults --faults fail=2,loss=1,join
  MCFailures == 2
  MCLosses == 1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    Interruptions = FALSE
  $ faults --faults all
  MCFailures == -1
  MCLosses == -1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    Interruptions = FALSE
  $ faults --faults all,interrupt
  MCFailures == -1
  MCLosses == -1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    Interruptions = TRUE
  $ faults --faults lose
  dolphin: option '--faults': there is no fault 'lose': did you mean loss?
  Usage: dolphin tla [OPTION]… PROG
  Try 'dolphin tla --help' or 'dolphin --help' for more information.
  [2]

Sensors that show one of several values are not in the model.

  $ cat > pick.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV'; battery 80.percent, 10.percent }
  > vehicle 'c', { type 'UUV'; at 41.185, -8.706
  >                at 41.2, -8.7 }
  > END
  $ dolphin tla pick.dol -o model
  pick.fleet:2:9: error: the model in TLA+ has no sensors that show one of several values: 'battery' of b
    2 | vehicle 'b', { type 'UUV'; battery 80.percent, 10.percent }
      |         ^^^
      hint: leave one value of battery; dolphin explore follows them all
  pick.fleet:3:9: error: the model in TLA+ has no sensors that show one of several values: 'at' of c
    3 | vehicle 'c', { type 'UUV'; at 41.185, -8.706
      |         ^^^
      hint: leave one value of at; dolphin explore follows them all
  [2]
