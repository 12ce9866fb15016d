A program may include others. A file is named relative to the one that includes it, and is read once.

  $ mkdir lib
  $ cat > mission.dol <<'END'
  > include 'lib/surveys.dol'
  > include './lib/../lib/limits.dol'
  > v = pick { type 'UUV' }
  > message "$rounds rounds"
  > execute survey('east')[v]
  > broken()
  > END
  $ cat > lib/surveys.dol <<'END'
  > include 'limits.dol'
  > def survey(name) { waitFor { rounds > 2 } then imcPlan('survey_' + name) }
  > END
  $ cat > lib/limits.dol <<'END'
  > // Said once.
  > message 'limits'
  > rounds = 3
  > def broken() {
  >     1 / 0
  > }
  > END
  $ cat > one.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'survey_east', { duration 1.min }
  > END

Errors name the file and the line that they are of, at run time too.

  $ dolphin exec mission.dol --fleet one.fleet --journal mission.run
     0:00  program     says: limits
     0:00  program     picks a
     0:00  program     says: 3 rounds
     0:00  program     sees that a condition holds
     0:00  a           starts survey_east
     1:00  a           ends survey_east
     1:00  program     releases a
     1:00  program     fails: division by zero
  lib/limits.dol:5:5: error: division by zero
    5 |     1 / 0
      |     ^^^^^
  [1]
  $ dolphin trace check mission.dol mission.run
  mission.run: a run, of 9 transitions in 1:00; failed: division by zero

Places in a journal name the file, unless it is the program's own, seen from its folder.

  $ grep -o '"at":"[^"]*"' mission.run | uniq
  "at":"lib/limits.dol:2:1"
  "at":"3:5"
  "at":"4:1"
  "at":"5:1"
  "at":"lib/surveys.dol:2:48"
  "at":"lib/limits.dol:5:5"
  $ dolphin trace show mission.run --transitions | sed -n 1,2p
       0      0:00  lib/limits.dol:2:1  MESSAGE  message 'limits'
       1      0:00  3:5      PICK  pick(1 vehicle of type 'UUV')
  $ (cd lib && dolphin exec ../mission.dol --fleet ../one.fleet --journal other.run 2> /dev/null | tail -1)
     1:00  program     fails: division by zero
  $ grep -o '"at":"[^"]*"' lib/other.run | uniq | grep lib | uniq
  "at":"lib/limits.dol:2:1"
  "at":"lib/surveys.dol:2:48"
  "at":"lib/limits.dol:5:5"
  $ dolphin trace check mission.dol lib/other.run | tail -1
  lib/other.run: a run, of 9 transitions in 1:00; failed: division by zero

What a journal was written with, is what was included as well.

  $ sed -i 's/rounds = 3/rounds = 4/' lib/limits.dol
  $ dolphin trace check mission.dol mission.run
  dolphin: mission.dol is not the program of this run, or has changed since: places are not compared
  mission.run: line 6 does not belong to a run: transition 3, at 4:1: message '3 rounds'
    no transition is like this one; the nearest differs: "label" should be "message '4 rounds'", not "message '3 rounds'"
    enabled then: message '4 rounds'
    awaited then: nothing
    before it: 3 transitions of a run
  [1]

  $ echo "x = nope" >> lib/limits.dol
  $ dolphin check mission.dol
  lib/limits.dol:7:5: error: unknown name 'nope'
    7 | x = nope
      |     ^^^^
      hint: did you mean 'now'?
  mission.dol: 1 error
  [2]

