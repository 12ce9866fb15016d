What is told on standard error beside the log of a run: nothing, unless it is asked for.

  $ cat > short.dol <<'EOF'
  > post ready: 1
  > EOF
  $ dolphin exec short.dol
     0:00  program     posts ready:1
     0:00  program     ends

What is started.

  $ dolphin exec short.dol -v --journal short.run 2>&1 > log.txt
  dolphin.app info: program short.dol, fleet built in, seed 0, journal short.run
  $ cat log.txt
     0:00  program     posts ready:1
     0:00  program     ends

Every event, transition and effect.

  $ dolphin exec short.dol -vv 2>&1 > log.txt | grep post
  dolphin.runtime debug: 0.000 post ready:1
  $ dolphin exec short.dol --verbosity debug 2>&1 > log.txt | grep post
  dolphin.runtime debug: 0.000 post ready:1
  $ dolphin exec short.dol --verbosity much
  dolphin: option '--verbosity': "much": unknown log level
  Usage: dolphin exec [OPTION]… PROG
  Try 'dolphin exec --help' or 'dolphin --help' for more information.
  [2]
  $ check-journals
