#!/bin/bash
# compare.sh [N,F ...]: the explorer and other checkers on one system (N vehicles, F = 1 with failures), side by side,
# nothing reduced: every tool must find the same number of states. A table of CPU seconds (user and system) and memory
# of the whole process, with ratios. Default: 5,1 6,1 7,0. TLC is left out where N > 6, or with TLC=no.
# Installs spin and rumur from Debian, TLC from Maven Central, where they are missing.
set -euo pipefail
tools=rumur
. "$(dirname "$0")/tools.sh"

compare() {
  local n=$1 f=$2
  cd "$work"
  measure explorer "$explorer" "$n" "$f"
  expected=$(awk '/states/ { print $1 }' explorer.out)
  echo
  echo "N = $n, F = $f"
  heading
  row explorer "dolphin explorer" "$expected"

  "$here/promela.sh" "$n" "$f" > model.pml
  spin -a model.pml > /dev/null
  gcc -O2 -DNOREDUCE -DSAFETY -DNOFAIR -DMEMLIM=20000 -w -o pan pan.c
  local width=22
  [ "$n" -ge 7 ] && width=26
  measure spin ./pan -m1000000 -w$width
  row spin "SPIN -DNOREDUCE -O2 -DSAFETY -w$width" "$(spin_states spin)"

  if [ "$n" -le 6 ]; then
    "$here/murphi.sh" "$n" "$f" > model.m
    compile_rumur
    measure rumur ./rumur.exe
    row rumur "rumur, 1 thread, -O3" "$(rumur_states rumur)"
  fi

  if [ "$n" -le 6 ] && [ "${TLC:-yes}" != no ]; then
    cp "$here/Fleet.tla" .
    local failures=FALSE
    [ "$f" = 1 ] && failures=TRUE
    printf 'SPECIFICATION Spec\nCONSTANTS N = %d\nFailures = %s\nINVARIANT Inv\n' "$n" "$failures" > Fleet.cfg
    measure tlc java -XX:+UseParallelGC -cp "$jar" tlc2.TLC -deadlock -workers 1 -config Fleet.cfg Fleet
    row tlc "TLC, 1 worker" "$(sed -n 's/.* generated, \([0-9]*\) distinct.*/\1/p' tlc.out | tail -1 | tr -d ,)"
  fi
}

[ $# -gt 0 ] || set -- 5,1 6,1 7,0
for case in "$@"; do compare "${case%,*}" "${case#*,}"; done
