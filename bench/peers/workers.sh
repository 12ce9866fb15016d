#!/bin/bash
# workers.sh [N,F ...]: the explorer, SPIN and TLC with one process or thread and with two, on the system of compare.sh:
# a table of elapsed seconds, CPU seconds of all processes, and what two gain. Default: 6,1 7,0. Figures mean something
# on a machine with two idle cores only. TLC is left out where N > 6, or with TLC=no. RUNS, 3 by default, of each, in
# turn; the shortest counts.
set -euo pipefail
tools=
. "$(dirname "$0")/tools.sh"

# timed NAME COMMAND...: a line of elapsed and CPU seconds more in $work/NAME.times, output in $work/NAME.out
timed() {
  local name=$1
  shift
  /usr/bin/time -a -o "$work/$name.times" -f '%e %U %S' "$@" > "$work/$name.out" 2> "$work/$name.err" ||
    { echo "$name fails" >&2; tail -5 "$work/$name.err" >&2; exit 1; }
}

# both TITLE STATES NAME: a line of the table, of what ran as NAME1 and NAME2
both() {
  local one two
  one=$(sort -n "$work/${3}1.times" | head -1)
  two=$(sort -n "$work/${3}2.times" | head -1)
  echo "$one $two" | awk -v title="$1" -v states="$2" '{
    printf "| %-28s | %11s | %8.2f | %8.2f | %8.2f | %8.2f | %5.2f |\n",
      title, states, $1, $4, $2 + $3, $5 + $6, ($4 > 0 ? $1 / $4 : 0) }'
}

compare() {
  local n=$1 f=$2 width=22 run
  cd "$work"
  rm -f ./*.times
  [ "$n" -ge 7 ] && width=26
  "$here/promela.sh" "$n" "$f" > model.pml
  spin -a model.pml > /dev/null
  gcc -O2 -DNOREDUCE -DSAFETY -DNOFAIR -DMEMLIM=20000 -w -o pan1 pan.c
  gcc -O2 -DNOREDUCE -DSAFETY -DNOFAIR -DMEMLIM=20000 -DNCORE=2 -w -o pan2 pan.c
  local failures=FALSE
  [ "$f" = 1 ] && failures=TRUE
  cp "$here/Fleet.tla" .
  printf 'SPECIFICATION Spec\nCONSTANTS N = %d\nFailures = %s\nINVARIANT Inv\n' "$n" "$failures" > Fleet.cfg
  for run in $(seq "${RUNS:-3}"); do
    for workers in 1 2; do
      timed "explorer$workers" env WORKERS=$workers "$explorer" "$n" "$f"
      timed "spin$workers" ./pan$workers -m1000000 -w$width
    done
  done
  echo
  echo "N = $n, F = $f"
  echo "| tool                         |      states | 1: s     | 2: s     | 1: CPU s | 2: CPU s | gain  |"
  echo "| ---------------------------- | ----------- | -------- | -------- | -------- | -------- | ----- |"
  both "dolphin explorer" "$(awk '/states/ { print $1 }' explorer2.out)" explorer
  both "SPIN, -DNCORE=2" "$(spin_states spin1)" spin
  if [ "$n" -le 6 ] && [ "${TLC:-yes}" != no ]; then
    for workers in 1 2; do
      timed "tlc$workers" java -XX:+UseParallelGC -cp "$jar" tlc2.TLC -deadlock -workers $workers -config Fleet.cfg Fleet
    done
    both "TLC, -workers 2" "$(sed -n 's/.* generated, \([0-9]*\) distinct.*/\1/p' tlc2.out | tail -1 | tr -d ,)" tlc
  fi
}

[ $# -gt 0 ] || set -- 6,1 7,0
for case in "$@"; do compare "${case%,*}" "${case#*,}"; done
