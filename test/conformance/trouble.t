Cases that cannot be read are told before anything is judged.

  $ dolphin conform nowhere
  dolphin: nowhere: no such file or directory
  [2]
  $ mkdir empty && dolphin conform empty
  dolphin: empty: no cases here
  [2]
  $ echo '{' > broken.json && dolphin conform broken.json
  dolphin: broken.json: this is not JSON: Line 2, bytes -1-0: Unexpected end of input
  [2]
  $ cat > misspelt.json << 'END'
  > {"title": "t", "fleet": [], "program": ["post a: 1"], "expect": {"trace": [{"label": "post a:1", "effect": []}, "end"]}}
  > END
  $ dolphin conform misspelt.json
  dolphin: misspelt.json: expect.trace: unknown member "effect"; known are label, event, world, now, rule, effects, A, B, N, store, end
  [2]
  $ dolphin conform --impl-timeout=soon misspelt.json 2>&1 | head -n 1
  dolphin: option '--impl-timeout': invalid value 'soon', expected a floating

What was expected and what was seen is told for each case that fails.

  $ mkdir wrong
  $ cat > wrong/effects.json << 'END'
  > {"title": "A start without an effect", "fleet": ["vehicle 'a', { type 'UUV' }"],
  >  "program": ["v = pick { id 'a' }", "execute task('p')[v]"],
  >  "expect": {"trace": [{"until": "execute"}, {"label": "start(a, p)", "effects": []}]}}
  > END
  $ cat > wrong/outcomes.json << 'END'
  > {"title": "Two outcomes", "covers": ["HALT"], "fleet": [],
  >  "program": ["execute action { post a: 1 } | condition { consume a: 2 }"],
  >  "expect": {"outcomes": [{"ending": "completed"}], "deadlock": false,
  >             "admits": [["execute", "act(post a:1)", "check(consume a:2)"]], "forbids": [["execute", "act(post a:1)"]]}}
  > END
  $ cat > wrong/rejected.json << 'END'
  > {"title": "Another code", "fleet": [], "program": ["message x"], "expect": {"rejected": ["unknown-unit"], "deadlock": true}}
  > END
  $ cat > wrong/unnoticed.json << 'END'
  > {"title": "What must fail does not", "fleet": [], "program": [], "expect": {"trace": ["end"]}, "fails": ["trace"]}
  > END
  $ dolphin conform wrong
  failed wrong/effects.json: trace
    A start without an effect
    trace: step 2: the effects: expected [], seen [{"start":"p","on":"a"}]
  failed wrong/outcomes.json: admits, deadlock, forbids, outcomes
    Two outcomes
    outcomes: expected and not seen: completed with N {}; seen and not expected: stuck with N {a:1}
    deadlock: expected none, and some run gets stuck
    admits: step 3: nothing happens by itself, so check(consume a:2) does not
    forbids: step 2: act(post a:1) is possible
  failed wrong/rejected.json: deadlock, rejected
    Another code
    rejected: expected unknown-unit, seen unknown-name in line 1
    deadlock: the program is rejected: unknown-name in line 1
  failed wrong/unnoticed.json
    What must fail does not
    this case is wrong on purpose, in trace, and that was not noticed
  0 passed, 4 failed
  [1]

An implementation that dies, hangs or writes nonsense has failed. One that does so at once does not speak the protocol.

  $ dolphin conform --impl 'exit 3' wrong
  dolphin: the implementation does not speak the step protocol: it ended with exit status 3 without a reply
  [2]
  $ dolphin conform --impl '/nowhere/to/be/found 2> /dev/null' wrong
  dolphin: the implementation does not speak the step protocol: it ended with exit status 127 without a reply
  [2]
  $ dolphin conform --impl 'sleep 60' --impl-timeout 0.2 wrong
  dolphin: the implementation does not speak the step protocol: it did not reply within 0.2 s
  [2]
  $ dolphin conform --impl 'echo nonsense; cat > /dev/null' wrong
  dolphin: the implementation does not speak the step protocol: its reply is not JSON: Line 1, bytes 0-8: Invalid token 'nonsense'
  [2]
  $ dolphin conform --impl 'echo {}; cat > /dev/null' wrong
  dolphin: the implementation does not speak the step protocol: its reply has not the id of the request, 1
  [2]
  $ dolphin conform --impl "echo '{\"id\":1,\"protocol\":\"dolphin-step\",\"version\":2,\"implementation\":\"new\"}'; cat > /dev/null" wrong
  dolphin: the implementation does not speak the step protocol: this speaks version 2 of the protocol; version 1 is known here
  [2]

