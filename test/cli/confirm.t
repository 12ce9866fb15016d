`confirm` as part of a task: a question that a task waits for, while others go on.

  $ cat > gate.dol << 'END'
  > v = pick { type 'UUV' }
  > execute (task('survey')[v]) | watch (confirm('Go on?') >> action { message 'on' }) onError { why ->
  >     message why
  >     ignore()
  > }
  > END
  $ cat > gate.fleet << 'END'
  > vehicle 'a', { type 'UUV' }
  > plan 'survey', { duration 5.min }
  > END

As people type it. Any other answer is asked for again; that nobody answers is an error of the task.

  $ printf 'perhaps\n No \n' | dolphin exec gate.dol
     0:00  program     picks a
     0:00  a           starts survey
     0:00  program     asks: Go on? perhaps
     0:00  program     cannot take this answer: it takes yes or no
     0:00  program     asks: Go on?  No 
     0:00  program     says: 'Go on?' was answered no
     5:00  a           ends survey
     5:00  program     releases a
     5:00  program     ends
  $ for answer in yes Y true no n FALSE; do dolphin exec gate.dol --answer "$answer" | grep says; done
     0:00  program     says: on
     0:00  program     says: on
     0:00  program     says: on
     0:00  program     says: 'Go on?' was answered no
     0:00  program     says: 'Go on?' was answered no
     0:00  program     says: 'Go on?' was answered no
  $ dolphin exec gate.dol < /dev/null | grep says
     0:00  program     says: no answer to 'Go on?': end of input

The fleet's answers, in their order; one that is neither yes nor no counts as none.

  $ (cat gate.fleet; echo "answer 'Go on?', 'well', yes") > well.fleet
  $ echo y | dolphin exec gate.dol --fleet well.fleet | grep -v survey
     0:00  program     picks a
     0:00  program     asks: Go on? 'well'
     0:00  program     cannot take this answer: it takes yes or no
     0:00  program     asks: Go on? yes
     0:00  program     says: on
     5:00  program     releases a
     5:00  program     ends

Journals have questions and answers, and are checked and resumed with them. A question that stood is put again:

  $ dolphin exec gate.dol --answer yes --journal gate.run > log
  $ grep -o '{"put-question[^}]*}\|"event":"confirmation".*' gate.run
  {"put-question":1,"prompt":"Go on?"}
  "event":"confirmation","question":1,"yes":true}
  $ dolphin trace check gate.dol gate.run
  gate.run: a run, of 8 transitions in 5:00; completed
  $ sed '/start(a/q' gate.run > cut.run
  $ echo no | dolphin exec gate.dol --resume cut.run
     0:00  program     asks: Go on? no
     0:00  program     says: 'Go on?' was answered no
     5:00  a           ends survey
     5:00  program     releases a
     5:00  program     ends
  $ dolphin trace check gate.dol cut.run
  cut.run: a run, of 7 transitions in 5:00; completed

It died when the journal had the answer, and nothing had come of it; and after that, when it is not asked again:

  $ sed '/"confirmation"/q' gate.run > cut.run
  $ dolphin exec gate.dol --resume cut.run < /dev/null | head -1
     0:00  program     is answered: yes
  $ sed '/act(message/q' gate.run > cut.run
  $ dolphin exec gate.dol --resume cut.run < /dev/null | head -1
     5:00  a           ends survey

The fleet goes on with its next answer:

  $ cat > twice.dol << 'END'
  > execute repeat 2, watch confirm('Go on?') onError { why -> message why; ignore() }
  > END
  $ echo "answer 'Go on?', true, no" > twice.fleet
  $ dolphin exec twice.dol --journal twice.run
     0:00  program     asks: Go on? true
     0:00  program     asks: Go on? no
     0:00  program     says: 'Go on?' was answered no
     0:00  program     ends
  $ sed '/"CONFIRM-YES"/q' twice.run > cut.run
  $ dolphin exec twice.dol --resume cut.run | head -1
     0:00  program     asks: Go on? no

Approval before each retrieval. dolphin explore takes both answers, at any time; a handler that forgets ignore() lets one
no stop the other vehicle, and the program:

  $ cp ../../examples/approval.* .
  $ dolphin explore approval.dol | grep -v note | sed 's/, [0-9.]* s,.*//'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  15 states, 22 transitions, depth 10
  $ sed '/^ *ignore()$/d' approval.dol > strict.dol
  $ dolphin explore strict.dol --fleet approval.fleet | sed -n 3p
  no unhandled error: violated after 6 steps: an unhandled error ends the program
  $ sed "/^answer/d" approval.fleet > unsaid.fleet
  $ dolphin explore strict.dol --fleet unsaid.fleet | sed -n 3p
  no unhandled error: violated after 6 steps: an unhandled error ends the program

Nor would it help if all said yes: nobody need do so in time.

  $ sed "s/, no$//; s/ no, yes/ yes/" approval.fleet > approved.fleet
  $ dolphin explore strict.dol --fleet approved.fleet | sed -n 3p
  no unhandled error: violated after 6 steps: an unhandled error ends the program

Without its limit, a question that nobody answers is waited for. How long, nobody knows:

  $ dolphin time approval.dol | grep -A 1 latest
  completed: 5:00 at the earliest, 42:00 at the latest
  approval.dol:7:11: within: missed, at 35:00 to 42:00
  $ sed 's/ within 30.minutes//' approval.dol > unlimited.dol
  $ dolphin time unlimited.dol --fleet approval.fleet | grep -A 1 latest
  completed: 5:00 at the earliest, no latest time
  duration unknown: an answer to 'Retrieve noptilus-1?'

A run whose time passes by itself takes answers by its socket, too, while nobody is at its terminal:

  $ cat > stands.dol << 'END'
  > execute confirm('One?') >> confirm("Two?")
  > END
  $ started() { while [ ! -S "$1.sock" ]; do sleep 0.05; done; }
  $ stands() { until dolphin post ./stands.run | grep -qF "$1"; do sleep 0.05; done; }
  $ dolphin exec stands.dol --speed 100 --journal stands.run > log 2>&1 < /dev/null &
  $ started stands.run
  $ stands 'One?'
  $ dolphin post ./stands.run | sed 's/, at .*/, at TIME/'
  stands.dol, at TIME
  question 'One?': yes or no
  $ dolphin post ./stands.run "'Two?': yes"
  dolphin: the program declares no input 'Two?', only 'One?'
  [2]
  $ dolphin post ./stands.run "'One?': 3"
  dolphin: the question 'One?' takes yes or no
  [2]
  $ dolphin post ./stands.run "'One?': yes"
  $ stands 'Two?'
  $ dolphin post ./stands.run "'One?': yes"
  dolphin: the program declares no input 'One?', only 'Two?'
  [2]
  $ dolphin post ./stands.run "'Two?': no"
  $ wait
  $ cut -c 10- log
  program     asks: One? yes
  program     asks: Two? no
  program     fails: 'Two?' was answered no
  l:1:28: error: 'Two?' was answered no
  cute confirm('One?') >> confirm("Two?")
                          ^^^^^^^^^^^^^^^
  $ check-journals
