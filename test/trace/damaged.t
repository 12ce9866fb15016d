Runs that start at once keep journals of their own, also where all of them start in one second.

  $ export XDG_STATE_HOME=$PWD/state
  $ echo "v = pick { type 'UUV' }" > pick.dol
  $ for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
  >   (dolphin exec pick.dol --keep > $i.log 2>&1; echo $? > $i.status) &
  > done; wait
  $ cat *.status | sort | uniq -c | sed 's/^ *//'; ls state/dolphin/runs | wc -l
  12 0
  12

A run that does not begin leaves nothing behind.

  $ dolphin exec pick.dol --keep --draw missing/folder.svg 2> /dev/null
  [3]
  $ ls state/dolphin/runs | wc -l
  12

What no vehicle can have shown is not the line of a run, nor is what JSON does not have.

  $ dolphin exec pick.dol --journal pick.run > log
  $ check() { sed "$1" pick.run > changed.run; dolphin trace check pick.dol changed.run 2>&1 | cut -c 1-90; }
  $ check 's/"battery":1,/"battery":7,/' | head -n 1
  dolphin: changed.run:3: "battery" is 7, not a number from 0 to 1
  $ check 's/"height":0,/"height":1e308,/' | head -n 1
  dolphin: changed.run:3: "height" is 1e+308, not a number from -20000 to 1e+06
  $ for name in speed cruise drain; do check '3s/"'$name'":[0-9.]*/"'$name'":-5/' | head -n 1; done
  dolphin: changed.run:3: "speed" is -5, not a number from 0
  dolphin: changed.run:3: "cruise" is -5, not a number from 0
  dolphin: changed.run:3: "drain" is -5, not a number from 0
  $ for time in 1e300 -1; do check '3s/"time":0,/"time":'$time',/' | head -n 1; done
  dolphin: changed.run:3: "time" is 1e+300, not a number from 0 to 1e+18
  dolphin: changed.run:3: "time" is -1, not a number from 0 to 1e+18
  $ for reader in "trace show" "trace draw -o x.svg" "trace export -o x.gpx" "exec pick.dol --resume"; do
  >   sed '3s/"time":0,/"time":1e300,/' pick.run > changed.run; dolphin $reader changed.run 2>&1 | grep -o '"time" is.*'
  > done
  "time" is 1e+300, not a number from 0 to 1e+18
  "time" is 1e+300, not a number from 0 to 1e+18
  "time" is 1e+300, not a number from 0 to 1e+18
  "time" is 1e+300, not a number from 0 to 1e+18
  $ echo "pause 5.seconds" > pause.dol; dolphin exec pause.dol --journal pause.run > log
  $ sed 's/"seconds":[0-9.]*/"seconds":1e13/' pause.run > changed.run; dolphin trace check pause.dol changed.run
  dolphin: changed.run:2: "effects[0].seconds" is 1e+13, not a number from -1e+12 to 1e+12
  [2]
  $ sed '1s/"started"/"place":{"latitude":1,"longitude":1,"height":1e308},"started"/' pick.run > changed.run
  $ dolphin trace check pick.dol changed.run
  dolphin: changed.run:1: "place.height" is 1e+308, not a number from -20000 to 1e+06
  [2]
  $ for metres in 1e308 -1; do
  >   sed '1s/"started"/"fences":[{"fence":"depth","rule":"depth","metres":'$metres'}],"started"/' pick.run > changed.run
  >   dolphin trace check pick.dol changed.run 2>&1 | cut -c 1-70
  > done
  dolphin: changed.run:1: "fences[0].metres" is 1e+308, not a number fro
  dolphin: changed.run:1: "fences[0].metres" is -1, not a number from 0 
  $ for speed in 0 -1; do check '1s/"speed":null/"speed":'$speed'/' | head -n 1; done
  dolphin: changed.run:1: "speed" is 0, not a number above 0
  dolphin: changed.run:1: "speed" is -1, not a number above 0
  $ check 's/"time":0,/"time":1e999,/' | head -n 1
  dolphin: changed.run:2: this is not JSON: a number in it is not finite, or too large
  $ sed 's/"type":"UUV"/"type":"UU\xff"/' pick.run > changed.run; dolphin trace check pick.dol changed.run
  dolphin: changed.run:3: this is not JSON: a text in it is not UTF-8
  [2]

A run may end after the last date of a format.

  $ sed 's/"time":0,/"time":1e17,/' pick.run > late.run
  $ sed 's/"time":0,/"time":3e9,/' pick.run > mcap.run
  $ for format in geojson kml gpx csv mcap; do dolphin trace export late.run -o late.$format; done
  dolphin: pick.dol: the run ends after the year 9999, the last one of this format
  dolphin: pick.dol: the run ends after the year 9999, the last one of this format
  dolphin: pick.dol: the run ends after the year 9999, the last one of this format
  dolphin: pick.dol: the run ends after the year 9999, the last one of this format
  dolphin: pick.dol: the run ends after the year 2115, the last one of this format
  [2]
  $ dolphin trace export mcap.run -o late.mcap; ls late.*
  dolphin: pick.dol: the run ends after the year 2115, the last one of this format
  late.run
  $ dolphin trace export mcap.run -o mcap.geojson

An export that fails leaves the file as it was, and nothing beside it.

  $ mkdir out; echo before > out/pick.svg
  $ (ulimit -f 1; dolphin trace draw pick.run -o out/pick.svg) 2>&1 | sed 's/^[^:]*: //'
  the picture cannot be written: out/pick.svg: File too large
  $ cat out/*; ls -A out
  before
  pick.svg
  $ dolphin trace draw pick.run -o out/pick.svg; head -c 5 out/pick.svg; ls -A out
  <?xmlpick.svg
