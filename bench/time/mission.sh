#!/bin/sh
# How long `dolphin time` takes for N vehicles that survey, post and stay for ten minutes, and one that meets each, in
# any order: bench/time/mission.sh 3 4 5
set -eu
cd "$(dirname "$0")/../.."
dolphin=_build/default/bin/dolphin.exe
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# What the arguments make of each number from 1 to N, joined by the second one.
each() {
  i=1
  while [ "$i" -le "$1" ]; do
    [ "$i" = 1 ] || printf '%s' "$2"
    printf '%s' "$3" | sed "s/#/$i/g"
    i=$((i + 1))
  done
}

for n in "$@"; do
  {
    echo "UUVs = pick { count $n; type 'UUV' }"
    echo "UAV = pick { type 'UAV' }"
    echo "def work(i) { imcPlan('survey' + i) >> action { post ready: i } >> idle(10.min) }"
    echo "execute UUVs: $(each "$n" ' | ' 'work(#)'), UAV: allOf {"
    each "$n" '
' "  when { consume ready: # } then imcPlan('visit#')"
    printf '\n}\nrelease UUVs + UAV\n'
  } > "$folder/mission.dol"
  {
    each "$n" '
' "vehicle 'uuv-#', { type 'UUV' }"
    printf "\nvehicle 'uav', { type 'UAV' }\n"
    each "$n" '
' "plan 'survey#', { duration 4.min, 7.min }"
    echo
    each "$n" '
' "plan 'visit#', { duration 40.seconds, 80.seconds }"
    echo
  } > "$folder/mission.fleet"
  echo "N = $n"
  "$dolphin" time "$folder/mission.dol" 2> /dev/null | grep -e '^completed' -e ' states, '
done
