  $ cd ../../examples
  $ dolphin check rendezvous.dol
  rendezvous.dol: no errors
  rendezvous.fleet: no errors

Every example is free of faults. Two of them end with an error on purpose, which is foreseen.

  $ for program in *.dol; do dolphin check "$program" 2>&1; done | grep -v ': no errors$'
  errors.dol:26:21: warning: a run ends here: index 2 is out of range: a list has 2 elements
    26 | message "deepest: ${depths[2]}"
       |                     ^^^^^^^^^
       hint: found by following the program in its fleet, where no fault happens
  errors.dol: no errors, 1 warning
  release.dol:11:5: warning: a run ends here: could not pick 1 vehicle of type 'UAV': x8-02 is already bound; x8-03 is already bound
    11 | c = pick { type 'UAV'; timeout 30.seconds }
       |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
       hint: found by following the program in its fleet, where no fault happens
  release.dol: no errors, 1 warning

An error of every run is refused, by check alone: exec ends where it comes.

  $ cat > $OLDPWD/far.dol <<'END'
  > def third(xs) { xs[2] }
  > for (n in 1..2) { post first: n }
  > message third([1, 2])
  > END
  $ dolphin check $OLDPWD/far.dol 2>&1 | sed 's|.*/far|far|'
  far.dol:1:17: error: index 2 is out of range: a list has 2 elements
    1 | def third(xs) { xs[2] }
      |                 ^^^^^
  far.dol: 1 error
  $ dolphin check $OLDPWD/far.dol > /dev/null 2>&1
  [2]

Faults of the program and of the fleet are told together.

  $ cat > both.dol <<'EOF'
  > x = unknwon
  > EOF
  $ echo "plan 'survey1', { duration 9.min, 3.min }" > both.fleet
  $ dolphin check both.dol
  both.dol:1:5: error: unknown name 'unknwon'
    1 | x = unknwon
      |     ^^^^^^^
  both.dol: 1 error
  both.fleet:1:35: error: this range is reversed: from 540 to 180 seconds
    1 | plan 'survey1', { duration 9.min, 3.min }
      |                                   ^^^^^
      hint: the shortest time comes first, as in duration 3.min, 9.min
  both.fleet: 1 error
  [2]

Plans that look like a misspelling of the fleet's are pointed out.

  $ cat > plans.dol <<'EOF'
  > v = pick { type 'UUV' }
  > def dive(i) { imcPlan('dvie') >> imcPlan('dive' + i) }
  > execute v: dive(1) >> task('surface') >> task('survey3')
  > EOF
  $ cat > plans.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > plan 'dive'
  > plan 'survey2'
  > EOF
  $ dolphin check plans.dol
  plans.dol:2:23: warning: the fleet does not have plan 'dvie'
    2 | def dive(i) { imcPlan('dvie') >> imcPlan('dive' + i) }
      |                       ^^^^^^
      hint: did you mean 'dive'?
  plans.dol: no errors, 1 warning
  plans.fleet: no errors

Warnings alone are no failure.

  $ echo "imcPlan('a') >> imcPlan('b')" > warning.dol
  $ dolphin check warning.dol
  warning.dol:1:1: warning: this task is made but not executed
    1 | imcPlan('a') >> imcPlan('b')
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      hint: write execute before it, or give it a name
  warning.dol: no errors, 1 warning
