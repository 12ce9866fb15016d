Many simulated runs.

  $ cat > relay.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: (watch imcPlan('survey') onError { retry() }) >> imcPlan('home')
  > END
  $ cat > relay.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'survey', { duration 4.min, 7.min; mayFail 0.3 }
  > plan 'home', { duration 90.seconds; mayFail 0.05 }
  > END
  $ timeless() { sed 's/, [0-9.]* s$/, T/; s/"elapsed":[0-9.e-]*/"elapsed":T/'; }
  $ COLUMNS=60 dolphin exec relay.dol --runs 400 | timeless
  400 runs, seeds 0 to 399, T
  runs    share  95 % confidence     seed  end
   385  96.25 %  93.89 % to 97.89 %     0  completed
    15   3.75 %  2.11 % to 6.11 %       7  failed: relay.dol:2: home failed on a: plan failed
  
  completed     first       5 %      50 %       95 %       last
             5:30.513  5:40.711  7:38.847  14:42.891  21:57.053
             seed 182                                  seed 278
  
  4:00 to 6:00     46  #########
  6:00 to 8:00    189  #######################################
  8:00 to 10:00    80  #################
  10:00 to 12:00   32  #######
  12:00 to 14:00   14  ###
  14:00 to 16:00   14  ###
  16:00 to 18:00    5  #
  18:00 to 20:00    3  #
  20:00 to 22:00    2  #
  
  task    vehicle  began  ended  failed  in runs  where
  survey  a          598    400     198      131  relay.dol:2
  home    a          400    385      15       15  relay.dol:2
  
  handler      ran  in runs
  relay.dol:2  198      131

The same, whoever makes them, and for programs.

  $ dolphin exec relay.dol --runs 400 --jobs 1 | timeless > one
  $ dolphin exec relay.dol --runs 400 --jobs 3 | timeless | diff one -
  $ dolphin exec relay.dol --runs 20 --json | timeless | python3 -c '
  > import json, sys
  > o = json.loads(sys.stdin.read().replace(":T", ":0"))
  > print(o["runs"], o["seed"], o["stopped by"], o["confidence"])
  > for part in ("ends", "tasks", "handlers"):
  >   for x in o[part]: print(x)
  > print(sorted(o["completed"]), sum(b["runs"] for b in o["completed"]["histogram"]))'
  20 0 runs 0.95
  {'end': 'completed', 'runs': 18, 'least': 0.683017, 'most': 0.987651, 'seed': 0}
  {'end': 'failed', 'runs': 2, 'least': 0.012349, 'most': 0.316983, 'seed': 7, 'message': 'home failed on a: plan failed', 'at': 'relay.dol:2:61'}
  {'task': 'survey', 'vehicle': 'a', 'at': 'relay.dol:2:19', 'began': 30, 'ended': 20, 'failed': 10, 'runs failed': 7, 'stopped': 0}
  {'task': 'home', 'vehicle': 'a', 'at': 'relay.dol:2:61', 'began': 20, 'ended': 18, 'failed': 2, 'runs failed': 2, 'stopped': 0}
  {'at': 'relay.dol:2:12', 'ran': 10, 'runs': 7}
  ['5%', '50%', '95%', 'first', 'histogram', 'last'] 18

