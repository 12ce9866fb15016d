Programs on simulated vehicles, as two processes over UDP.

  $ cat > pair.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > vehicle 'noptilus-2', { type 'UUV' }
  > plan 'out', { duration 20 }
  > plan 'back', { duration 20 }
  > plan 'around', { duration 30 }
  > plan 'astray', { duration 10; fails }
  > END
  $ cat > mission.dol <<'END'
  > v = pick { count 2; type 'UUV'; timeout 1.min }
  > execute v: (imcPlan('out') >> imcPlan { planName 'inline'; locate Location.APDL; skeeping duration: 10 } >> imcPlan('back')) | imcPlan('around')
  > message 'Done!'
  > END

The vehicles run in the background while a program does, and are asked to end then.

  $ mission() {
  >   program=$1; first=$2; last=$((first + 4)); shift 2
  >   dolphin sim pair.fleet --imc --speed 20 --announce 0.5 --contact 0.2 --discovery-ports $first-$last \
  >     --port $((first + 10)) --log log.jsonl --for 200 "$@" > vehicles.txt & vehicles=$!
  >   until [ -s vehicles.txt ]; do sleep 0.05; done
  >   status=0; timeout 180 dolphin exec $program --imc-loopback --imc-discovery-ports $first-$last > run.txt 2> errors.txt || status=$?
  >   kill $vehicles; wait $vehicles || true
  >   echo "status $status"
  > }

What the vehicles were told to start, each request once however often the network doubled it; and what ended.

  $ starts() { grep '"did":"started"' log.jsonl | sed 's/.*"plan":"\([^"]*\)".*"sent":\([0-9.]*\).*/\1 \2/' | sort -u | cut -d' ' -f1; }
  $ ends() { grep '"did":"completed"' log.jsonl | sed 's/.*"plan":"\([^"]*\)".*/\1/' | sort; }

On a good link.

  $ mission mission.dol 21200
  status 0
  $ starts
  around
  back
  inline
  out
  $ ends
  around
  back
  inline
  out
  $ grep -c '"instead"' log.jsonl
  0
  [1]
  $ grep -o 'Done!' run.txt
  Done!

On a bad one.

  $ mission mission.dol 21220 --loss 0.3 --duplication 0.1 --reordering 0.2 --seed 5
  status 0
  $ starts
  around
  back
  inline
  out
  $ ends
  around
  back
  inline
  out
  $ grep -o 'Done!' run.txt
  Done!

A plan that fails, and plans that are refused.

  $ echo "v = pick { type 'UUV'; timeout 1.min }; execute imcPlan('astray')" > astray.dol
  $ mission astray.dol 21240
  status 1
  $ grep -o 'failed on .*' errors.txt | sed 's/noptilus-[12]/one/' | head -1
  failed on one: plan failed
  $ mission mission.dol 21260 --refuse noptilus-1=unwell --refuse noptilus-2=unwell
  status 1
  $ grep -o 'failed on .*' errors.txt | sed 's/noptilus-[12]/one/' | head -1
  failed on one: unwell

The programs that ran did what the semantics allows.

  $ check-journals

The mission of the paper, while the network loses, doubles and reorders.

  $ ../../bench/imc_platform/lossy.py --runs 1 "$(command -v dolphin)" | grep -E 'completed|sent again' | sed 's/, in .*//'
  1 of 1 missions completed
  requests sent again to a vehicle that had taken them: 0
