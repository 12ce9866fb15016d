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

A script that loops without any effect can be interrupted, so can one that waits for an answer or for vehicles.

  $ echo 'while (true) { }' > loop.dol
  $ dolphin exec loop.dol --journal loop.run > log.txt & run=$!
  $ signal INT program loop.run
  [130]
  $ cat log.txt
     0:00  program     is interrupted
  $ echo "x = ask 'Well?'" > ask.dol
  $ mkfifo silence; exec 3<> silence
  $ dolphin exec ask.dol <&3 > log.txt & run=$!
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

The second interruption ends the process at once. Here a supplier that ignores the end of its input keeps the first one
waiting.

  $ cat > stubborn.sh <<'EOF'
  > trap '' TERM INT HUP
  > echo > trapped
  > read request
  > sleep 30
  > EOF
  $ echo 'supplier = getSupplier()' > supplier.dol
  $ dolphin exec supplier.dol --supplier 'sh stubborn.sh' > log.txt & run=$!
  $ until [ -e trapped ]; do sleep 0.05; done; kill -INT $run; signal INT 'is interrupted' log.txt
  [130]

The programs that ran did what the semantics allows.

  $ check-journals
