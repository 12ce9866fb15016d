A fault of each kind is noticed: a stand-in for dolphin shows it.

  $ fuzz() { python3 -B fuzz.py ./wrong.py --inputs 1 --limit 1 --only definitions --keep kept; }
  $ for wrong in none utf-8 control c1 direction json infinite bug signal busy asleep memory; do
  >   echo "$wrong: $(WRONG=$wrong fuzz | sed -n 1p)"
  > done
  none: 1 inputs of 1 readers, seed 0: 0 faults
  utf-8: definitions 0: standard error: invalid UTF-8: 'utf-8' codec can't decode byte 0xff in position 12: invalid start byte
  control: definitions 0: standard error: control character 0x1b
  c1: definitions 0: standard error: control character 0x9b
  direction: definitions 0: standard error: control character 0x202e
  json: definitions 0: standard output: not JSON: NaN is not JSON
  infinite: definitions 0: standard output: not JSON: 1e999 is not finite
  bug: definitions 0: ends with 125
  signal: definitions 0: dies of signal 11
  busy: definitions 0: does not end
  asleep: definitions 0: does not end
  memory: definitions 0: needs more than 1 GB

What had a fault is kept: the input, the command, what came out.

  $ ls kept/*
  IMC.xml
  command
  m.dol
  stderr
  stdout
  why
