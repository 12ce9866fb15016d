The socket of a run. A run whose time passes by itself has one, beside its journal, for its user alone.

  $ cat > counts.dol << 'END'
  > input 'n', 'over'
  > execute until { poll over: true } run condition { poll n: -1 }
  > END
  $ started() { while [ ! -S "$1.sock" ]; do sleep 0.05; done; }
  $ dolphin exec counts.dol --speed 100 --journal counts.run > log 2>&1 &
  $ started counts.run
  $ ls -l counts.run.sock | cut -c 1-10
  srw-------
  $ dolphin post ./counts.run | sed 's/, at .*/, at TIME/'
  counts.dol, at TIME
  input 'n'
  input 'over'

An input may be one of a vehicle:

  $ cat > calls.dol << 'END'
  > input 'call', of: 'vehicle'
  > v = pick { type 'UUV' }
  > execute condition { poll call: v }
  > END
  $ dolphin help calls.dol
  Inputs, which dolphin post posts to a run:
    'call', of a vehicle
  $ dolphin exec calls.dol --speed 100 --journal calls.run > called 2>&1 &
  $ started calls.run
  $ dolphin post ./calls.run call
  dolphin: the input 'call' takes a vehicle, as in call: vehicles('x8-02')
  [2]
  $ dolphin post ./calls.run "call: vehicles('noptilus-1', 'noptilus-2')"
  dolphin: the input 'call' takes a vehicle, as in call: vehicles('x8-02')
  [2]
  $ dolphin post ./calls.run "call: vehicles('noptilus-1')"
  $ wait %2
  $ sed 's/^ *[0-9:]* *//' called
  program     picks noptilus-1
  program     gets call:noptilus-1
  program     sees that a condition holds
  program     releases noptilus-1
  program     ends

What is wrong with a pair is told, and nothing is posted:

  $ dolphin post ./counts.run 'm: 1'
  dolphin: the program declares no input 'm', only 'n', 'over'
  [2]
  $ dolphin post ./counts.run ovr
  dolphin: the program declares no input 'ovr': did you mean 'over'?
  [2]
  $ dolphin post ./counts.run 'n: south'
  dolphin: 'south' is not a value: put a text in quotes, 'south'
  [2]
  $ dolphin post ./counts.run 'n: '
  dolphin: give a key and a value, as in abort: true
  [2]
  $ dolphin post ./counts.run '{ }'
  dolphin: give a key and a value, as in abort: true
  [2]
  $ dolphin post ./counts.run "n: task('p')"
  dolphin: tasks and objects cannot be posted
  [2]
  $ dolphin post ./counts.run --stop 'n: 1'
  dolphin: --follow and --stop go with no pairs
  [2]

Twenty followers and one that never reads; a thousand inputs; wrong lines, each answered by an error:

  $ python3 clients.py counts.run.sock follow 20 > followed &
  $ while ! grep -qs following followed; do sleep 0.05; done
  $ python3 clients.py counts.run.sock post 1000
  1000
  $ python3 clients.py counts.run.sock garbage 1000
  1000
  $ dolphin post ./counts.run "n: 'last', over: true"
  $ wait
  $ cat followed
  following
  20 of 20 saw the end, all the same: True
  $ ls counts.run.sock 2> /dev/null
  [2]
  $ tail -2 log | cut -c 10-
  program     sees that the condition of until holds
  program     ends

None was lost, and their order was kept:

  $ grep '"input"' counts.run | sed 's/.*"value":\(.*\)}/\1/' > values
  $ seq 0 999 | diff - values | head -4
  1000a1001,1002
  > "last"
  > true
  $ dolphin trace check counts.dol counts.run | sed 's/ in .*;/ in TIME;/'
  counts.run: a run, of 1005 transitions in TIME; completed
  $ dolphin post ./counts.run over
  dolphin: ./counts.run: this run does not go on, or has no socket
  [2]

A stop is as Ctrl-C:

  $ (dolphin exec counts.dol --speed 100 --journal stopped.run > log 2>&1; echo $? >> log) &
  $ started stopped.run
  $ dolphin post --stop ./stopped.run
  $ wait
  $ tail -2 log | cut -c 10-
  program     is interrupted
  
  $ tail -1 log
  130

A run may be without, and a run in no time is:

  $ dolphin exec counts.dol --speed 100 --no-socket --journal quiet.run > log 2>&1 &
  $ pid=$!
  $ while [ ! -s quiet.run ]; do sleep 0.05; done; ls *.sock 2> /dev/null
  [2]
  $ kill $pid; wait
  $ echo "input 'over', true, after 1.min" > over.fleet
  $ dolphin exec counts.dol --fleet over.fleet --journal virtual.run | cut -c 10-
  program     gets over:true
  program     sees that the condition of until holds
  program     ends

The socket of a console that died is in nobody's way:

  $ python3 -c 'import socket; socket.socket(socket.AF_UNIX).bind("new.run.sock")'
  $ dolphin post ./new.run over
  dolphin: ./new.run: this run does not go on, or has no socket
  [2]
  $ dolphin exec counts.dol --fleet over.fleet --speed 600 --journal new.run | cut -c 10-
  program     gets over:true
  program     sees that the condition of until holds
  program     ends
  $ ls new.run.sock 2> /dev/null
  [2]

On a terminal, a line that is typed is an input; one that was typed before a question does not answer it.

  $ cat > typed.dol << 'END'
  > input 'go'
  > execute condition { consume go: 2 }
  > x = ask 'How many?'
  > y = ask 'How far?'
  > z = ask 'How deep?'
  > message "$x, $y, $z"
  > END
  $ : > typescript
  $ shown () { for i in $(seq 300); do grep -q "$1" typescript && break; sleep 0.1; done; sleep 0.2; }
  $ (echo 'go: north'; echo 'stay: 1'; echo 'go: 2'; shown 'asks: How many'; echo 3; shown 'asks: How far'; echo 40
  >  shown 'asks: How deep'; echo 5; shown 'program  *ends') | \
  >   TERM=xterm timeout 60 script -qf -c 'dolphin exec typed.dol --speed 1' typescript > /dev/null
  $ tr -d '\r' < typescript | grep -ao 'program  .*' | sed 's/ *$//'
  program     'north' is not a value: put a text in quotes, 'north'
  program     the program declares no input 'stay', only 'go'
  program     gets go:2
  program     consumes go:2
  program     asks: How many? (a value: 2, 'text', yes or no) 3
  program     asks: How far? (a value: 2, 'text', yes or no) 40
  program     asks: How deep? (a value: 2, 'text', yes or no) 5
  program     says: 3, 40, 5
  program     ends

Requests and replies are as the schema says.

  $ dolphin exec counts.dol --speed 100 --journal talk.run > log 2>&1 &
  $ started talk.run
  $ cat > requests << 'END'
  > {"request":"status","id":1}
  > {"request":"post","key":"n","value":[1,{"latitude":41.18,"longitude":-8.7}],"id":"a"}
  > {"request":"post","key":"over","value":true}
  > END
  $ python3 clients.py talk.run.sock talk < requests > replies
  $ wait
  $ cat requests replies | python3 ../conformance/schema.py ../../conformance/schema/socket.schema.json --lines
  6 checked, 0 wrong
  $ check-journals
