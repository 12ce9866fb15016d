An interruption stops what runs and releases the vehicles. The run is paced, so that it lasts.

  $ cat > long.dol <<'EOF'
  > vs = pick { count 2; type 'UUV' }
  > execute imcPlan('left') | imcPlan('right')
  > EOF
  $ cat > long.fleet <<'EOF'
  > vehicle 'a', { type 'UUV' }
  > vehicle 'b', { type 'UUV' }
  > plan 'left', { duration 2.hours }
  > plan 'right', { duration 2.hours }
  > EOF
  $ signal() {  # SIGNAL PATTERN FILE: signals $run once FILE has PATTERN, and waits for its end
  >   until grep -qs -e "$2" "$3" || ! kill -0 $run; do sleep 0.05; done; kill -$1 $run; wait $run
  > }
  $ dolphin exec long.dol --speed 1 > log.txt & run=$!
  $ signal INT 'starts right' log.txt
  [130]
  $ cut -c 10- log.txt
  program     picks a, b
  a           starts left
  b           starts right
  a           stops left
  b           stops right
  program     releases a, b
  program     is interrupted

Other requests to terminate do the same.

  $ dolphin exec long.dol --speed 1 > again.txt & run=$!
  $ signal TERM 'starts right' again.txt
  [130]
  $ tail -1 again.txt | cut -c 10-
  program     is interrupted

So do SIGQUIT, SIGUSR1, SIGUSR2, signals of timers and limits, and real-time signals (here by their numbers): none ends the process while vehicles move. They do so
once: only requests to end can end it at once.

  $ for number in 3 10 12 14 16 24 25 27 29 30 34 50 64; do
  >   rm -f again.txt; dolphin exec long.dol --speed 1 > again.txt & run=$!
  >   signal $number 'starts right' again.txt || echo "$number: $?, $(tail -1 again.txt | cut -c 10-)"
  > done
  3: 130, program     is interrupted
  10: 130, program     is interrupted
  12: 130, program     is interrupted
  14: 130, program     is interrupted
  16: 130, program     is interrupted
  24: 130, program     is interrupted
  25: 130, program     is interrupted
  27: 130, program     is interrupted
  29: 130, program     is interrupted
  30: 130, program     is interrupted
  34: 130, program     is interrupted
  50: 130, program     is interrupted
  64: 130, program     is interrupted
  $ sed 's/^vs/onInterrupt task("left")\nvs/' long.dol > home.dol; cp long.fleet home.fleet
  $ rm -f again.txt; dolphin exec home.dol --speed 1 > again.txt & run=$!
  $ until grep -qs 'starts right' again.txt; do sleep 0.05; done; kill -ALRM $run
  $ until grep -qs 'onInterrupt' again.txt; do sleep 0.05; done; kill -ALRM $run; kill -XCPU $run; sleep 0.2
  $ signal INT 'executes onInterrupt' again.txt
  [130]
  $ tail -3 again.txt | cut -c 10-
  a           stops left
  program     releases a, b
  program     is interrupted

A journal over the limit of file sizes ends the run in the same order; the log is not over it yet.

  $ (ulimit -f 2; exec dolphin exec long.dol --speed 1 --journal limited.run > limited.txt 2> errors.txt)
  [3]
  $ cat errors.txt
  dolphin: the journal cannot be written: limited.run: File too large; the run was ended as by Ctrl-C

A script that loops without any effect can be interrupted, so can one that waits for an answer or for vehicles.

  $ echo 'while (true) { }' > loop.dol
  $ dolphin exec loop.dol --journal loop.run > log.txt & run=$!
  $ signal INT program loop.run
  [130]
  $ cat log.txt
     0:00  program     is interrupted
  $ echo "x = ask 'Well?'" > ask.dol
  $ mkfifo silence; exec 3<> silence
  $ rm -f log.txt; dolphin exec ask.dol <&3 > log.txt & run=$!
  $ signal INT asks log.txt
  [130]
  $ cat log.txt
     0:00  program     asks: Well? 
     0:00  program     is interrupted
  $ echo "v = pick { type 'ROV'; timeout 1.hour }" > pick.dol
  $ dolphin exec pick.dol --speed 1 --journal pick.run > log.txt & run=$!
  $ signal INT program pick.run
  [130]
  $ cut -c 10- log.txt
  program     is interrupted

