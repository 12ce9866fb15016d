#!/bin/bash
# time_promela.sh N G E L: the mission of time.sh in ticks, G a minute, for SPIN; N vehicles. The assertion: over after
# E ticks at the earliest, L at the latest.
N=$1; G=$2; E=$3; L=$4
any() { for ((i = 0; i < N; i++)); do [ $i = 0 ] || printf ' %s ' "$1"; printf '%s' "${2//#/$i}"; done; }
ends="(st[#] == 0 && age[#] == $((7 * G))) || (st[#] == 1 && age[#] == $((10 * G)))"
ages=$(for ((i = 0; i < N; i++)); do printf '; if :: st[%d] < 2 -> age[%d]++ :: else fi' $i $i; done)
cat <<X
/* st: 0 surveys, 1 stays, 2 over, and age: since when, in ticks.  rv: 0 not posted, 1 posted, 2 visited now, 3 over.
   visit: since when the plane visits. Nothing waits that could go on: no tick while the plane could begin a visit. */
byte now, st[$N], age[$N], rv[$N], visit, left = $((2 * N));
bool busy, over;
#define urgent (!busy && ($(any '||' 'rv[#] == 1')))
#define due ((busy && visit == $((2 * G))) || $(any '||' "$ends"))
active proctype system() {
end: do
:: d_step { left > 0 && !urgent && !due ->
     now++; if :: busy -> visit++ :: else fi$ages }
:: d_step { left == 0 && !over -> over = 1; assert(now >= $E && now <= $L) }
X
for ((i = 0; i < N; i++)); do
  cat <<X
:: d_step { st[$i] == 0 && age[$i] >= $((4 * G)) && !urgent -> st[$i] = 1; age[$i] = 0; rv[$i] = 1 }
:: d_step { st[$i] == 1 && age[$i] == $((10 * G)) && !urgent -> st[$i] = 2; age[$i] = 0; left-- }
:: d_step { !busy && rv[$i] == 1 -> rv[$i] = 2; busy = 1 }
:: d_step { rv[$i] == 2 && visit >= $G -> rv[$i] = 3; busy = 0; visit = 0; left-- }
X
done
echo "od }"
