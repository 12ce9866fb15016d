What `dolphin tla --run` and `--compare` do with what TLC says. Here `java` is a script that says it.

  $ mkdir bin
  $ cat > bin/java <<'END'
  > #!/bin/sh
  > for argument; do case "$argument" in -D*tmpdir*|-X*|*.tla|*/*) ;; *) printf '%s ' "$argument" ;; esac; done > "$HERE/arguments"
  > cat "$HERE/said"
  > exit $(cat "$HERE/status")
  > END
  $ chmod +x bin/java
  $ touch tlc.jar
  $ export HERE="$PWD" PATH="$PWD/bin:$PATH" DOLPHIN_TLC="$PWD/tlc.jar"
  $ unset JAVA_HOME
  $ message() { printf '@!@!@STARTMSG %s @!@!@\n' "$1"; cat; printf '@!@!@ENDMSG %s @!@!@\n' "${1%:*}"; }
  $ version() { echo TLC2 Version 2.18 of 20 March 2023 | message 2262:0; }
  $ state() { printf '%s: <%s>\n/\\ N = [ bag |-> <<>>,\n  queue |-> <<>> ]\n/\\ label = "%s"\n' "$1" "$2" "$3" | message 2217:4; }
  $ step() { state "$1" "Next line 700, col 9 to line 700, col 19 of module Dolphin" "$2"; }
  $ counts() { echo "$1 states generated, $2 distinct states found, $3 states left on queue." | message 2199:0; }
  $ echo 0 > status

  $ cat > deadlock.dol <<'END'
  > v = pick { type 'UUV' }
  > execute (imcPlan('a') >> action { post left: 1 } >> condition { consume right: 1 }) | condition { consume right: 1 }
  > END

A program of which everything holds.

  $ { version; echo Model checking completed. No error has been found. | message 2193:0; counts 25 20 0
  >   echo The depth of the complete state graph search is 7. | message 2194:0; } > said
  $ dolphin tla deadlock.dol --run
  TLC2 Version 2.18 of 20 March 2023
  no deadlock: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  termination: holds
  20 distinct states, 25 generated, depth 6
  $ cat arguments; echo
  -Dfile.encoding=UTF-8 -Duser.language=en -Duser.country=US -cp tlc2.TLC -workers auto -tool -deadlock -metadir -config Run.cfg 

A counter-example: its labels are enough to find where in the program each step is.

  $ { version; echo Invariant NoDeadlock is violated. | message 2110:1; state 1 'Initial predicate' ''
  >   step 2 "pick(1 vehicle of type 'UUV')"; step 3 'bind(noptilus-2)'; step 4 execute; step 5 'start(noptilus-2, a)'
  >   step 6 'done(noptilus-2, a)'; step 7 'act(post left:1)'; counts 17 16 1; } > said
  $ echo 12 > status
  $ dolphin tla deadlock.dol --run --strict
  TLC2 Version 2.18 of 20 March 2023
  no deadlock: violated after 6 steps
  no unhandled error: not decided: TLC stops at a violation
  assertions: not decided: TLC stops at a violation
  vehicles for all tasks: not decided: TLC stops at a violation
  no halt: not decided: TLC stops at a violation
  no leftover tuples: not decided: TLC stops at a violation
  termination: not decided: TLC stops at a violation
  16 distinct states, 17 generated, 1 not looked at
  
  no deadlock: a run in which nothing can happen any more, and the program has not ended
      program                        noptilus-2  where           variables
  1   pick(1 vehicle of type 'UUV')              deadlock.dol:1
  2   picks noptilus-2                           deadlock.dol:1
  3   execute                                    deadlock.dol:2  v = noptilus-2
  4                                  starts a    deadlock.dol:2
  5                                  ends a      deadlock.dol:2
  6   act(post left:1)                           deadlock.dol:2
  tuples then: {left:1}
  waits for the condition at deadlock.dol:2:65, consume right: 1
  waits for the condition at deadlock.dol:2:99, consume right: 1
  [1]

One that goes on for ever.

  $ cat > round.dol <<'END'
  > x = 0
  > while (true) { x = 1 - x; pause 1.seconds }
  > END
  $ { version; echo Temporal properties were violated. | message 2116:1; state 1 'Initial predicate' ''; step 2 'pause(1)'
  >   step 3 resume; step 4 'pause(1)'; step 5 resume; echo '2: Back to state: <Next line 700>' | message 2122:4; counts 6 5 0; } > said
  $ dolphin tla round.dol --run
  TLC2 Version 2.18 of 20 March 2023
  no deadlock: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  termination: violated after 1 step, 4 steps that can repeat without end
  5 distinct states, 6 generated
  
  termination: a run in which the program may never end
      program   where        variables
  1   pause(1)  round.dol:2  x = 1
  and from there, again and again:
      program   where        variables
  2   resume    round.dol:2
  3   pause(1)  round.dol:2  x = 0
  4   resume    round.dol:2
  5   pause(1)  round.dol:2  x = 1
  [1]

One that the explorer does not know: then the two statements of the semantics differ, and TLC's states are shown.

  $ { version; echo Invariant TypeOK is violated. | message 2110:1; state 1 'Initial predicate' ''; step 2 'pause(2)'; counts 2 2 1; } > said
  $ dolphin tla round.dol --run
  TLC2 Version 2.18 of 20 March 2023
  no deadlock: not decided: TLC stops at a violation
  no unhandled error: not decided: TLC stops at a violation
  assertions: not decided: TLC stops at a violation
  vehicles for all tasks: not decided: TLC stops at a violation
  TypeOK: violated after 1 step
  termination: not decided: TLC stops at a violation
  2 distinct states, 2 generated, 1 not looked at
  
  TypeOK: a run in which it does not hold
  The explorer does not have this run: after nothing, the explorer cannot do pause(2). --compare shows the difference. The states of TLC:
     1  Next
        /\ N = [ bag |-> <<>>,
          queue |-> <<>> ]
        /\ label = "pause(2)"
  [1]

What the model cannot tell ends the search.

  $ { version; printf '@!@!@STARTMSG 2111:1 @!@!@\nEvaluating invariant NoDeadlock failed.\n'
  >   printf 'The first argument of Assert evaluated to FALSE; the second argument was:\n"a number has too many decimals"\n' | message 2132:0
  >   echo '@!@!@ENDMSG 2111 @!@!@'; echo The behavior up to this point is: | message 2121:1; state 1 'Initial predicate' ''
  >   echo The error occurred when TLC was evaluating the nested expressions | message 2103:1; counts 2 2 1; } > said
  $ dolphin tla round.dol --run
  dolphin: TLC gave up: a number has too many decimals
  [3]

The server of the distributed mode says who may work for it, and how.

  $ { version; echo Model checking completed. No error has been found. | message 2193:0; counts 6 5 0; } > said
  $ echo 0 > status
  $ dolphin tla round.dol --run --distributed 127.0.0.1:10997 2> told | tail -1
  5 distinct states, 6 generated
  $ sed "s|$PWD/||g" told
  workers join by:
    bin/java -XX:+UseParallelGC -Xss64m -Dfile.encoding=UTF-8 -Duser.language=en -Duser.country=US -Dtlc2.tool.distributed.TLCServer.port=10997 -cp tlc.jar tlc2.tool.distributed.TLCWorker 127.0.0.1
  $ cat arguments; echo
  -Dfile.encoding=UTF-8 -Duser.language=en -Duser.country=US -Djava.rmi.server.hostname=127.0.0.1 -Dtlc2.tool.distributed.TLCServer.port=10997 -cp tlc2.tool.distributed.TLCServer -tool -deadlock -metadir -config RunStates.cfg 

On a violation it says little.

  $ { echo TLC2 TLC Server Version 2.18 of 20 March 2023; echo The behavior up to this point is: | message 2121:1
  >   state 1 'Initial predicate' resume; step 2 'pause(1)'; counts 6 5 0; } > said
  $ dolphin tla round.dol --run --distributed 127.0.0.1:10997 2> told
  TLC2 TLC Server Version 2.18 of 20 March 2023
  no deadlock: not decided: TLC stops at a violation
  no unhandled error: not decided: TLC stops at a violation
  assertions: not decided: TLC stops at a violation
  vehicles for all tasks: not decided: TLC stops at a violation
  5 distinct states, 6 generated
  some property is violated: TLC's distributed mode does not name it, and shows only the last step. To see a run: --run alone.
  last step: pause(1)
  [1]

State graphs: equal, and not.

  $ cat > message.dol <<'END'
  > message 'a'
  > END
  $ line() { printf '"%s"\n' "$1"; }
  $ { version; line 'S\t1: s\t1'; line 'E\tmessage '"'a'"'\t1: t\tMESSAGE'; line 'S\t1: t\t1'; line 'E\tend\t1: u\tEND'; line 'S\t1: u\t1'
  >   line 'M\tended: completed'; echo Model checking completed. No error has been found. | message 2193:0; counts 3 3 0; } > said
  $ dolphin tla message.dol --compare --coverage
  isomorphic, with equal labels and derivations, and equal A, B and N: 3 states, 2 transitions
  MESSAGE          1
  END              1
  $ sed -i "s/'a'/'b'/" said
  $ dolphin tla message.dol --compare
  not isomorphic. Left is the explorer's graph, right TLC's; the observable part of a state counts as a transition that stays there, in parentheses.
  left: 3 states, 3 transitions; right: 3 states, 3 transitions
  At the start the left one can do message 'a' by MESSAGE,
  the right one message 'b' by MESSAGE.
  [1]
  $ sed -i '/left on queue/s/3 distinct/4 distinct/' said
  $ dolphin tla message.dol --compare
  dolphin: TLC counts 4 states and 2 transitions, but its model printed 3 and 2
  [3]
  $ sed -i "/E.tend/d; s/'b'/'a'/; s/^3 states generated, 4/2 states generated, 3/" said
  $ dolphin tla message.dol --compare | tail -2
  After message 'a' by MESSAGE the left one can do end by END,
  the right one nothing.
  $ dolphin tla deadlock.dol --compare --max-states 3
  dolphin: deadlock.dol has more than 3 states: see --max-states
  [3]

What goes wrong.

  $ { version; echo 'TLC threw an unexpected exception.' | message 1000:1; } > said; echo 255 > status
  $ dolphin tla round.dol --run
  dolphin: TLC failed: TLC threw an unexpected exception.
  [3]
  $ version > said
  $ dolphin tla round.dol --run
  dolphin: TLC ended with status 255 before it was done
  [3]
  $ echo 'java.lang.UnsupportedClassVersionError: tlc2/TLC has been compiled by a more recent version of the Java Runtime (class file version 55.0), this version of the Java Runtime only recognizes class file versions up to 52.0' > said
  $ dolphin tla round.dol --run
  dolphin: TLC needs Java 11 or later, and this is Java 8; JAVA_HOME may name another one
  [3]
  $ echo 'Error: Could not find or load main class tlc2.TLC' > said
  $ dolphin tla round.dol --run
  dolphin: TLC failed: Error: Could not find or load main class tlc2.TLC
  [3]
  $ dolphin tla round.dol --run --tlc none.jar
  dolphin: none.jar: no such file, named by --tlc as the archive of TLC
  [3]
  $ JAVA_HOME=/nowhere dolphin tla round.dol --run
  dolphin: TLC needs Java, 11 or later, and /nowhere/bin/java, named by JAVA_HOME, does not exist
  [3]
  $ HOME=/nowhere DOLPHIN_TLC= dolphin tla round.dol --run 2>&1 | cut -c 1-60
  dolphin: TLC was not found. Name its archive (tla2tools.jar,

What cannot be asked.

  $ dolphin tla round.dol
  dolphin: give -o DIR to write the model, --run to check it by TLC, or --compare to compare state graphs
  [2]
  $ dolphin tla round.dol --run --compare
  dolphin: --run and --compare exclude each other: give one of them
  [2]
  $ dolphin tla round.dol --compare --workers 2
  dolphin: --workers needs --run
  [2]
  $ dolphin tla round.dol --run --distributed here:1 --workers 2
  dolphin: --workers is not for --distributed: each worker has its own number of threads
  [2]
  $ dolphin tla round.dol -o model --coverage
  dolphin: --coverage needs --compare
  [2]
  $ dolphin tla round.dol --run --distributed here 2>&1 | head -1
  dolphin: option '--distributed': 'here' is not HOST:PORT, as in