Code inside of a task that has no end is an error of the program.

  $ echo 'execute action { while (true) { } }' > endless.dol
  $ dolphin exec endless.dol
     0:00  program     has an error in a task: this code does not come to an end, and code inside of a task is atomic
     0:00  program     fails: this code does not come to an end, and code inside of a task is atomic
  endless.dol:1:16: error: this code does not come to an end, and code inside of a task is atomic
    1 | execute action { while (true) { } }
      |                ^^^^^^^^^^^^^^^^^^^^
  [1]

Nor does an interruption wait for a step that takes long. Which of these vehicles do what is a question of Boolean
satisfiability with 200 variables and 1,201 clauses.

  $ for i in $(seq 0 399); do echo "vehicle 'v$i', { type 'UUV' }"; done > hard.fleet
  $ echo "plan 'p', { duration 1.min }" >> hard.fleet
  $ cat > hard.dol <<'EOF'
  > vs = pick { count 400; type 'UUV' }
  > left = task('p')[vs[0] + vs[1]]
  > for (i in 1..199) { left = left >> task('p')[vs[2 * i] + vs[2 * i + 1]] }
  > x = 12345
  > right = task('p')[vs[5] + vs[8] + vs[17]]
  > for (i in 1..1200) {
  >   three = vs[x % 400]
  >   for (j in 1..2) {
  >     x = (x * 16807) % 2147483647
  >     three = three + vs[x % 400]
  >   }
  >   right = right >> task('p')[three]
  > }
  > message 'allocates'
  > execute left | right
  > EOF
  $ for signal in INT TERM XCPU; do
  >   rm -f hard.txt; dolphin exec hard.dol --fleet hard.fleet --journal hard.run > hard.txt & run=$!
  >   until grep -qs allocates hard.txt || ! kill -0 $run; do sleep 0.05; done
  >   sleep 1; kill -$signal $run; (sleep 20; kill -KILL $run) > killer.txt 2>&1 & killer=$!
  >   wait $run; echo "$signal $?"; kill $killer; cut -c 10-40 hard.txt | tail -3
  >   rm hard.run
  > done
  INT 130
  program     says: allocates
  program     releases v0, v1, v2
  program     is interrupted
  TERM 130
  program     says: allocates
  program     releases v0, v1, v2
  program     is interrupted
  XCPU 130
  program     says: allocates
  program     releases v0, v1, v2
  program     is interrupted

The program still executes what it declares for that.

  $ sed -i "1i onInterrupt task('p')" hard.dol
  $ rm -f hard.txt; dolphin exec hard.dol --fleet hard.fleet > hard.txt & run=$!
  $ until grep -qs allocates hard.txt || ! kill -0 $run; do sleep 0.05; done
  $ sleep 1; kill -INT $run; (sleep 20; kill -KILL $run) > killer.txt 2>&1 & killer=$!
  $ wait $run; kill $killer; cut -c 10-40 hard.txt | grep -v ' releases'
  program     picks v0, v1, v2, v
  program     says: allocates
  program     is interrupted: exe
  v0          starts p
  v0          ends p
  program     is interrupted

The second interruption ends the process at once. Here a supplier that ignores the end of its input keeps the first one
waiting.

  $ cat > stubborn.sh <<'EOF'
  > trap '' TERM INT HUP
  > echo > trapped
  > read request
  > sleep 30
  > EOF
  $ echo 'supplier = getSupplier()' > supplier.dol
  $ rm -f log.txt; dolphin exec supplier.dol --supplier 'sh stubborn.sh' > log.txt & run=$!
  $ until [ -e trapped ]; do sleep 0.05; done; kill -INT $run; signal INT 'is interrupted' log.txt
  [130]

The programs that ran did what the semantics allows.

  $ check-journals
