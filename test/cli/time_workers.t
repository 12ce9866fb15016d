Several processes look for the times of a program: the earliest and the latest dates at once, and slacks.

  $ cat > six.dol <<'END'
  > vs = pick { count 6 }
  > met = 0
  > def work() { task('out') >> task('survey') >> action { met++ } >> condition { met == 6 } >> task('back') }
  > execute vs: work() | work() | work() | work() | work() | work()
  > END
  $ for i in 1 2 3 4 5 6; do echo "vehicle 'v$i', { type 'UUV' }"; done > six.fleet
  $ for plan in out survey back; do echo "plan '$plan', { duration 10.min, 20.min }"; done >> six.fleet

What is found is the same.

  $ found() { dolphin time "$@" | sed 's/, [0-9.]* s, [0-9]* MiB//'; }
  $ found six.dol --workers 1 > one; found six.dol --workers 2 | diff one - && grep states one
  718 states, depth 47
  $ dolphin time six.dol --workers 0
  dolphin: option '--workers': '0' is no number from 1 on
  Usage: dolphin time [OPTION]… PROG
  Try 'dolphin time --help' or 'dolphin --help' for more information.
  [2]

Ctrl-C ends all of them with what is known; whoever is killed leaves no process behind, and is missed.

  $ cp ../../examples/missions/barrier.* .
  $ python3 time_workers.py 1 barrier.dol --workers 2
  SIGINT to the leader 3 ['inconclusive: it was interrupted']
  SIGTERM to the leader -15 []
  SIGKILL to the leader -9 []
  SIGKILL to the worker 3 ['inconclusive: a worker process ended early, killed']

  $ python3 time_workers.py 2 six.dol --workers 2 --slack
  SIGINT to the leader 3 ['slack: inconclusive: it was interrupted']
  SIGTERM to the leader -15 []
  SIGKILL to the leader -9 []
  SIGKILL to the worker 3 ['slack: inconclusive: a worker process ended early, killed']