Cycles, missing files, and words that are no name of a file are told.

  $ echo "include 'other.dol'" > cycle.dol
  $ echo "include 'cycle.dol'" > other.dol
  $ dolphin check cycle.dol
  other.dol:1:9: error: files that include each other: cycle.dol includes other.dol includes cycle.dol
    1 | include 'cycle.dol'
      |         ^^^^^^^^^^^
  cycle.dol: 1 error
  [2]
  $ printf "include 'nowhere.dol'\ninclude lib\n" > missing.dol
  $ dolphin check missing.dol
  missing.dol:1:9: error: cannot be included: nowhere.dol: No such file or directory
    1 | include 'nowhere.dol'
      |         ^^^^^^^^^^^^^
  missing.dol:2:1: error: include takes the name of a file
    2 | include lib
      | ^^^^^^^^^^^
      hint: write include 'lib.dol'
  missing.dol: 2 errors
  [2]
  $ printf "if (true) { include 'lib/limits.dol' }\n" > inside.dol
  $ dolphin check inside.dol
  inside.dol:1:13: error: unknown name 'include'
    1 | if (true) { include 'lib/limits.dol' }
      |             ^^^^^^^
      hint: include 'lib.dol' stands at the top of a file, outside of all braces
  inside.dol: 1 error
  [2]

The prelude comes with the command. A program may have its name; a function that both define is told of.

  $ cat > prelude <<'END'
  > include 'prelude'
  > execute par([action { message 1 }, action { message 2 }])
  > three = [3][0]
  > execute par(three)
  > END
  $ dolphin exec prelude --fleet one.fleet
     0:00  program     says: 1
     0:00  program     says: 2
     0:00  program     fails: a number has no method 'tail'
  <prelude>:19:12: error: a number has no method 'tail'
    19 |     return tasks.tail().inject(tasks[0]) { beside, t -> beside | t }
       |            ^^^^^^^^^^^^
       hint: this is an error in par of the prelude, called at prelude:2:9 or prelude:4:9
  [1]

