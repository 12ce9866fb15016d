Several processes look for slacks.

  $ cat > six.dol <<'END'
  > vs = pick { count 6 }
  > met = 0
  > def work() { task('out') >> task('survey') >> action { met++ } >> condition { met == 6 } >> task('back') }
  > execute vs: work() | work() | work() | work() | work() | work()
  > END
  $ for i in 1 2 3 4 5 6; do echo "vehicle 'v$i', { type 'UUV' }"; done > six.fleet
  $ for plan in out survey back; do echo "plan '$plan', { duration 10.min, 20.min }"; done >> six.fleet

What is found is the same.

  $ cat > two.dol <<'END'
  > vs = pick { count 2 }
  > execute vs: task('out') >> task('back') | task('survey')
  > END
  $ grep -v "'v[3-6]'" six.fleet > two.fleet
  $ found() { dolphin time two.dol --slack "$@" | sed 's/, [0-9.]* s, [0-9]* MiB//'; }
  $ found --workers 1 > one; found --workers 2 | diff one - && grep out one
  out     v1       0:00            10:00 to 20:00  0:00   two.dol:2
   0:00                     starts out                  two.dol:2
  20:00                     ends out                    two.dol:2
  its end depends on: two.dol:2:13: out on v1 (20:00), then two.dol:2:28: back on v1 (20:00)
  $ dolphin time six.dol --workers 0
  dolphin: option '--workers': '0' is not a number from 1 on
  Usage: dolphin time [OPTION]… PROG
  Try 'dolphin time --help' or 'dolphin --help' for more information.
  [2]

Ctrl-C ends all of them with what is known; whoever is killed leaves no process behind, and is missed.

  $ python3 time_workers.py 2 six.dol --workers 2 --slack
  SIGINT to the leader 3 ['slack: inconclusive: it was interrupted']
  SIGTERM to the leader -15 []
  SIGKILL to the leader -9 []
  SIGKILL to the worker 3 ['slack: inconclusive: a worker process ended early, killed']
