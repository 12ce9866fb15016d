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
  $ timeout --foreground --preserve-status -s INT 1 dolphin exec long.dol --speed 1 > log.txt
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

  $ timeout --foreground --preserve-status -s TERM 1 dolphin exec long.dol --speed 1 | tail -1 | cut -c 10-
  program     is interrupted

A script that loops without any effect can be interrupted, so can one that waits for an answer or for vehicles.

  $ echo 'while (true) { }' > loop.dol
  $ timeout --foreground --preserve-status -s INT 1 dolphin exec loop.dol
     0:00  program     is interrupted
  [130]
  $ echo "x = ask 'Well?'" > ask.dol
  $ sleep 5 | timeout --foreground --preserve-status -s INT 1 dolphin exec ask.dol
     0:00  program     asks: Well? 
     0:00  program     is interrupted
  [130]
  $ echo "v = pick { type 'ROV'; timeout 1.hour }" > pick.dol
  $ timeout --foreground --preserve-status -s INT 1 dolphin exec pick.dol --speed 1 | cut -c 10-
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

The second interruption ends the process at once. Here a supplier that ignores the end of its input keeps the first one
waiting.

  $ cat > stubborn.sh <<'EOF'
  > trap '' TERM INT HUP
  > read request
  > sleep 30
  > EOF
  $ echo 'supplier = getSupplier()' > supplier.dol
  $ dolphin exec supplier.dol --supplier 'sh stubborn.sh' > log.txt &
  $ process=$!
  $ sleep 1; kill -INT $process; sleep 0.2; kill -INT $process; wait $process
  [130]

The programs that ran did what the semantics allows.

  $ check-journals