An error in the prelude is shown at the call of the program that leads there, with the function; also numbers and lists
that make no sense.

  $ cat > two.fleet <<'END'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > END
  $ for call in 'race([])' 'seq([])' 'par([])' 'patrol([])' 'forall([])_{_v_->_idle(1)_}' "leader('a',[])" \
  >     "follower('a',[])" 'handOver([],idle(1))_{_v_->_true_}' 'parallel(0,[idle(1)])' 'parallel(1.5,[idle(1)])' \
  >     'atLeast(0,[idle(1)])' 'atLeast(0.5,[idle(1)])' 'atLeast(1.5,[idle(1),idle(1)])' 'atLeast(2,[idle(1)])' \
  >     'retrying(0,idle(1))' 'retrying(-1,idle(1))' 'retrying(2.5,idle(1))' 'every(-1,idle(1))' \
  >     "barrier('x',0)" "barrier('x',-1)" "barrier('x',1.5)" \
  >     'idle(near(v[0],v,-1).size())' 'team(0,1,v,[1])_{_g_->_idle(1)_}' 'team(2,1,v,[1])_{_g_->_idle(1)_}' \
  >     'team(3,3,v,[1])_{_g_->_idle(1)_}' 'team(1.5,2,v,[1])_{_g_->_idle(1)_}' \
  >     'team(1,1.5,v,[1])_{_g_->_idle(1)_}'; do
  >   printf "include 'prelude'\nv = pick { count 2 }\nmessage 1\nexecute $call\n" | tr _ ' ' > none.dol
  >   dolphin exec none.dol --fleet two.fleet 2>&1 > log | sed -n '1p;$p'
  > done
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in atLeast of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in seq of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in par of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in seq of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in par of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in seq of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in seq of the prelude
  none.dol:4:9: error: the list of tasks is empty
      hint: this is an error in seq of the prelude
  none.dol:4:9: error: parallel runs a whole number of tasks at once, at least 1, not 0
      hint: this is an error in parallel of the prelude
  none.dol:4:9: error: parallel runs a whole number of tasks at once, at least 1, not 1.5
      hint: this is an error in parallel of the prelude
  none.dol:4:9: error: atLeast awaits a whole number of tasks, at least 1, not 0
      hint: this is an error in atLeast of the prelude
  none.dol:4:9: error: atLeast awaits a whole number of tasks, at least 1, not 0.5
      hint: this is an error in atLeast of the prelude
  none.dol:4:9: error: atLeast awaits a whole number of tasks, at least 1, not 1.5
      hint: this is an error in atLeast of the prelude
  none.dol:4:9: error: atLeast awaits 2 tasks, and the list has 1
      hint: this is an error in atLeast of the prelude
  none.dol:4:9: error: retrying does its task a whole number of times, at least 1, not 0
      hint: this is an error in retrying of the prelude
  none.dol:4:9: error: retrying does its task a whole number of times, at least 1, not -1
      hint: this is an error in retrying of the prelude
  none.dol:4:9: error: retrying does its task a whole number of times, at least 1, not 2.5
      hint: this is an error in retrying of the prelude
  none.dol:4:9: error: idle takes a time of 0 seconds or more, not -1
      hint: this is an error in every of the prelude
  none.dol:4:9: error: a barrier is for a whole number of tasks, at least 1, not 0
      hint: this is an error in barrier of the prelude
  none.dol:4:9: error: a barrier is for a whole number of tasks, at least 1, not -1
      hint: this is an error in barrier of the prelude
  none.dol:4:9: error: a barrier is for a whole number of tasks, at least 1, not 1.5
      hint: this is an error in barrier of the prelude
  none.dol:4:14: error: a distance is at least 0, not -1
      hint: this is an error in near of the prelude
  none.dol:4:9: error: a team has a whole number of vehicles, at least 1, not 0
      hint: this is an error in team of the prelude
  none.dol:4:9: error: a team of at least 2 vehicles cannot have at most 1
      hint: this is an error in team of the prelude
  none.dol:4:9: error: a team of at least 3 vehicles cannot be made of 2
      hint: this is an error in team of the prelude
  none.dol:4:9: error: a team has a whole number of vehicles, at least 1, not 1.5
      hint: this is an error in team of the prelude
  none.dol:4:9: error: a team has a whole number of vehicles at most, not 1.5
      hint: this is an error in team of the prelude
  $ dolphin exec none.dol --fleet two.fleet | tail -1
  none.dol:4:9: error: a team has a whole number of vehicles at most, not 1.5
    4 | execute team(1,1.5,v,[1]) { g -> idle(1) }
      |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      hint: this is an error in team of the prelude
     0:00  program     fails: a team has a whole number of vehicles at most, not 1.5
  $ dolphin explore none.dol --fleet two.fleet | tail -2
  3   message '1'                               none.dol:3  v = [a, b]
  4   fault(a team has a whole number of vehicles at most, not 1.5)  none.dol:4

Of several calls all are named.

  $ cat > several.dol <<'END'
  > include 'prelude'
  > n = 0
  > def gather(k) {
  >     return barrier('x', k)
  > }
  > execute gather(1) >> barrier('y', n)
  > END
  $ dolphin exec several.dol --fleet two.fleet 2>&1 | grep prelude | sed 's/<prelude>:[0-9]*:[0-9]*:/<prelude>:/'
  <prelude>: error: a barrier is for a whole number of tasks, at least 1, not 0
        hint: this is an error in barrier of the prelude, called at several.dol:4:12 or several.dol:6:22

  $ cat > near.dol <<'END'
  > include 'prelude'
  > v = pick { type 'UUV' }
  > message near(v, 500.m)
  > END
  $ dolphin check near.dol
  near.dol:3:9: error: near takes 3 arguments, not 2
    3 | message near(v, 500.m)
      |         ^^^^^^^^^^^^^^
      hint: write near(v, vs, d)
  near.dol: 1 error
  [2]
  $ cat > race.dol <<'END'
  > include 'prelude'
  > def race(x) { x }
  > END
  $ dolphin check race.dol --fleet one.fleet
  race.dol:2:5: error: function 'race' is defined twice
    2 | def race(x) { x }
      |     ^^^^
  race.dol: 1 error
  one.fleet: no errors
  [2]
