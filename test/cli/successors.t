States in, what follows them out.

  $ cat > relay.dol <<'END'
  > v = pick { type 'UUV' }
  > execute imcPlan('a') | action { post ready: 1 }
  > assert { !(poll ready: 1) }, 'posted'
  > END
  $ cat > relay.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV' }
  > END
  $ dolphin successors relay.dol --greeting | sed 's/"version":"[^"]*"/"version":"..."/; s/"[0-9a-f]\{32\}"/"<digest>"/g'
  {"dolphin":"successors","protocol":1,"version":"...","program":"<digest>","fleet":"<digest>","set":{},"options":{"answers":[],"faults":"","reduction":"none","invariants":[]}}

A search in a few lines finds what the explorer finds, and a run through the states that it met.

  $ cat > search.py <<'END'
  > import struct, subprocess, sys
  > p = subprocess.Popen(["dolphin", "successors", *sys.argv[1:]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
  > greeting = p.stdout.readline()
  > p.stdin.write(greeting)
  > number = lambda: struct.unpack("<I", p.stdout.read(4))[0]
  > text = lambda: p.stdout.read(number())
  > pack = lambda states: struct.pack("<I", len(states)) + b"".join(struct.pack("<I", len(s)) + s for s in states)
  > def ask(states):
  >     p.stdin.write(pack(states))
  >     p.stdin.flush()
  >     assert p.stdout.read(1) == b"\0"
  >     found = [(p.stdout.read(1)[0], text()) for _ in range(number())]
  >     expansions = []
  >     for _ in range(number()):
  >         p.stdout.read(1)
  >         expansions.append((number(), struct.unpack("<%dI" % (n := number()), p.stdout.read(4 * n))))
  >     p.stdout.read(32 * number())
  >     p.stdout.read(1), text(), text()
  >     return found, expansions
  > initial = ask([b""])[0][0][1]
  > before, level, transitions, broken = {initial: None}, [initial], 0, None
  > while level:
  >     found, expansions = ask(level)
  >     following = []
  >     for state, (n, targets) in zip(level, expansions):
  >         transitions += n
  >         for kind, successor in (found[i] for i in targets):
  >             if successor not in before:
  >                 before[successor] = state
  >                 following.append(successor)
  >                 if kind & 127 == 2 and broken is None:
  >                     broken = successor
  >     level = following
  > print(len(before), "states,", transitions, "transitions")
  > run = []
  > while broken and broken != initial:
  >     run.insert(0, broken)
  >     broken = before[broken]
  > open("run", "wb").write(greeting + pack(run))
  > p.stdin.close()
  > print("status", p.wait())
  > END
  $ python3 search.py relay.dol
  10 states, 11 transitions
  status 0
  $ dolphin explore relay.dol --reduction none | sed 's/, depth.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: violated after 7 steps: relay.dol:3:1: assertion failed: posted
  vehicles for all tasks: holds
  10 states, 11 transitions
  
  assertions: a shortest run in which an assertion fails
      program                          noptilus-1  where
  1   pick(1 vehicle of type 'UUV')                relay.dol:1
  2   picks noptilus-1                             relay.dol:1
  3   execute                                      relay.dol:2
  4                                    starts a    relay.dol:2
  5                                    ends a      relay.dol:2
  6   act(post ready:1)                            relay.dol:2
  7   fault(assertion failed: posted)              relay.dol:3
  tuples then: {ready:1}
  $ dolphin successors relay.dol --run < run
      program                          noptilus-1  where
  1   pick(1 vehicle of type 'UUV')                relay.dol:1
  2   picks noptilus-1                             relay.dol:1
  3   execute                                      relay.dol:2
  4                                    starts a    relay.dol:2
  5                                    ends a      relay.dol:2
  6   act(post ready:1)                            relay.dol:2
  7   fault(assertion failed: posted)              relay.dol:3
  tuples then: {ready:1}

What is wrong is told.

  $ dolphin successors relay.dol < /dev/null | wc -l
  1
  $ dolphin successors relay.dol --faults fail < run > /dev/null 2> wrong; echo $?; cut -c 1-110 wrong
  2
  dolphin: the states are not of this program, fleet, version and options: the input begins with {"dolphin":"suc
  $ ask() { { dolphin successors relay.dol --greeting; printf "$1"; } | dolphin successors relay.dol $2 2>&1 > /dev/null; echo "status $?"; }
  $ ask '\001\000'
  dolphin: the input ends within a batch
  status 2
  $ ask '\001\000\000\000\003\000\000\000xyz'
  dolphin: state 1 of the batch is no state of this program: it is of no kind
  status 2
  $ ask '\001\000\000\000\001\000\000\000e'
  dolphin: state 1 of the batch is no state of this program: it ends too early
  status 2
  $ ask '\001\000\000\000\006\000\000\000s[]\n[]'
  dolphin: state 1 of the batch is no state of this program: what the environment remembers is not written as dolphin writes it
  status 2
  $ ask '\377\377\377\377'
  dolphin: a batch of 4294967295 states is larger than any
  status 2
  $ ask '' --run
  dolphin: the input has no batch of states: there is no run in it
  status 2
  $ ask '\001\000\000\000\002\000\000\000s\n' --run
  dolphin: state 1 of the run is no state of this program: what the environment remembers is not written as dolphin writes it
  status 2
  $ dolphin successors relay.dol --greeting --run
  dolphin: --greeting asks nothing of a run: give --greeting or --run
  [2]
  $ dolphin successors relay.dol --invariant 'x y'
  dolphin: --invariant 'x y': unknown name 'x'
  [2]
  $ dolphin successors relay.dol --reduction symmetry 2>&1 | head -1
  dolphin: option '--reduction': invalid value 'symmetry', expected either

A state of another place of the run is no step of it.

  $ python3 - <<'END'
  > whole = open("run", "rb").read()
  > line, batch = whole.split(b"\n", 1)
  > import struct
  > states, at = [], 4
  > while at < len(batch):
  >     n, = struct.unpack("<I", batch[at:at + 4])
  >     states.append(batch[at + 4:at + 4 + n])
  >     at += 4 + n
  > open("leap", "wb").write(line + b"\n" + struct.pack("<II", 1, len(states[1])) + states[1])
  > END
  $ dolphin successors relay.dol --run < leap
  dolphin: no transition leads to state 1 of the run
  [2]
