  $ dolphin parse ../../examples/until.dol
  v = pick { type 'UAV' }
  survey = imcPlan('long_survey')
  execute v: survey / { battery(v) < 0.3 } >> imcPlan('return_home')
  message "landed with ${(battery(v) * 100).round()} percent"

What it prints means the same.

  $ for program in ../../examples/*.dol; do
  >   dolphin parse "$program" > once.dol && dolphin parse once.dol | diff -q once.dol - || echo "$program"
  > done
  $ dolphin parse ../../examples/rendezvous.dol > again.dol
  $ cp ../../examples/rendezvous.fleet again.fleet
  $ dolphin exec again.dol > again.log
  $ dolphin exec ../../examples/rendezvous.dol | diff again.log -

Limits behind a command stay there, where they belong to its argument.

  $ echo "v = pick { type 'UUV' }; execute (task('a')) until { poll('k') } within 5.min" > limits.dol
  $ dolphin parse limits.dol
  v = pick { type 'UUV' }
  execute(task('a')) until { poll 'k' } within 5.min
  $ dolphin parse limits.dol > printed.dol && dolphin check printed.dol
  printed.dol: no errors
  $ for statement in "(task('a') >> task('b')) until { poll k: 1 } >> task('c')" "{ task('a') } during 5.min"; do
  >   echo "v = pick { count 2 }; execute $statement" > limits.dol
  >   dolphin parse limits.dol | tee printed.dol | tail -1; dolphin check printed.dol
  > done
  execute(task('a') >> task('b')) until { poll k: 1 } >> task('c')
  printed.dol: no errors
  execute { task 'a' } during 5.min
  printed.dol: no errors

Nobody need read all of it.

  $ python3 -c 'print("message 1\n" * 100000)' > long.dol
  $ dolphin parse long.dol | head -1
  message 1

Nor need there be room for it.

  $ dolphin parse long.dol > /dev/full
  dolphin: the output cannot be written: No space left on device
  [3]
  $ dolphin check long.dol > /dev/full
  dolphin: the output cannot be written: No space left on device
  [3]
  $ dolphin exec long.dol > /dev/full
  dolphin: the log cannot be written: No space left on device
  [3]

The programs that ran did what the semantics allows.

  $ check-journals
