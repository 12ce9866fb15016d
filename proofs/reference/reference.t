The extracted interpreter passes the conformance corpus.

  $ dolphin conform --impl ./dolphin_reference.exe ../../conformance/cases > verdicts
  $ head -n 1 verdicts
  dolphin, extracted from proofs/
  $ grep -c ' 0 failed$' verdicts
  1