One that does so later has another try with the next case.

  $ mkdir few
  $ cp ../../conformance/cases/time/idle.json few/1.json
  $ cp ../../conformance/cases/time/during-cuts.json few/2.json
  $ cp ../../conformance/cases/time/idle-zero.json few/3.json
  $ cat > until_p << 'END'
  > #!/bin/sh
  > # Passes lines on up to one that names the plan p, and then does as it is told.
  > while IFS= read -r line; do
  >   case "$line" in *"task('p')"*) eval "$1"; exit;; esac
  >   printf '%s\n' "$line"
  > done | dolphin step
  > END
  $ chmod +x until_p
  $ dolphin conform --impl './until_p "exit 0"' few
  dolphin 0.1.0
  failed few/2.json: implementation
    When its time is up, what runs is stopped
    implementation: it ended with exit status 0 without a reply
  2 passed, 1 failed
  [1]
  $ dolphin conform --impl './until_p "sleep 60"' --impl-timeout 4 few
  dolphin 0.1.0
  failed few/2.json: implementation
    When its time is up, what runs is stopped
    implementation: it did not reply within 4 s
  2 passed, 1 failed
  [1]
  $ dolphin conform --impl 'dolphin step | sed -u s/timeout/time-out/' few
  dolphin 0.1.0
  failed few/1.json: trace
    idle is done when its time is up
    trace: step 2: the label: expected timeout, seen time-out
  failed few/2.json: trace
    When its time is up, what runs is stopped
    trace: step 5: the label: expected timeout, seen time-out
  failed few/3.json: trace
    idle 0 is a step, too
    trace: step 2: the label: expected timeout, seen time-out
  0 passed, 3 failed
  [1]
  $ dolphin conform --impl 'dolphin step | sed -u s/transitions/steps/' few
  dolphin 0.1.0
  failed few/1.json: implementation
    idle is done when its time is up
    implementation: the reply to step is not what the protocol has: "transitions" is missing
  failed few/2.json: implementation
    When its time is up, what runs is stopped
    implementation: the reply to step is not what the protocol has: "transitions" is missing
  failed few/3.json: implementation
    idle 0 is a step, too
    implementation: the reply to step is not what the protocol has: "transitions" is missing
  0 passed, 3 failed
  [1]
  $ dolphin conform --impl 'sed -u s/configuration/place/ | dolphin step' few
  dolphin 0.1.0
  failed few/1.json: implementation
    idle is done when its time is up
    implementation: the reply to step is the error bad-request: "configuration" is missing
  failed few/2.json: implementation
    When its time is up, what runs is stopped
    implementation: the reply to step is the error bad-request: "configuration" is missing
  failed few/3.json: implementation
    idle 0 is a step, too
    implementation: the reply to step is the error bad-request: "configuration" is missing
  0 passed, 3 failed
  [1]

Both commands have a manual.

  $ dolphin conform --help=plain | sed -n '/^EXIT STATUS/,/^EXAMPLES/p' | grep -v 'exits with' | uniq
  EXIT STATUS
  
         0   all cases pass.
  
         1   some do not; or with --matrix, no case is about some rule.
  
         2   a case cannot be read, or the implementation does not speak the
             step protocol.
  
         3   the platform or the output failed, not the program.
  
         125 a fault of dolphin itself. Please report it.
  
         130 the run was interrupted by Ctrl-C, by a request to terminate, or
             because its log has no reader any more.
  
  EXAMPLES
  $ dolphin step --help=plain | sed -n '/^NAME/,/^DESCRIPTION/p'
  NAME
         dolphin-step - compute the transitions of configurations, for other
         programs
  
  SYNOPSIS
         dolphin step [OPTION]…
  
  DESCRIPTION
  $ dolphin --help=plain | grep -A 1 '^       \(conform\|step\) '
         conform [OPTION]… [CASES]…
             judge an implementation by a corpus of cases
  --
         step [OPTION]…
             compute the transitions of configurations, for other programs
