#!/bin/bash
# promela.sh N F: the model for SPIN; N vehicles, F = 1 with failures. One process of guarded commands, each one
# transition, over small variables: the fastest of the forms tried (processes with a counter each are slower and have
# larger states).
N=$1; F=$2
tasks=$((3 * N))
cat <<X
/* u: 0 survey to start, 1 runs, 2 to post, 3 sk to start, 4 runs, 5 over.  ready[i]: how many tuples ready:i.
   rv: 0 not yet consumed, 1 to start, 2 runs, 3 over.
   phase: 0-4 script, 5 executing, 6 script, 7 ended, 8.. failed. */
byte phase, u[$N], ready[$N], rv[$N], busy, left = $((2 * N));
#define executing (phase == 5 && left > 0)
active proctype system() {
end: do
:: d_step { phase < 5 -> phase++ }
:: d_step { phase == 5 && left == 0 -> phase = 7 }
X
reset="left = 0; busy = 0"
for ((j = 0; j < N; j++)); do reset="$reset; u[$j] = 0; rv[$j] = 0"; done
for ((i = 0; i < N; i++)); do
  cat <<X
:: d_step { executing && u[$i] == 0 -> u[$i] = 1 }
:: d_step { executing && u[$i] == 1 -> u[$i] = 2 }
:: d_step { executing && u[$i] == 2 -> u[$i] = 3; ready[$i]++ }
:: d_step { executing && u[$i] == 3 -> u[$i] = 4 }
:: d_step { executing && u[$i] == 4 -> u[$i] = 5; left-- }
:: d_step { executing && !busy && rv[$i] == 0 && ready[$i] > 0 -> ready[$i]--; rv[$i] = 1; busy = 1 }
:: d_step { executing && rv[$i] == 1 -> rv[$i] = 2 }
:: d_step { executing && rv[$i] == 2 -> rv[$i] = 3; busy = 0; left-- }
X
  [ "$F" = 1 ] && cat <<X
:: d_step { executing && u[$i] == 1 -> phase = $((8 + 3 * i)); $reset }
:: d_step { executing && u[$i] == 4 -> phase = $((9 + 3 * i)); $reset }
:: d_step { executing && rv[$i] == 2 -> phase = $((10 + 3 * i)); $reset }
X
done
echo "od }"
