Acts of operators stand in journals, and mean nothing to the run.

  $ cat > two.dol <<'END'
  > message 'begins'
  > x = ask 'How many?'
  > message x
  > pause 2.seconds
  > END
  $ echo 3 | dolphin exec two.dol --quiet --journal two.run > /dev/null

  $ awk '{ print } /"ask":"How/ { print "{\"kind\":\"operator\",\"time\":0,\"operator\":\"rui\",\"role\":\"answer\",\"did\":\"answer\",\"question\":\"How many?\",\"text\":\"3\"}" }
  >   /"label":"pause/ { print "{\"kind\":\"operator\",\"time\":0,\"operator\":\"ana\",\"role\":\"steer\",\"did\":\"take-helm\",\"from\":\"rui\"}\n{\"kind\":\"operator\",\"time\":0,\"operator\":\"ana\",\"role\":\"steer\",\"did\":\"replace\",\"program\":\"new.dol\"}\n{\"kind\":\"operator\",\"time\":0,\"operator\":\"ana\",\"role\":\"admin\",\"did\":\"shut-out\",\"name\":\"rui\"}" }' two.run > known.run
  $ dolphin trace check two.dol known.run
  known.run: a run, of 7 transitions in 0:02; completed
  $ dolphin trace show known.run
      time  program
      0:00  says: begins
            asks: How many?
            rui (answer) answers 'How many?': 3
            is answered: 3
            says: 3
            pause(2)
            ana (steer) has the helm, which was rui's
            ana (steer) replaces the program by new.dol
            ana (admin) shuts out rui
      0:02  completed

An act that is not known is not passed over.

  $ sed 's/take-helm/take-off/' known.run > strange.run
  $ dolphin trace check two.dol strange.run
  dolphin: strange.run:9: "did" is 'take-off', not one of start, resume, answer, post, replace, stop, take-helm, leave-helm, shut-out
  [2]
