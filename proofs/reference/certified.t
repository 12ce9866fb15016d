The states that `dolphin explore` finds, checked by the extracted checker.

  $ cp ../../examples/rendezvous.dol ../../examples/rendezvous.fleet .
  $ certify () { dolphin explore rendezvous.dol --certify mission.certificate "$@" > shown; }
  $ check () { ./dolphin_certified.exe "$@"; }
  $ certify --faults fail=1
  [1]
  $ check mission.certificate
  mission.certificate: 2246 states, 10055 transitions: as the rules have them
  no deadlock: certified
  assertions: certified
  vehicles for all picks: certified
  vehicles for all tasks: certified
  no halt: certified
  no leftover tuples: certified
  termination: certified: no run has more than 35 transitions

Properties that do not hold are not in it; nor is termination, where a run may be endless.

  $ cat > waits.dol <<EOF
  > v = pick { count 1 }
  > execute v: repeat task('survey1')
  > EOF
  $ dolphin explore waits.dol --faults fail --certify waits.certificate > shown
  [1]
  $ check waits.certificate
  waits.certificate: 18 states, 21 transitions: as the rules have them
  no deadlock: certified
  assertions: certified
  vehicles for all picks: certified
  vehicles for all tasks: certified
  no halt: certified
  no leftover tuples: certified

What was changed in it is noticed: a transition that is missing, one that leads elsewhere, a state that is missing.

  $ sed '10s/,\[9,10\]//' mission.certificate > other.certificate
  $ cmp -s mission.certificate other.certificate
  [1]
  $ check other.certificate
  other.certificate: not certified: state 8: the rules have a transition start(noptilus-2, survey2), and the certificate does not
  [1]
  $ sed '10s/\[9,10\]/[9,11]/' mission.certificate > other.certificate
  $ check other.certificate
  other.certificate: not certified: state 8: a transition leads to another state than the certificate has at its place
  [1]
  $ head -n 50 mission.certificate > other.certificate
  $ check other.certificate
  dolphin_certified: other.certificate:51: the certificate ends before its last state
  [2]
  $ sed '4s/.*/[[3]]/' mission.certificate > other.certificate
  $ check other.certificate
  dolphin_certified: other.certificate:4: a transition is [label, state] or [label, state, digest]
  [2]

  $ (cat mission.certificate; echo '[]') > other.certificate
  $ check other.certificate
  dolphin_certified: other.certificate:2248: more lines than states
  [2]

A violated property is not certified.

  $ sed '1s/"no unhandled error",//; 1s/"holds":\[/"holds":["no unhandled error",/' waits.certificate > other.certificate
  $ check other.certificate
  other.certificate: not certified: state 10: an unhandled error ends the program
  [1]

Its program and its fleet are those of the certificate.

  $ echo '// changed' >> rendezvous.dol
  $ check mission.certificate
  dolphin_certified: rendezvous.dol has changed since the certificate was written
  [2]
  $ check
  usage: dolphin_certified FILE, where dolphin explore PROG --certify FILE wrote FILE
  [2]
  $ check nowhere
  dolphin_certified: nowhere: No such file or directory
  [2]
  $ echo '{}' > other.certificate
  $ check other.certificate
  dolphin_certified: other.certificate:1: "format" is missing
  [2]

  $ head -c 100000 /dev/zero | tr '\0' '[' > other.certificate
  $ check other.certificate
  dolphin_certified: other.certificate:1: not a line of JSON
  [2]

The output may have nowhere to go.

  $ check waits.certificate > /dev/full
  dolphin_certified: the output cannot be written: No space left on device
  [3]
  $ check --help
  usage: dolphin_certified FILE, where dolphin explore PROG --certify FILE wrote FILE

A certificate is of all states of one program.

  $ dolphin explore waits.dol --certify w.certificate --sample 10
  dolphin: a certificate is of all states: give --certify without --sample and --bitstate
  [2]
  $ dolphin explore waits.dol --certify w.certificate --faults fail --max-states 3 > shown
  dolphin: no certificate is written: the bound on states was met
  [3]
  $ dolphin explore waits.dol --certify /nowhere/w.certificate
  dolphin: /nowhere/w.certificate: No such file or directory
  [3]
  $ ls w.certificate
  ls: cannot access 'w.certificate': No such file or directory
  [2]
