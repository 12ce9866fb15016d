A plan engine that has lost its plan is BLOCKED and answers that no plan is running, while the vehicle goes on.

  $ cat > one.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > plan 'out', { duration 100 }
  > END
  $ echo "v = pick { type 'UUV'; timeout 1.min }; execute v: imcPlan('out')" > mission.dol
  $ mission() {
  >   first=$1; last=$((first + 4)); shift
  >   dolphin sim one.fleet --imc --announce 0.5 --contact 0.2 --discovery-ports $first-$last \
  >     --port $((first + 10)) --stall noptilus-1=5,2.5 --log log.jsonl --for 100 > vehicles.txt & vehicles=$!
  >   until [ -s vehicles.txt ]; do sleep 0.05; done
  >   status=0
  >   timeout 60 dolphin exec mission.dol --imc-discovery-ports $first-$last "$@" > run.txt 2> errors.txt || status=$?
  >   kill $vehicles; wait $vehicles || true
  >   echo "status $status"
  > }

The task fails, the vehicle is told to stop, and named as one that may still run its plan.

  $ mission 21280 --imc-loopback
  status 1
  $ grep -o 'failed on .*' errors.txt
  failed on noptilus-1: the vehicle is blocked: it cannot run plans now
  $ grep -o 'may still run plan out: it was not heard to have stopped' run.txt errors.txt | cut -d: -f2-
  may still run plan out: it was not heard to have stopped
  $ grep -o '"did":"[a-z]*"' log.jsonl | uniq
  "did":"started"
  "did":"lost"
  "did":"stopped"

With --imc-abort it is aborted, and rests.

  $ mission 21300 --imc-loopback --imc-abort
  status 1
  $ grep -c 'may still run plan out: it was not heard' run.txt errors.txt
  run.txt:0
  errors.txt:0
  [1]
  $ grep -o '"did":"[a-z]*"' log.jsonl | uniq | head -4
  "did":"started"
  "did":"lost"
  "did":"stopped"
  "did":"aborted"

A console that is killed after the task has failed: the next one knows that the vehicle may still run the plan. It stops
it, and does not take it for idle.

  $ cat > killed.dol <<'END'
  > v = pick { type 'UUV'; timeout 1.min }
  > execute watch imcPlan('out')[v] onError { why -> message "failed: $why"; ignore() }
  > release v
  > pause 10.seconds
  > w = pick { type 'UUV'; timeout 4.seconds }
  > END
  $ dolphin sim one.fleet --imc --announce 0.5 --contact 0.2 --discovery-ports 21320-21324 --port 21330 \
  >   --stall noptilus-1=5,2.5 --log log.jsonl --for 100 > vehicles.txt & vehicles=$!
  $ until [ -s vehicles.txt ]; do sleep 0.05; done
  $ (sh -c 'echo $$ > pid.txt; exec dolphin exec killed.dol --imc-loopback --imc-discovery-ports 21320-21324 \
  >    --journal killed.run > first.txt 2> errors.txt' || true) 2> killed.txt & console=$!
  $ until grep -qs 'says: failed' first.txt; do sleep 0.05; done
  $ kill -KILL $(cat pid.txt); wait $console
  $ grep -c may-run killed.run
  1
  $ before=$(wc -l < log.jsonl)
  $ (timeout 60 dolphin exec --resume killed.run killed.dol --imc-loopback --imc-discovery-ports 21320-21324 \
  >    > second.txt 2> errors.txt; echo "status $?")
  status 1
  $ cut -c 10- second.txt
  program     noptilus-1: may still run plan out: it still maneuvers 5 s after the order to stop
  program     fails: could not pick 1 vehicle of type 'UUV': noptilus-1 may still run plan out
  program     noptilus-1: has not confirmed yet that it stopped plan out; waiting 3 s more
  program     noptilus-1: may still run plan out: it was not heard to have stopped
  $ tail -n +$((before + 1)) log.jsonl | grep -o '"did":"[a-z]*"' | uniq
  "did":"stopped"
  $ kill $vehicles; wait $vehicles || true

  $ check-journals
