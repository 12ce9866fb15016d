# The paper's mission, to be sourced: N vehicles survey, post and stay for ten minutes; one visits each, in any order.

# What the arguments make of each number from 1 to N, joined by the second one.
each() {
  i=1
  while [ "$i" -le "$1" ]; do
    [ "$i" = 1 ] || printf '%b' "$2"
    printf '%s' "$3" | sed "s/#/$i/g"
    i=$((i + 1))
  done
}

# mission N LEAST MOST: mission.dol and mission.fleet, in which a visit takes from the second to the third time.
mission() {
  {
    echo "UUVs = pick { count $1; type 'UUV' }"
    echo "UAV = pick { type 'UAV' }"
    echo "def work(i) { imcPlan('survey' + i) >> action { post ready: i } >> idle(10.min) }"
    echo "execute UUVs: $(each "$1" ' | ' 'work(#)'), UAV: allOf {"
    each "$1" '\n' "  when { consume ready: # } then imcPlan('visit#')"
    printf '\n}\nrelease UUVs + UAV\n'
  } > mission.dol
  {
    each "$1" '\n' "vehicle 'uuv-#', { type 'UUV' }"
    printf "\nvehicle 'uav', { type 'UAV' }\n"
    each "$1" '\n' "plan 'survey#', { duration 4.min, 7.min }"
    echo
    each "$1" '\n' "plan 'visit#', { duration $2, $3 }"
    echo
  } > mission.fleet
}