Each of them as a line: made in parts, on several machines perhaps, and counted together.

  $ dolphin exec relay.dol --runs 250 --each > first
  $ dolphin exec relay.dol --seed 250 --runs 150 --each --jobs 3 > second
  $ head -2 first | sed 's/"version":"[^"]*"/"version":"..."/; s/"[0-9a-f]\{32\}"/"<digest>"/g; s/\("seconds":[0-9]*\)[.0-9]*/\1/'
  {"dolphin":"runs","version":"...","program":"<digest>","fleet":"<digest>","set":{},"answers":[]}
  {"seed":0,"end":"completed","seconds":394,"tasks":[{"task":"survey","vehicle":"a","at":"relay.dol:2:19","site":14,"began":2,"ended":1,"failed":1,"stopped":0},{"task":"home","vehicle":"a","at":"relay.dol:2:61","site":21,"began":1,"ended":1,"failed":0,"stopped":0}],"handlers":[{"at":"relay.dol:2:12","site":15,"ran":1}]}
  $ tail -n +2 second | grep -m 1 -o '^.*"end":"failed".*"seconds"'
  {"seed":282,"end":"failed","message":"home failed on a: plan failed","cause":"task","vehicle":"a","task":"home","at":"relay.dol:2:61","site":21,"seconds"
  $ cat first second | dolphin exec relay.dol --runs-from - | timeless | diff one -
  $ dolphin exec relay.dol --runs-from first --json --draw first.svg | grep -o '"runs":250,"seed":0'
  "runs":250,"seed":0
  $ grep -o '[0-9]* of 250 runs completed' first.svg
  242 of 250 runs completed

What is no such file, or lacks runs, is not counted.

  $ cat second first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:153: the run with the seed 400 is to follow that with 399
  [2]
  $ grep -v '"seed":7,' first > gap; dolphin exec relay.dol --runs-from gap
  dolphin: gap:9: the run with the seed 7 is to follow that with 6
  [2]
  $ tail -n +2 first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:1: before the first run there is to be the header: all that --each has printed
  [2]
  $ head -1 first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:2: it has no runs
  [2]
  $ cp relay.fleet other.fleet; echo "vehicle 'b', { type 'UUV' }" >> other.fleet
  $ dolphin exec relay.dol --fleet other.fleet --runs-from first
  dolphin: first:1: these are runs of another program, fleet or version of Dolphin, or with other parameters or answers
  [2]
  $ head -c 300 first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:2: this is not JSON
  [2]
  $ sed 's/"end":"completed"/"end":"well"/' first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:2: 'well' is not an ending of a run
  [2]
  $ sed 's/"ended":1/"ended":"one"/' first > other; dolphin exec relay.dol --runs-from - < other
  dolphin: standard input:2: "tasks" is "ended" is "one", not a whole number
  [2]
  $ dolphin exec relay.dol --runs-from none
  dolphin: none: No such file or directory
  [2]
  $ dolphin exec relay.dol --runs-from .
  dolphin: .: Is a directory
  [2]

One of them by itself.

  $ dolphin exec relay.dol --seed 17 | tail -1
     5:46  program     ends

Until it is known.

  $ dolphin exec relay.dol --until 0.05 | timeless | head -3
  100 runs, seeds 0 to 99, T
  the share of those that complete is known to within 0.05
  runs    share  95 % confidence     seed  end
  $ dolphin exec relay.dol --until 0.01 --runs 120 --seed=-7 | timeless | head -2
  120 runs, seeds -7 to 112, T
  the share of those that complete is not known to within 0.01 yet

When they are over, as a picture: the bars have all runs that completed.

  $ dolphin exec relay.dol --runs 100 --draw times.svg > /dev/null
  $ python3 -c '
  > import xml.etree.ElementTree as tree
  > svg = "{http://www.w3.org/2000/svg}"
  > tips = [e.find(svg + "title").text for e in tree.parse("times.svg").iter(svg + "rect") if e.get("class") == "bar v0"]
  > print(sum(int(tip.split()[0]) for tip in tips))'
  98
  $ grep -o '[0-9]* of 100 runs completed' times.svg
  98 of 100 runs completed
  $ dolphin exec relay.dol --runs 10 --draw times.html > /dev/null
  $ grep -c '<svg' times.html
  1

What does not go together.

  $ dolphin exec relay.dol --runs 0 2>&1 | head -1
  dolphin: option '--runs': '0' is not a whole number greater than 0
  $ dolphin exec relay.dol --until 1 2>&1 | head -1
  dolphin: option '--until': '1' is not a number between 0 and 0.5
  $ dolphin exec relay.dol --json 2>&1 | head -1
  dolphin: --jobs, --json and --each go with --runs or --until
  $ dolphin exec relay.dol --runs-from first --runs 3 2>&1 | head -1
  dolphin: --runs-from makes no runs: it excludes --runs, --until, --jobs and --each
  $ dolphin exec relay.dol --runs-from first --seed 3
  dolphin: --runs-from makes no runs: --seed has no use
  [2]
  $ dolphin exec relay.dol --runs 3 --each --json 2>&1 | head -1
  dolphin: --json is one answer, --each a line for each run: give one of them
  $ dolphin exec relay.dol --runs 3 --each --draw runs.svg
  dolphin: --each prints runs and draws none: use --runs-from to draw them
  [2]
  $ dolphin exec relay.dol --runs 3 --journal relay.run
  dolphin: many runs (--runs, --until) have one answer: of the other options only --fleet, --sim, --set, --begins, --zone, --seed, --answer and --draw are allowed
  [2]
  $ dolphin exec relay.dol --runs 3 --quiet
  dolphin: many runs (--runs, --until) have one answer: of the other options only --fleet, --sim, --set, --begins, --zone, --seed, --answer and --draw are allowed
  [2]
  $ dolphin exec relay.dol --runs 3 --speed 2
  dolphin: --runs and --until are for simulated runs, as fast as they go: without --imc, --platform and --speed
  [2]

Ctrl-C ends it with what is known, also while a run goes on for ever; whoever is killed leaves no process behind.

  $ cat > endless.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: repeat { idle(90) }
  > END
  $ echo "vehicle 'a', { type 'UUV' }" > endless.fleet
  $ python3 many_runs.py
  SIGINT 130 ['0 runs', 'interrupted; under way were the runs with the seeds 0, 1']
  SIGTERM 130 ['0 runs', 'interrupted; under way were the runs with the seeds 0, 1']
  SIGKILL -9 []

Processes that the system does not let begin are an error of the surroundings, not a fault of dolphin.

  $ (ulimit -n 12; dolphin exec relay.dol --runs 400 --jobs 40)
  dolphin: the 40 processes that simulate runs cannot be started: pipe: Too many open files
  [3]

Nor is memory that it does not give.

  $ for kilobytes in $(seq 28000 1000 44000); do
  >   (ulimit -v $kilobytes; dolphin explore relay.dol --reduction none > found 2>&1; [ $? = 125 ] && head -n 1 found) 2> aborted
  > done
  > true

The programs that ran did what the semantics allows.

  $ check-journals
