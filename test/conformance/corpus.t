This implementation passes the corpus, and notices what is wrong in the cases that must fail.

  $ dolphin conform ../../conformance
  542 passed, 0 failed

So it does when it is asked as others are. A second runner, in Python, comes to the same verdicts, case by case.

  $ dolphin conform --impl 'dolphin step' --verbose ../../conformance > ours
  $ head -n 1 ours
  dolphin 0.1.0
  $ sed 1d ours > verdicts
  $ cases=$(find ../../conformance/cases ../../conformance/must-fail ../../conformance/times -name '*.json' | LC_ALL=C sort)
  $ python3 runner.py 'dolphin step' $cases > python
  $ diff verdicts python
  $ tail -n 1 python
  542 passed, 0 failed

Each rule of the semantics has a case that is about it, and takes it.

  $ dolphin conform --matrix ../../conformance > matrix
  $ sed '$d' matrix | awk '{ print $1 }' | LC_ALL=C sort > in_matrix
  $ sed -n 's/^ *---* *\[\([A-Z0-9-]*\)\]$/\1/p' ../../docs/semantics.md | LC_ALL=C sort > in_semantics
  $ diff in_matrix in_semantics
  $ grep ' none$' matrix
  [1]
  $ grep '^SEQ-ERR' matrix | grep -o 'seq/error-skips-the-rest'
  seq/error-skips-the-rest

A rule that no case is about is told, and is a failure.

  $ dolphin conform --matrix ../../conformance/cases/seq | tail -n 2 | sed 's/, ACTION-ERR.*, INTERRUPT/, ..., INTERRUPT/'
  no case is about FAIL, ACTION, ..., INTERRUPT, ON-INTERRUPT
  9 passed, 0 failed
  $ dolphin conform --matrix ../../conformance/cases/seq > /dev/null
  [1]

Cases, requests and replies are as the schemas say.

  $ python3 schema.py ../../conformance/schema/case.schema.json $cases
  542 checked, 0 wrong
  $ cat > talk << 'END'
  > #!/bin/sh
  > tee requests | dolphin step | tee replies
  > END
  $ chmod +x talk
  $ dolphin conform --impl ./talk ../../conformance/cases/script ../../conformance/cases/wait ../../conformance/cases/rejected ../../conformance/times > /dev/null
  $ cat requests replies | python3 schema.py ../../conformance/schema/step.schema.json --lines | sed 's/^[0-9]*/N/'
  N checked, 0 wrong
