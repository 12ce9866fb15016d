#!/bin/sh
# How long `dolphin time` takes for N vehicles that survey, post and stay for ten minutes, and one that meets each, in
# any order: bench/time/mission.sh 3 4 5; WORKERS=2 with so many processes, OPTIONS=--slack with what it says.
set -eu
cd "$(dirname "$0")/../.."
dolphin=$PWD/_build/default/bin/dolphin.exe
. bench/time/paper.sh
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"

for n in "$@"; do
  mission "$n" 40.seconds 80.seconds
  echo "N = $n"
  "$dolphin" time mission.dol --workers "${WORKERS:-1}" ${OPTIONS:-} 2> /dev/null | grep -e '^completed' -e ' states, '
done
