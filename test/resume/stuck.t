A run that is stuck ends so, with status 1, also if its console dies while vehicles are on their way home: here it dies
after each line of the journal.

  $ cat > stuck.dol <<'END'
  > onInterrupt task('home')
  > v = pick { type 'UUV' }
  > execute task('out') >> condition { poll never: 1 }
  > END
  $ printf "vehicle 'u', { type 'UUV' }\nplan 'home', { duration 1.min }\n" > stuck.fleet
  $ dolphin exec stuck.dol --journal whole.run > whole.log 2> whole.errors
  [1]
  $ tail -n 1 whole.log | cut -c 10-; cat whole.errors
  program     is stuck
  stuck.dol:3:34: error: the program is stuck: nothing can make this condition true any more
    3 | execute task('out') >> condition { poll never: 1 }
      |                                  ^^^^^^^^^^^^^^^^^
  $ resumed() {
  >   for n in $(grep -n '"kind"' $1.run | sed '1d; $d' | cut -d: -f1); do
  >     head -n $n $1.run > died.run
  >     dolphin exec --resume died.run $2 > second.log 2> errors; echo "status $?, $(tail -n 1 second.log | cut -c 9-)"
  >     dolphin trace check $2 died.run | sed 's/a run, .*; //'
  >   done | sort | uniq -c | sed 's|^ *[0-9]*||'
  > }
  $ resumed whole stuck.dol
   died.run: stuck
   status 1, 
   status 1,  program     is stuck

So does one whose rounds follow each other without a wait, and one that is stuck beside an input.

  $ sed 's/condition .*/action { post go: 1 } >> repeat waitFor { consume go: 1 } then action { post go: 1 }/' stuck.dol > spins.dol; cp stuck.fleet spins.fleet
  $ dolphin exec spins.dol --journal spins.run > spins.log 2> errors
  [1]
  $ tail -n 1 spins.log | cut -c 10-
  program     is stuck
  $ dolphin trace check spins.dol spins.run | sed 's/a run, .*; //'
  spins.run: stuck
  $ grep -n '"interruption"' spins.run | cut -d: -f1 > at
  $ head -n $(($(cat at) + 3)) spins.run > died.run
  $ dolphin exec --resume died.run spins.dol > second.log 2> errors
  [1]
  $ dolphin trace check spins.dol died.run | sed 's/a run, .*; //'
  died.run: stuck
  $ (echo "input 'abort'"; cat stuck.dol) > beside.dol; cp stuck.fleet beside.fleet
  $ dolphin exec beside.dol --journal beside.run > beside.log 2> errors
  [1]
  $ resumed beside beside.dol
   died.run: stuck
   status 1, 
   status 1,  program     is stuck

A way home that fails is the end of the run, for the log, the journal and the status.

  $ sed 's/}$/; fails }/' stuck.fleet | sed "s/'UUV' ; fails/'UUV'/" > lost.fleet; cat lost.fleet; cp stuck.dol lost.dol
  vehicle 'u', { type 'UUV' }
  plan 'home', { duration 1.min ; fails }
  $ dolphin exec lost.dol --journal lost.run > lost.log 2> errors
  [1]
  $ tail -n 1 lost.log | cut -c 10-
  program     fails: home failed on u: plan failed
  $ dolphin trace check lost.dol lost.run | sed 's/a run, .*; //'
  lost.run: failed: home failed on u: plan failed
  $ resumed lost lost.dol
   died.run: failed: home failed on u: plan failed
   status 1, 
   status 1,  program     fails: home failed on u: plan failed

What was interrupted from outside ends as interrupted.

  $ cat > asked.dol <<'END'
  > onInterrupt task('home')
  > v = pick { type 'UUV' }
  > execute task('out')
  > END
  $ printf "vehicle 'u', { type 'UUV' }\nplan 'home', { duration 1.min }\nplan 'out', { duration 1.hour }\n" > asked.fleet
  $ dolphin exec asked.dol --speed 60 --journal asked.run > asked.log & run=$!
  $ until grep -qs 'starts out' asked.log; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ sed -i 's/"speed":60/"speed":10000/' asked.run
  $ n=$(grep -n '"interruption"' asked.run | cut -d: -f1)
  $ for n in $(seq $n $(($(wc -l < asked.run) - 1))); do
  >   head -n $n asked.run > died.run
  >   dolphin exec --resume died.run asked.dol > second.log 2> errors; echo "status $?, $(tail -n 1 second.log | cut -c 9-)"
  >   dolphin trace check asked.dol died.run | sed 's/a run, .*; //'
  > done | sort | uniq -c | sed 's|^ *[0-9]*||'
   died.run: interrupted
   status 130, 
   status 130,  program     is interrupted
