Another program for a run that goes on.

  $ cat > a.dol << 'END'
  > input 'go'
  > v = pick { count 1 }
  > execute v: task('survey1') >> waitFor { consume go: true } then task('survey1')
  > END
  $ sed "s/then task('survey1')/then task('survey2')/" a.dol > b.dol
  $ echo "message 'the new way'" >> b.dol
  $ sed "s/v: task('survey1')/v: task('survey2')/" a.dol > c.dol
  $ echo "fence depth 10.m" | cat a.dol - > fenced.dol
  $ cat > f.fleet << 'END'
  > vehicle 'noptilus-1', { type 'UUV'; at 41.185, -8.706 }
  > plan 'survey1', { duration 10.seconds }
  > plan 'survey2', { duration 10.seconds }
  > input 'go', true, after 40.hours
  > END
  $ started() { while [ ! -S "$1.sock" ]; do sleep 0.05; done; }
  $ dolphin exec a.dol --sim=f.fleet --speed 100 --journal a.run > log 2>&1 &
  $ started a.run
  $ while ! grep -q ends log; do sleep 0.05; done

A program of which the run so far is not the beginning is refused, and so is one that is wrong, or has other fences:

  $ dolphin replace ./a.run c.dol 2>&1 | sed 's/, at [0-9:]*:/, at TIME:/'
  dolphin: ./a.run: line 6 does not belong to a run: transition 3, at TIME: start(noptilus-1, survey1)
    no transition is like this one; the nearest differs: "label" should be "start(noptilus-1, survey2)", not "start(noptilus-1, survey1)"
    enabled then: start(noptilus-1, survey2)
    awaited then: nothing
    before it: 3 transitions of a run
  $ dolphin replace ./a.run none.dol
  dolphin: none.dol: No such file or directory
  [2]
  $ dolphin replace ./a.run fenced.dol --force
  dolphin: $TESTCASE_ROOT/fenced.dol: its fences differ: a run goes on with the fences that it began with
  [2]
  $ dolphin replace none.run b.dol
  dolphin: no run 'none.run': dolphin runs lists them
  [2]

A program that can go wrong from here on is refused, unless by force:

  $ sed "s/^message.*/execute condition { poll never: 1 }/" b.dol > wrong.dol
  $ dolphin replace ./a.run wrong.dol > report
  dolphin: the run goes on with the program that it has; --force replaces it all the same
  [1]
  $ head -2 report | sed 's/from [0-9:]* of/from TIME of/'
  from TIME of ./a.run, after 5 transitions
  no deadlock: violated after 5 steps: nothing can happen any more, and the program has not ended

The run goes on with the new program, and then with another one:

  $ dolphin replace ./a.run wrong.dol --force | sed 's/at .*:/at TIME:/'
  replaced at TIME: the run goes on with wrong.dol
  $ dolphin replace ./a.run b.dol | sed 's/at .*:/at TIME:/'
  replaced at TIME: the run goes on with b.dol
  $ dolphin post ./a.run | sed 's/.*b.dol, at .*/b.dol, at TIME/'
  b.dol, at TIME
  input 'go'
  $ dolphin post ./a.run go
  $ wait
  $ cut -c 10- log | sed 's/goes on with .*\//goes on with /'
  program     picks noptilus-1
  noptilus-1  starts survey1
  noptilus-1  ends survey1
  program     the run goes on with wrong.dol
  program     the run goes on with b.dol
  program     gets go:true
  program     consumes go:true
  noptilus-1  starts survey2
  noptilus-1  ends survey2
  program     says: the new way
  program     releases noptilus-1
  program     ends
  $ dolphin trace check b.dol a.run 2>/dev/null | sed 's/ in [0-9:]*;/ in TIME;/'
  a.run: a run, of 11 transitions in TIME; completed
  $ dolphin replace ./a.run b.dol
  dolphin: ./a.run: this run is over: it ended completed
  [2]

A console that dies is resumed with the program that replaced its own:

  $ dolphin exec a.dol --sim=f.fleet --speed 100 --journal d.run > log 2>&1 & echo $! > pid
  $ started d.run
  $ while ! grep -q ends log; do sleep 0.05; done
  $ dolphin replace ./d.run b.dol | sed 's/at .*:/at TIME:/'
  replaced at TIME: the run goes on with b.dol
  $ kill -9 $(cat pid)
  $ dolphin exec --resume d.run a.dol 2>&1 | head -1 | cut -c 1-72
  dolphin: d.run: this run was of another program, or the program has chan
  $ dolphin exec --resume d.run b.dol --speed 1000 2>/dev/null > log & 
  $ started d.run
  $ while ! dolphin post ./d.run go 2>/dev/null; do sleep 0.05; done
  $ wait
  $ cut -c 10- log
  program     gets go:true
  program     consumes go:true
  noptilus-1  starts survey2
  noptilus-1  ends survey2
  program     says: the new way
  program     releases noptilus-1
  program     ends

Its parameters are those of the replacement, too:

  $ cat > p.dol << 'END'
  > parameter n = 1
  > input 'go'
  > execute condition { consume go: true }
  > message n
  > END
  $ dolphin exec p.dol --sim=f.fleet --speed 100 --journal p.run > log 2>&1 & echo $! > pid
  $ started p.run
  $ dolphin replace ./p.run p.dol --set n=2 | sed 's/at .*:/at TIME:/'
  replaced at TIME: the run goes on with p.dol
  $ kill -9 $(cat pid)
  $ dolphin exec --resume p.run p.dol --speed 1000 2>/dev/null > log &
  $ started p.run
  $ while ! dolphin post ./p.run go 2>/dev/null; do sleep 0.05; done
  $ wait
  $ cut -c 10- log
  program     gets go:true
  program     consumes go:true
  program     says: 2
  program     ends
