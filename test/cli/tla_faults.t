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
    OnInterrupt <- MCOnInterrupt
    Interruptions = FALSE
  $ faults --faults fail=2,loss=1,join
  MCFailures == 2
  MCLosses == 1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    OnInterrupt <- MCOnInterrupt
    Interruptions = FALSE
  $ faults --faults all
  MCFailures == -1
  MCLosses == -1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    OnInterrupt <- MCOnInterrupt
    Interruptions = FALSE
  $ faults --faults all,interrupt
  MCFailures == -1
  MCLosses == -1
  MCLatecomers == -1
  MCMayBeLate == { "b" }
    OnInterrupt <- MCOnInterrupt
    Interruptions = TRUE
  $ faults --faults lose
  dolphin: option '--faults': unknown fault 'lose': did you mean loss?
  Usage: dolphin tla [OPTION]… PROG
  Try 'dolphin tla --help' or 'dolphin --help' for more information.
  [2]

What sensors show is open, as for `dolphin explore`: anything, or one of the values that the fleet gives; where no code looks, what they
show at the start.

  $ cat > pick.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV'; battery 80.percent, 10.percent }
  > vehicle 'c', { type 'UUV'; at 41.185, -8.706
  >                at 41.2, -8.7 }
  > END
  $ sensors() { dolphin tla pick.dol -o model && grep -o 'id |-> "[a-c]"\|places .*\]' model/MC.tla; }
  $ sensors
  id |-> "a"
  places |-> << 1 >>, position |-> << << "position", 1 >> >>, sensors |-> << >> ]
  id |-> "b"
  places |-> << 2 >>, position |-> << << "position", 2 >> >>, sensors |-> << >> ]
  id |-> "c"
  places |-> << 3, 4 >>, position |-> << << "position", 3 >>, << "position", 4 >> >>, sensors |-> << >> ]
  $ echo 'message battery(v)' >> pick.dol
  $ sensors
  id |-> "a"
  places |-> << 1 >>, position |-> << << "position", 1 >> >>, sensors |-> << [ name |-> "battery", text |-> "battery(a)", shows |-> << >> ] >> ]
  id |-> "b"
  places |-> << 2 >>, position |-> << << "position", 2 >> >>, sensors |-> << [ name |-> "battery", text |-> "battery(b)", shows |-> << << "number", 4, 5 >>, << "number", 1, 10 >> >> ] >> ]
  id |-> "c"
  places |-> << 3, 4 >>, position |-> << << "position", 3 >>, << "position", 4 >> >>, sensors |-> << [ name |-> "battery", text |-> "battery(c)", shows |-> << >> ] >> ]
