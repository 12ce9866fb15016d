#!/bin/bash
# formulas.sh [N ...]: the explorer, SPIN and TLC on one formula about the system of compare.sh (N vehicles, without
# failures): whenever vehicle 1 surveys, it is met some time. It holds. The table is as in compare.sh; its states are
# those that each tool stores, of the product with the formula's automaton where it builds one. Default: 5 6. TLC is
# left out where N > 5, or with TLC=no.
set -euo pipefail
tools=
. "$(dirname "$0")/tools.sh"

compare() {
  local n=$1
  cd "$work"
  measure explorer env REDUCTION=all LTL='G (running(survey1) -> F running(rv1))' "$explorer" "$n" 0
  grep -q ': holds' explorer.out
  echo
  echo "N = $n"
  heading
  expected=$(awk '/for formulas/ { print $1 }' explorer.out)
  row explorer "dolphin explorer" "$expected"

  "$here/promela.sh" "$n" 0 > model.pml
  echo 'ltl met { [] ((u[0] == 1) -> <> (rv[0] == 2)) }' >> model.pml
  spin -a model.pml > /dev/null
  gcc -O2 -DNOREDUCE -DNOFAIR -DMEMLIM=20000 -w -o pan pan.c
  measure spin ./pan -a -m1000000 -w24
  grep -q 'errors: 0' spin.out
  expected=$(awk '/states, stored/ { print $1 }' spin.out)
  row spin "SPIN -a -DNOREDUCE -O2 -w24" "$expected"

  if [ "$n" -le 5 ] && [ "${TLC:-yes}" != no ]; then
    cp "$here/Fleet.tla" .
    printf -- '---- MODULE Met ----\nEXTENDS Fleet\nFair == Spec /\\ WF_vars(Next)\nMet == (u[1] = 1) ~> (rv[1] = 2)\n====\n' > Met.tla
    printf 'SPECIFICATION Fair\nCONSTANTS N = %d\nFailures = FALSE\nPROPERTY Met\n' "$n" > Met.cfg
    measure tlc java -XX:+UseParallelGC -cp "$jar" tlc2.TLC -deadlock -workers 1 -config Met.cfg Met
    grep -q 'No error has been found' tlc.out
    expected=$(sed -n 's/.* generated, \([0-9]*\) distinct.*/\1/p' tlc.out | tail -1 | tr -d ,)
    row tlc "TLC, 1 worker" "$expected"
  fi
}

[ $# -gt 0 ] || set -- 5 6
for n in "$@"; do compare "$n"; done
