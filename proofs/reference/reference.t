The extracted interpreter passes the conformance corpus, but for the cases of `ensure`, which is
not in the calculus.

  $ dolphin conform --impl ./dolphin_reference.exe ../../conformance/cases > verdicts
  [1]
  $ head -n 1 verdicts
  dolphin, extracted from proofs/
  $ grep '^failed' verdicts | grep -v /cases/ensure/
  [1]
  $ grep -c '^failed' verdicts
  4
