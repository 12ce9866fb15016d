The simulated fleet passes the kit, with a hundred vehicles.

  $ cat > kit.fleet <<'END'
  > plan 'short', { duration 1.second }
  > plan 'long', { duration 24.hours }
  > END
  $ for i in $(seq -w 100); do echo "vehicle 'auv-$i', { type 'UUV' }" >> kit.fleet; done
  $ dolphin platform check "dolphin sim kit.fleet --platform --state kit.state --speed 5" --junit kit.xml
  ok    greeting         greets within 10 s, before all else (it is sim, and takes name, imcPlan, mission)
  ok    vehicles         reports a vehicle that is ready, at first with type and link (auv-001 is ready)
  ok    strange-orders   ignores orders and members that it does not know
  ok    refused-line     reports its vehicles again, with all members, when a line is refused
  ok    completion       runs a plan to its end, and reports one end
  ok    next             runs the next plan at once
  ok    pings            answers pings while a vehicle runs a plan
  ok    start-twice      takes a start that comes twice for one
  ok    stop             stops a plan, and reports one end, the same again when asked again
  ok    stop-stranger    answers the stop of a request that it never heard of
  ok    stop-at-once     stops a plan before reporting it as taken, and is free then
  ok    refusal          refuses what it cannot do, in words, and is free then
  ok    validation       reports the problems of a plan, and moves nothing
  ok    slow-reader      loses nothing while its output is not read
  ok    all-at-once      commands all of its vehicles at once, up to 100 (100 at once)
  ok    killed           after its death reports the outcome of a plan that ran (it reports 'taken')
  ok    killed-after-end after its death does not rerun an ended plan (it reports 'done')
  ok    resume-twice     answers a second 'resume' as the first
  ok    never-ordered    does not claim a request that was never ordered (it reports 'absent')
  ok    lost-notes       does not rerun a plan on which the journal has lost its notes (it reports 'done' and 'taken')
  ok    console-dies     lets vehicles fly on when its input ends, and ends (it reports 'taken')
  ok    close            stops all vehicles, reports 'quiet', and ends
  22 of 22 situations passed
  $ grep -c '<testcase' kit.xml
  22

So does the example, whose vehicle has no memory.

  $ dolphin platform check ../../examples/adapter.py --patience 10 | tail -1
  22 of 22 situations passed

