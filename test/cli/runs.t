Runs that are kept have a home.

  $ export XDG_STATE_HOME=$PWD/state
  $ dolphin runs
  no run has been kept: dolphin exec --keep keeps one
  $ cat > mission.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('survey')
  > EOF
  $ dolphin exec mission.dol --keep > /dev/null
  $ dolphin runs | sed 's/^2[^ ]*Z-/DATE-/; s/Z-//'
  RUN                         PROGRAM      PLATFORM  STATE      TIME
  DATE-mission  mission.dol  sim       completed  2:04
  $ dolphin trace check mission.dol state/dolphin/runs/*.run | sed 's/.*: a run/a run/'
  a run, of 6 transitions in 2:04; completed
  $ dolphin runs show | sed "s|$PWD||; s|/2.*Z-|/DATE-|" | head -4
  /state/dolphin/runs/DATE-mission.run
  
      time  program                            noptilus-1
      0:00  looks for 1 vehicle of type 'UUV'

One that broke off is told from one that ended.

  $ cp state/dolphin/runs/*.run whole
  $ head -n 4 whole > state/dolphin/runs/1999-broken.run
  $ echo nonsense > state/dolphin/runs/2000-other.run
  $ dolphin runs | tail -n +3 | sed 's/  */ /g'
  1999-broken mission.dol sim broke off 0:00
  $ dolphin runs show 1999 | tail -n 1
            picks noptilus-1                   picked
  $ dolphin runs show 1998
  dolphin: no run '1998': dolphin runs lists them
  [2]

Where nothing names the folder (a relative path does not), or it cannot be read, nobody knows what was kept.

  $ XDG_STATE_HOME=state env -u HOME dolphin runs
  dolphin: runs have no folder: the environment has neither HOME nor XDG_STATE_HOME, an absolute path
  [3]
  $ XDG_STATE_HOME=state env -u HOME dolphin post latest go
  dolphin: runs have no folder: the environment has neither HOME nor XDG_STATE_HOME, an absolute path
  [3]
  $ mkdir -p other/dolphin
  $ touch other/dolphin/runs
  $ XDG_STATE_HOME=$PWD/other dolphin runs show
  dolphin: $TESTCASE_ROOT/other/dolphin/runs: Not a directory
  [3]

A folder that cannot be made is told before the run.

  $ XDG_STATE_HOME=$PWD/mission.dol/state dolphin exec mission.dol --keep
  dolphin: $TESTCASE_ROOT/mission.dol/state/dolphin/runs: Not a directory
  [3]

Its journal has one place.

  $ dolphin exec mission.dol --keep --journal mission.run
  dolphin: --keep excludes --journal, --resume and --follow
  [2]

Runs that begin in one second have names of their own: eight times six at once are all kept, and all are whole.

  $ export XDG_STATE_HOME=$PWD/crowded
  $ for round in 1 2 3 4 5 6 7 8; do
  >   for i in 1 2 3 4 5 6; do dolphin exec mission.dol --keep > /dev/null 2>> errors || echo failed & done
  >   wait
  > done
  $ cat errors
  $ ls crowded/dolphin/runs | sort -u | wc -l
  48
  $ for run in crowded/dolphin/runs/*; do dolphin trace check mission.dol $run > /dev/null || echo $run; done
