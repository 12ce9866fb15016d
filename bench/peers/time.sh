#!/bin/bash
# time.sh [N[,G] ...]: `dolphin time`, which knows milliseconds, and checkers that count ticks, of which G are a minute
# (default: 1), on the paper's mission: N vehicles survey for 4 to 7 minutes, post, and stay for 10; a plane visits each
# for 1 to 2, in any order. All must find the same bounds: that the mission is over from E to L ticks after the start
# holds, and neither E + 1 nor L - 1 does. A table of CPU seconds (user and system) and memory of the whole process,
# with ratios: of peers what searches, and below that with what makes it of the model's text (spin -a or rumur, and
# gcc). Ours is the mean of 20 runs; its states are those of both of its searches. Default: 3 4 5 6 3,6. Installs spin
# and rumur from Debian, where they are missing.
set -euo pipefail
TLC=no
tools=rumur
program=bin/dolphin.exe
. "$(dirname "$0")/tools.sh"
. "$root/bench/time/paper.sh"

# spin_model NAME FLAG..., rumur_model NAME [symmetric]: model.pml and model.m, compiled; the cost of that goes to
# $work/NAME-made.cost. Bounds are $earliest and $latest.
spin_model() {
  "$here/time_promela.sh" "$n" "$grain" "$earliest" "$latest" > model.pml
  rm -f pan
  measure "$1-made" bash -c 'spin -a model.pml && gcc -O2 -DSAFETY -DNOFAIR -DMEMLIM=20000 "$@" -w -o pan pan.c' "$@"
}

export -f compile_rumur
rumur_model() {
  "$here/time_murphi.sh" "$n" "$grain" "$earliest" "$latest" "${2:-}" > model.m
  rm -f rumur.exe
  measure "$1-made" bash -c compile_rumur
}

held() { grep -q "$2" "$work/$1.out" || { echo "$1: other bounds than $earliest to $latest" >&2; exit 1; }; }

# refuted E L: narrower bounds than the true ones do not hold, for either.
refuted() {
  local earliest=$1 latest=$2
  spin_model refuted -DNOREDUCE
  measure refuted ./pan -m1000000 -w22
  grep -q 'errors: 1' refuted.out || { echo "SPIN: $1 to $2 holds too" >&2; exit 1; }
  rumur_model refuted symmetric
  ! ./rumur.exe > /dev/null 2>&1 || { echo "rumur: $1 to $2 holds too" >&2; exit 1; }
}

# peer NAME TITLE STATES: its lines of the table.
peer() {
  expected=$3
  row "$1" "$2" "$3"
  awk '{ seconds += $1 + $2; if ($3 > memory) memory = $3 } END { print seconds, 0, memory }' \
    "$work/$1.cost" "$work/$1-made.cost" > "$work/$1-whole.cost"
  row "$1-whole" "  from the model's text" "$3"
}

compare() {
  n=$1 grain=$2
  cd "$work"
  mission "$n" 1.min 2.min
  measure explorer "$explorer" time mission.dol
  measure runs bash -c 'for i in {1..20}; do "$0" time mission.dol; done' "$explorer"
  awk '{ print $1 / 20, $2 / 20, $3 }' "$work/runs.cost" > "$work/explorer.cost"
  read -r earliest latest < \
    <(sed -n 's/^completed: \([0-9]*\):00 at the earliest, \([0-9]*\):00 at the latest/\1 \2/p' explorer.out)
  echo
  echo "N = $n, $grain ticks a minute: $earliest to $latest minutes"
  earliest=$((earliest * grain)) latest=$((latest * grain))
  heading
  expected=$(sed -n 's/^\([0-9,]*\) states, .*/\1/p' explorer.out | tr -d ,)
  row explorer "dolphin time" "$expected"
  spin_model spin -DNOREDUCE
  measure spin ./pan -m1000000 -w24
  held spin 'errors: 0'
  peer spin "SPIN -DNOREDUCE -O2 -DSAFETY -w24" "$(spin_states spin)"
  spin_model spin-po
  measure spin-po ./pan -m1000000 -w24
  held spin-po 'errors: 0'
  peer spin-po "SPIN, partial order" "$(spin_states spin-po)"
  rumur_model rumur
  measure rumur ./rumur.exe
  held rumur 'No error found'
  peer rumur "rumur, 1 thread, -O3" "$(rumur_states rumur)"
  rumur_model rumur-sym symmetric
  measure rumur-sym ./rumur.exe
  held rumur-sym 'No error found'
  peer rumur-sym "rumur, symmetry" "$(rumur_states rumur-sym)"
  refuted "$((earliest + 1))" "$latest"
  refuted "$earliest" "$((latest - 1))"
}

[ $# -gt 0 ] || set -- 3 4 5 6 3,6
for case in "$@"; do
  case $case in *,*) compare "${case%,*}" "${case#*,}" ;; *) compare "$case" 1 ;; esac
done
