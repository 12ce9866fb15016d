A mission to start from is right, and checks itself.

  $ dolphin new survey
  survey is a mission to start from; see its README.md. Try there:
    dolphin exec mission.dol      runs it on the simulated fleet
    dolphin explore mission.dol   checks every possible run
  $ find survey -type f | sort
  survey/.github/workflows/mission.yml
  survey/README.md
  survey/check.sh
  survey/mission.dol
  survey/mission.fleet
  $ survey/check.sh | sed 's/[0-9]* states.*/N states/; s/journal .*/journal FILE/'
  mission.dol: no errors
  mission.fleet: no errors
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  no halt: holds
  no leftover tuples: holds
  all code reached: holds
  N states
     8:54  program     says: The vehicles are done.
     8:54  program     ends
  completed after 8:54
    tasks    2 done
    journal FILE

It is not written over what is there.

  $ dolphin new survey
  dolphin: survey: something is there; name a folder that is not there yet, or is empty
  [2]
  $ dolphin new survey/README.md/further
  dolphin: survey/README.md/further: Not a directory
  [3]

The programs that ran did what the semantics allows.

  $ check-journals
