Descriptors 0 to 2 may be closed: they are on /dev/null then, and nothing else takes their numbers. Standard input that
is closed has no answers.

  $ cat > ask.dol <<'EOF'
  > v = pick { type 'UUV' }
  > x = ask 'Well?'
  > EOF
  $ cat > confirm.dol <<'EOF'
  > v = pick { type 'UUV' }
  > execute imcPlan('visit') | confirm('Go?')
  > EOF
  $ dolphin exec ask.dol < /dev/null > ask.log 2> ask.errors
  [1]
  $ dolphin exec ask.dol <&- > closed.log 2> closed.errors
  [1]
  $ cmp ask.log closed.log && cmp ask.errors closed.errors
  $ dolphin exec confirm.dol < /dev/null > confirm.log 2> confirm.errors
  [1]
  $ dolphin exec confirm.dol <&- > closed.log 2> closed.errors
  [1]
  $ cmp confirm.log closed.log && cmp confirm.errors closed.errors

Without a log and without messages the run and its journal are the same.

  $ dolphin exec confirm.dol --journal kept.run < /dev/null > /dev/null 2>&1
  [1]
  $ dolphin exec confirm.dol --journal closed.run <&- >&- 2>&-
  [1]
  $ tail -n +2 kept.run > kept; tail -n +2 closed.run | cmp - kept

Every command can be started so.

  $ echo "v = pick { type 'UUV' }" > pick.dol
  $ for command in 'check pick.dol' 'explore pick.dol' 'time pick.dol' 'lts pick.dol' 'fleet pick.dol' \
  >   'parse pick.dol' 'plan pick.dol' 'fmt pick.dol' 'tla pick.dol' 'doctor' 'runs' 'exec pick.dol --runs 10' \
  >   'trace check confirm.dol kept.run' 'trace show kept.run' 'step' 'lsp' 'walk pick.dol' 'sim --platform' \
  >   'conform' 'help'; do
  >   dolphin $command < /dev/null > opened.out 2> opened.errors; opened=$?
  >   dolphin $command <&- > closed.out 2> closed.errors; closed=$?
  >   [ $opened = $closed ] || echo "$command: $opened, with standard input closed $closed"
  >   dolphin $command <&- >&- 2>&-; closed=$?
  >   [ $opened = $closed ] || echo "$command: $opened, with all of them closed $closed"
  > done

  $ check-journals
