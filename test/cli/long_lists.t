Lists of as many elements as there are pairs, states or lines of a journal need no more of the stack than short ones:
with a stack of 700 KB instead of the usual 8 MB, 60,000 elements are as 700,000.

  $ ulimit -s 700

Lists of a program, and the pairs of N:

  $ echo "vehicle 'a', { type 'UUV'; at 41.18, -8.70 }" > lists.fleet
  $ cat > lists.dol <<'X'
  > v = pick { count 1 }
  > xs = (1..60000).collect { it }
  > for (x in xs) { post k: x }
  > message "${xs.findAll { it > 3 }.size()} ${xs.sort { -it }[0]} ${xs.join('').size()}"
  > execute action { message "${count(k: { it > 3 })}" }
  > X
  $ dolphin exec lists.dol --fleet lists.fleet --quiet --journal lists.run --no-socket
     0:00  program     says: 59997 60000 288894
     0:00  program     says: 59997
     0:00  program     ends
  completed after 0:00
    tasks    none
    journal  lists.run
  $ dolphin trace check lists.dol lists.run
  lists.run: a run, of 60043 transitions in 0:00; completed
  $ dolphin trace export lists.run --to mcap --output lists.mcap

States and steps of the analysis of time:

  $ tasks() { echo "(task('p${1}1') >> task('p${1}2') >> task('p${1}3') >> task('p${1}4') >> task('p${1}5'))"; }
  $ { echo "early = now() < 1; vs = pick { count 4 }"
  >   echo "execute vs: $(tasks 1) | $(tasks 2) | $(tasks 3) | $(tasks 4)"; } > steps.dol
  $ for i in 1 2 3 4; do
  >   echo "vehicle 'v$i', { type 'UUV' }"
  >   for j in 1 2 3 4 5; do echo "plan 'p$i$j', { duration $((8 + i + j)), $((15 + 2 * i + 3 * j)) }"; done
  > done > steps.fleet
  $ dolphin time steps.dol --fleet steps.fleet | grep -e '^completed' -e '^v'
  completed: 1:15 at the earliest, 2:40 at the latest
  vehicle  least battery
  v1       99.6 %
  v2       99.5 % or more; 99.6 % in some run
  v3       99.5 %
  v4       99.5 %
