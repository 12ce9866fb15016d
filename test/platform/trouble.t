What adapters do wrong in the middle of a run.

  $ cat > m.fleet <<'END'
  > vehicle 'auv-1', { type 'UUV' }
  > plan 'a', { duration 10.seconds }
  > plan 'b', { duration 24.hours }
  > END
  $ cat > m.dol <<'END'
  > v = pick { type 'UUV' }
  > execute v: imcPlan('a')
  > END
  $ with() { echo "python3 faulty.py '$1' 'dolphin sim m.fleet --platform --state \"state of $1\" --speed 100'"; }
  $ run() { dolphin exec "$@" 2>&1 | sed 's/^ *[0-9]*:[0-9]* *//'; }

A line that is no report is told, and does no harm.

  $ run m.dol --journal 1.run --platform "$(with prints)"
  program     picks auv-1
  auv-1       starts a
  program     platform sim: a line of the adapter is not JSON: Line 1, bytes 0-27: Invalid token 'armed, waiting for the link'; it is ignored
  auv-1       ends a
  program     releases auv-1
  program     ends

Its standard error reaches ours line by line: nothing in it commands the terminal, and nothing is lost.

  $ cat > loud.py <<'END'
  > import runpy, sys
  > sys.stderr.buffer.write(b"\x1b[31mred\x1b[0m, \xff and \xe2\x80\xae\r\n")
  > sys.stderr.buffer.write(b"".join(b"line %d\n" % n for n in range(20000)))
  > sys.stderr.buffer.write(b"\xc3\xa9" * 50000 + b"\none without an end")
  > sys.stderr.flush()
  > runpy.run_path("../../examples/adapter.py")
  > END
  $ dolphin platform check --only greeting "python3 loud.py" 2> errors.txt | tail -1
  1 of 1 situations passed
  $ head -1 errors.txt; tail -1 errors.txt; grep -c '^line' errors.txt; wc -l < errors.txt
  ?[31mred?[0m, ? and ?
  one without an end
  20000
  20003
  $ sed -n 20002p errors.txt | tr -d '\n' | wc -c
  100000

A report of which one member is wrong is ignored as a whole, and the adapter is informed: it reports all again.

  $ cat > half.py <<'END'
  > import json, sys
  > def report(kind, **members): print(json.dumps({"kind": kind, **members}), flush=True)
  > def vehicle(**members): report("vehicle", vehicle="rover-1", **members)
  > for line in sys.stdin:
  >     order = json.loads(line)
  >     kind = order["kind"]
  >     if kind == "hello":
  >         report("hello", protocol=1, name="half", announce=1)
  >         vehicle(type="UGV", latitude=41, longitude=-8, link=True, battery=0.43)
  >     elif kind == "ping":
  >         report("pong", id=order["id"])
  >     elif kind == "start":
  >         request = order["request"]
  >         vehicle(latitude=41.1, battery=0.19)
  >     elif kind == "refused":
  >         print(order["why"], file=sys.stderr, flush=True)
  >         vehicle(type="UGV", latitude=41.1, longitude=-8, link=True, battery=0.19)
  >         report("done", request=request)
  >     elif kind == "close":
  >         report("quiet")
  >         break
  > END
  $ cat > half.dol <<'END'
  > v = pick { type 'UGV' }
  > execute v: imcPlan('short')
  > message battery(v)
  > END
  $ run half.dol --journal half.run --platform 'python3 half.py 2> refused.txt'
  program     picks rover-1
  rover-1     starts short
  program     platform half: a line of the adapter is not a valid 'vehicle': of latitude and longitude one is missing; it is ignored
  rover-1     ends short
  program     says: 0.19
  program     releases rover-1
  program     ends
  $ cat refused.txt
  is not a valid 'vehicle': of latitude and longitude one is missing

The adapter dies: its vehicle loses its link, the next adapter says what became of the plan.

  $ run m.dol --journal 2.run --platform "$(with dies)"
  program     picks auv-1
  auv-1       starts a
  program     platform sim: the adapter ended with exit status 4; its vehicles have lost their link
  auv-1       loses its link
  program     platform sim: the adapter runs again
  auv-1       has its link back
  auv-1       ends a
  program     releases auv-1
  program     ends
  $ dolphin trace check m.dol 2.run | sed 's/ in 0:0[0-9]//'
  2.run: a run, of 6 transitions; completed
  $ grep -c '"start"' 'state of dies'
  1

A stop that is never confirmed is named at the end. Ctrl-C, when the adapter has the order to start: one that is not
sent yet is not sent then.

  $ sed 's/imcPlan(.a.)/imcPlan("b")/' m.dol > b.dol
  $ dolphin exec b.dol --journal 3.run --platform "$(with 'no stop')" > log 2>&1 & run=$!
  $ until grep -qs '"start"' 'state of no stop' || ! kill -0 $run; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ sed 's/^ *[0-9]*:[0-9]* *//' log
  program     picks auv-1
  auv-1       starts b
  auv-1       stops b
  program     releases auv-1
  program     is interrupted
  program     auv-1: may still run plan b: it was not heard to have stopped
