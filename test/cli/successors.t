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
  {"dolphin":"successors","protocol":3,"version":"...","program":"<digest>","fleet":"<digest>","set":{},"options":{"answers":[],"faults":"","reduction":"none","invariants":[]}}

A search in a few lines finds what the explorer finds, and a run through the states that it met.

  $ cat > search.py <<'END'
  > import hashlib, struct, subprocess, sys
  > p = subprocess.Popen(["dolphin", "successors", *sys.argv[1:]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
  > greeting = p.stdout.readline()
  > p.stdin.write(greeting)
  > numbers = lambda kind, n: struct.unpack("<%d%s" % (n, kind), p.stdout.read(struct.calcsize(kind) * n))
  > number = lambda: numbers("I", 1)[0]
  > text = lambda: p.stdout.read(number())
  > size = lambda n: struct.pack("<I", n)
  > def batch(states, parts=(), targets=True):
  >     return (size(1) + bytes([targets]) + size(len(parts)) + b"".join(size(len(x)) + x for x in parts)
  >             + size(len(states)) + b"".join(size(len(s)) for s in states) + bytes(len(states)) + b"".join(states))
  > parts = []
  > def ask(states):
  >     p.stdin.write(batch(states))
  >     p.stdin.flush()
  >     assert p.stdout.read(1) == b"\0"
  >     transitions, = numbers("Q", 1)
  >     p.stdout.read(1)
  >     broken = [(number(), p.stdout.read(16)) for _ in range(number())]
  >     p.stdout.read(32 * number())
  >     text(), text()
  >     parts.extend(text() for _ in range(number()))
  >     bytes, n = numbers("Q", 2)
  >     digests = list(zip(numbers("Q", n), numbers("Q", n)))
  >     parents = numbers("Q", n)
  >     lengths, kinds = numbers("I", n), numbers("B", n)
  >     found = [p.stdout.read(length) for length in lengths]
  >     assert bytes == 8 + 29 * n + sum(lengths)
  >     assert digests == [struct.unpack("<QQ", hashlib.md5(s).digest()) for s in found]
  >     targets = [[found[i] for i in numbers("I", m)] for m in numbers("I", len(states))]
  >     assert sum(map(len, targets)) == transitions
  >     return transitions, broken, kinds, targets
  > (initial,), = ask([b""])[3]
  > before, level, transitions, failed = {initial: None}, [initial], 0, None
  > while level:
  >     n, broken, kinds, targets = ask(level)
  >     transitions += n
  >     following = []
  >     for state, successors in zip(level, targets):
  >         for successor in successors:
  >             if successor not in before:
  >                 before[successor] = state
  >                 following.append(successor)
  >     for number_of_property, digest in broken:
  >         if number_of_property == 2 and failed is None:
  >             failed, = [s for s in following if hashlib.md5(s).digest() == digest]
  >     level = following
  > print(len(before), "states,", transitions, "transitions,", len(parts), "parts")
  > run = []
  > while failed and failed != initial:
  >     run.insert(0, failed)
  >     failed = before[failed]
  > open("run", "wb").write(greeting + batch(run, parts))
  > open("without", "wb").write(greeting + batch(run))
  > open("leap", "wb").write(greeting + batch(run[1:2], parts))
  > p.stdin.close()
  > print("status", p.wait())
  > END
  $ python3 search.py relay.dol
  10 states, 11 transitions, 8 parts
  status 0
  $ dolphin explore relay.dol --reduction none | sed 's/, depth.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: violated after 7 steps: relay.dol:3:1: assertion failed: posted
  vehicles for all tasks: holds
  10 states, 11 transitions
  
  assertions: a shortest run in which an assertion fails
      program                          noptilus-1  where        variables
  1   pick(1 vehicle of type 'UUV')                relay.dol:1
  2   picks noptilus-1                             relay.dol:1
  3   execute                                      relay.dol:2  v = noptilus-1
  4                                    starts a    relay.dol:2
  5                                    ends a      relay.dol:2
  6   act(post ready:1)                            relay.dol:2
  7   fault(assertion failed: posted)              relay.dol:3
  tuples then: {ready:1}
  $ dolphin successors relay.dol --run < run
      program                          noptilus-1  where        variables
  1   pick(1 vehicle of type 'UUV')                relay.dol:1
  2   picks noptilus-1                             relay.dol:1
  3   execute                                      relay.dol:2  v = noptilus-1
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
  $ head='\001\000\000\000\000\000\000\000\000'  # a partition, no targets, no parts
  $ ask $head'\001\000\000\000\003\000\000\000\000xyz'
  dolphin: state 1 of the batch is not a state of this program: it is of no kind
  status 2
  $ ask $head'\001\000\000\000\001\000\000\000\000e'
  dolphin: state 1 of the batch is not a state of this program: it ends too early
  status 2
  $ ask $head'\001\000\000\000\021\000\000\000\000e1234567812345678'
  dolphin: state 1 of the batch is not a state of this program: it names a part that was not given
  status 2
  $ ask $head'\001\000\000\000\006\000\000\000\000s[]\n[]'
  dolphin: state 1 of the batch is not a state of this program: the environment's memory is not written as dolphin writes it
  status 2
  $ ask $head'\377\377\377\377'
  dolphin: a batch of 4294967295 states is larger than any
  status 2
  $ ask '\000\000\000\000'
  dolphin: a batch for 0 partitions: there are 1 to 1000000
  status 2
  $ ask '' --run
  dolphin: the input has no batch of states, so no run
  status 2
  $ ask $head'\001\000\000\000\002\000\000\000\000s\n' --run
  dolphin: state 1 of the run is not a state of this program: the environment's memory is not written as dolphin writes it
  status 2
  $ dolphin successors relay.dol --greeting --run
  dolphin: --greeting and --run exclude each other: give --greeting or --run
  [2]
  $ dolphin successors relay.dol --invariant 'x y'
  dolphin: --invariant 'x y': unknown name 'x'
  [2]
  $ dolphin successors relay.dol --reduction symmetry 2>&1 | head -1
  dolphin: option '--reduction': invalid value 'symmetry', expected either

A state of another place of the run is no step of it.

  $ dolphin successors relay.dol --run < leap
  dolphin: no transition leads to state 1 of the run
  [2]
  $ dolphin successors relay.dol --run < without
  dolphin: state 3 of the run is not a state of this program: it names a part that was not given
  [2]

States that hold areas are the same states when they are read again.

  $ cat > areas.dol <<'END'
  > quay = location(41.185, -8.70)
  > a = polygon([quay, quay.displace(0, 300), quay.displace(200, 300), quay.displace(200, 0)])
  > b = polygon([quay.displace(150, -10), quay.displace(151, 500), quay.displace(299, 370), quay.displace(299, 11)])
  > v = pick { region a + b; count 1 }
  > execute imcPlan('a')
  > assert { false }, 'over'
  > END
  $ cat > areas.fleet <<'END'
  > vehicle 'noptilus-1', { type 'UUV'; at 41.1858, -8.699 }
  > END
  $ python3 search.py areas.dol > found
  $ dolphin successors areas.dol --run < run | tail -n 1
  6   fault(assertion failed: over)                         areas.dol:6