Each situation finds an adapter out that is wrong there.

  $ find_out() {
  >   dolphin platform check --patience 4 --only "$1" --junit "$1.xml" \
  >     "python3 faulty.py '$2' 'dolphin sim kit.fleet --platform --state \"state of $2\" --speed 5'" > "$1.out"
  >   echo "$2: status $?"; sed -n 's/^FAIL  */  /p' "$1.out"; sed -n '2p' "$1.out" | sed 's/kit-[-0-9]*/REQUEST/'
  > }
  $ find_out greeting chatty
  chatty: status 1
    greeting         greets within 10 s, before all else
        its first line is not JSON: Line 1, bytes 0-14: Invalid token 'connecting ...'
  $ find_out greeting mute
  mute: status 1
    greeting         greets within 10 s, before all else
        its first line is not a greeting
  $ find_out vehicles typeless
  typeless: status 1
    vehicles         reports a vehicle that is ready, at first with type and link
        the first report of auv-001 lacks its type or its link
  $ find_out vehicles 'half a place'
  half a place: status 1
    vehicles         reports a vehicle that is ready, at first with type and link
        a line is not a valid 'vehicle': of latitude and longitude one is missing: {"kind": "vehicle", "vehicle": "auv-002", "type": "UUV", "payload": [], "latitude": 41.1851800869126, "height": 0.0, "depth": null, "altitude": null, ...
  $ find_out strange-orders fragile
  fragile: status 1
    strange-orders   ignores orders and members that it does not know
        the adapter ended where the pong was awaited
  $ find_out refused-line 'says all once'
  says all once: status 1
    refused-line     reports its vehicles again, with all members, when a line is refused
        a line was refused, and auv-001 is not reported again with type, position and link within 4 s
  $ find_out completion 'doubled ends'
  doubled ends: status 1
    completion       runs a plan to its end, and reports one end
        REQUEST has 2 ends: done, done
  $ find_out next busy
  busy: status 1
    next             runs the next plan at once
        plan short was to be 'done', and is 'failed (busy)'
  $ find_out pings deaf
  deaf: status 1
    pings            answers pings while a vehicle runs a plan
        pong 1 did not come within 5 s
  $ find_out start-twice 'starts again'
  starts again: status 1
    start-twice      takes a start that comes twice for one
        REQUEST was to be 'taken', and is 'failed (runs another plan)'
  $ find_out stop 'no stop'
  no stop: status 1
    stop             stops a plan, and reports one end, the same again when asked again
        the end of REQUEST did not come within 4 s
  $ find_out stop-stranger 'ignores strangers'
  ignores strangers: status 1
    stop-stranger    answers the stop of a request that it never heard of
        the end of REQUEST did not come within 4 s
  $ find_out stop-at-once 'stops too early'
  stops too early: status 1
    stop-at-once     stops a plan before reporting it as taken, and is free then
        the end of REQUEST did not come within 4 s
  $ find_out refusal 'refuses without words'
  refuses without words: status 1
    refusal          refuses what it cannot do, in words, and is free then
        a plan in an unknown language was to be refused, as 'failed', and is 'failed ( )'
  $ find_out validation 'yes-man'
  yes-man: status 1
    validation       reports the problems of a plan, and moves nothing
        a plan in an unknown language is found to have no problems
  $ find_out slow-reader 'loses lines'
  loses lines: status 1
    slow-reader      loses nothing while its output is not read
        of 5000 pings sent while its output was not read, 4995 were answered, or not in order
  $ find_out all-at-once 'one at a time'
  one at a time: status 1
    all-at-once      commands all of its vehicles at once, up to 100
        the end of REQUEST did not come within 4 s
  $ find_out killed forgetful
  forgetful: status 1
    killed           after its death reports the outcome of a plan that ran
        after its death the adapter reports a plan that the vehicle had taken as never started
  $ find_out killed-after-end 'forgets ends'
  forgets ends: status 1
    killed-after-end after its death does not rerun an ended plan
        a plan that was done before the adapter died is 'absent' after it
  $ find_out resume-twice wavering
  wavering: status 1
    resume-twice     answers a second 'resume' as the first
        a second 'resume' is answered by 'unknown (it depends)', and the first one was by 'taken'
  $ find_out never-ordered boaster
  boaster: status 1
    never-ordered    does not claim a request that was never ordered
        a request that was never ordered is 'done'
  $ find_out lost-notes 'trusts notes'
  trusts notes: status 1
    lost-notes       does not rerun a plan on which the journal has lost its notes
        plan short ran, the journal has lost the notes on it, and it is 'absent'
  $ find_out console-dies lingers
  lingers: status 1
    console-dies     lets vehicles fly on when its input ends, and ends
        its input has ended, and it has not, after 3 s
  $ find_out console-dies 'stops at the end of input'
  stops at the end of input: status 1
    console-dies     lets vehicles fly on when its input ends, and ends
        the console died, and a plan that ran is 'stopped': vehicles are to fly on
  $ find_out close 'never quiet'
  never quiet: status 1
    close            stops all vehicles, reports 'quiet', and ends
        the adapter ended where 'quiet' was awaited
  $ dolphin platform check --only stopp true
  dolphin: unknown situation 'stopp' (did you mean 'stop'?)
  [2]

Whoever interrupts it ends the adapter too: one that is deaf, and what that one has started.

  $ cat > deaf.sh <<'END'
  > trap '' TERM
  > sleep 1000 & echo $! > sleeper
  > echo $$ > deaf.new; mv deaf.new deaf
  > while :; do sleep 1; done
  > END
  $ dolphin platform check 'sh deaf.sh' > interrupted.txt & run=$!
  $ until test -e deaf || ! kill -0 $run; do sleep 0.05; done; kill -INT $run; wait $run
  [130]
  $ cat interrupted.txt
  interrupted; the adapter is ended
  $ runs() { grep -qs '^State:[[:space:]]*[^XZ[:space:]]' /proc/$(cat $1)/status; }  # those that only wait for init are over
  $ for f in deaf sleeper; do
  >   for i in $(seq 200); do runs $f || break; sleep 0.05; done; ! runs $f || echo "$f is still there"
  > done
