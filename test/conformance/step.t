The oracle answers lines of JSON with lines of JSON.

  $ cat > requests << 'END'
  > {"id": "a", "request": "hello"}
  > {"id": 2, "request": "initial", "program": "post a: 1\nn = ask 'n?'\nmessage n", "fleet": "vehicle 'v', { type 'UUV' }"}
  > END
  $ dolphin step < requests > replies
  $ head -n 1 replies
  {"id":"a","protocol":"dolphin-step","version":1,"implementation":"dolphin 0.1.0"}
  $ sed -n 2p replies | sed 's/"state":.*"world"/"state":...,"world"/'
  {"id":2,"configuration":{"control":"script","end":null,"A":{},"B":[],"N":[],"store":{},"state":...,"world":[{"vehicle":"v","type":"UUV","payload":[],"latitude":41.185,"longitude":-8.7062,"height":0,"battery":1,"connected":true,"speed":0,"cruise":1.5,"drain":0.1}]}

From a configuration on, all that may happen.

  $ cat > walk.py << 'END'
  > import json, subprocess, sys
  > p = subprocess.Popen(["dolphin", "step"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
  > def ask(request, **members):
  >     p.stdin.write(json.dumps({"request": request, **members}) + "\n")
  >     p.stdin.flush()
  >     return json.loads(p.stdout.readline())
  > def show(reply):
  >     for t in reply["transitions"]:
  >         t["next"].pop("state")
  >         print(json.dumps(t))
  >     print("awaited:", json.dumps(reply["awaited"]), "refused:", [r["code"] for r in reply.get("refused", [])])
  > here = ask("initial", program=open(sys.argv[1]).read(), fleet="vehicle 'v', { type 'UUV' }")["configuration"]
  > for line in sys.stdin:
  >     events = json.loads(line)
  >     show(ask("step", configuration=here, events=events))
  >     here = ask("step", configuration=here, events=events)["transitions"][-1]["next"]
  > END
  $ cat > program.dol << 'END'
  > post a: 1
  > n = ask 'n?'
  > message n
  > END
  $ python3 walk.py program.dol << 'END'
  > []
  > null
  > [{"event": "answer", "text": "1 +"}, {"event": "timer", "timer": 1}, {"event": "answer", "text": "2"}]
  > []
  > [{"event": "interruption"}]
  > END
  {"rule": ["POST"], "label": "post a:1", "at": "1:1", "N": {"posted": ["a:1"]}, "next": {"control": "script", "end": null, "A": {}, "B": [], "N": ["a:1"], "store": {}}}
  awaited: [{"event": "interruption"}] refused: []
  {"rule": ["ASK"], "label": "ask(n?)", "at": "2:5", "effects": [{"ask": "n?"}], "next": {"control": "wait", "end": null, "A": {}, "B": [], "N": ["a:1"], "store": {}}}
  awaited: [{"event": "interruption"}] refused: []
  {"event": {"event": "answer", "text": "2"}, "rule": ["ANSWER"], "label": "answer(2)", "at": "2:5", "next": {"control": "script", "end": null, "A": {}, "B": [], "N": ["a:1"], "store": {}}}
  awaited: [{"event": "answer", "prompt": "n?"}, {"event": "no-answer"}, {"event": "interruption"}] refused: ['bad-answer', 'not-awaited']
  {"rule": ["MESSAGE"], "label": "message '2'", "at": "3:1", "effects": [{"say": "2"}], "next": {"control": "script", "end": null, "A": {}, "B": [], "N": ["a:1"], "store": {"n": "2"}}}
  awaited: [{"event": "interruption"}] refused: []
  {"rule": ["END"], "label": "end", "at": "3:1", "effects": [{"end": {"ending": "completed"}}], "next": {"control": "end", "end": {"ending": "completed"}, "A": {}, "B": [], "N": ["a:1"], "store": {"n": "2"}}}
  {"event": {"event": "interruption"}, "rule": ["INTERRUPT"], "label": "interrupt", "at": "3:1", "effects": [{"end": {"ending": "interrupted"}}], "next": {"control": "end", "end": {"ending": "interrupted"}, "A": {}, "B": [], "N": ["a:1"], "store": {"n": "2"}}}
  awaited: [{"event": "interruption"}] refused: []

What is wrong with a program or a fleet has codes that do not change.

  $ cat > requests << 'END'
  > {"request": "initial", "program": "message x\npause 5.parsecs", "fleet": "vehicle 'v', { colour 'red'; type 'UUV' }"}
  > END
  $ dolphin step < requests
  {"rejected":[{"in":"program","code":"unknown-name","line":1,"column":9,"message":"unknown name 'x'"},{"in":"program","code":"unknown-unit","line":2,"column":9,"message":"unknown unit 'parsecs'","hint":"units are m, km, seconds, min, hours, days, degrees, knots, feet, percent and the like"},{"in":"fleet","code":"fleet","line":1,"column":16,"message":"a vehicle has no setting 'colour'","hint":"its settings are type, payload, at, speed, battery, drain, charge, charger, shows, joins, leaves, drops"}]}

What cannot be answered has an error, and the next request its reply. Empty lines are passed over.

  $ cat > requests << 'END'
  > {"request": "hello"
  > 
  > 5
  > {"request": "jump", "id": [1]}
  > {"request": "step", "configuration": {}}
  > {"request": "initial", "program": 5, "fleet": ""}
  > {"request": "initial", "program": "post a: 1", "fleet": ""}
  > {"request": "step", "configuration": {}}
  > {"request": "step", "configuration": {"state": [["script", [["evaluate", 999], 1, [], []]], [], [], [], []]}}
  > {"request": "step", "configuration": {"state": [["end", ["completed"]], [], [], [], []]}, "world": [{"vehicle": "v"}]}
  > {"request": "step", "configuration": {"state": [["end", ["completed"]], [], [], [], []]}, "events": [{"event": "rain"}]}
  > {"request": "step", "configuration": {"state": [["end", ["completed"]], [], [], [], []]}, "events": [{"event": "interruption"}]}
  > {"request": "step", "configuration": {"state": [["end", ["completed"]], [], [], ["v"], []]}}
  > END
  $ dolphin step < requests
  {"error":{"code":"no-json","message":"Line 1, bytes 18-19: Unexpected end of input"}}
  {"error":{"code":"bad-request","message":"a request is an object"}}
  {"id":[1],"error":{"code":"unknown-request","message":"unknown request \"jump\": the requests are hello, initial, step, times and dated"}}
  {"error":{"code":"no-program","message":"no program was given: initial comes first"}}
  {"error":{"code":"bad-request","message":"\"program\" is 5, not a text"}}
  {"configuration":{"control":"script","end":null,"A":{},"B":[],"N":[],"store":{},"state":[["script",[["evaluate",3],3,[],[]]],[],[],[],[]]},"world":[]}
  {"error":{"code":"bad-configuration","message":"\"state\" is missing"}}
  {"error":{"code":"bad-configuration","message":"999 is not the number of an expression of this program"}}
  {"error":{"code":"bad-world","message":"\"type\" is missing"}}
  {"error":{"code":"bad-event","message":"\"event\" is 'rain', not one of done, failed, timer, confirmation, no-confirmation, recruited, answer, no-answer, reply, no-reply, input, interruption"}}
  {"transitions":[],"awaited":[],"refused":[{"event":{"event":"interruption"},"code":"not-awaited"}]}
  {"error":{"code":"bad-configuration","message":"B is not empty after the end"}}

Questions about times have errors, too.

  $ cat > requests << 'END'
  > {"request": "times"}
  > {"request": "initial", "program": "execute idle(3)", "fleet": ""}
  > {"request": "times"}
  > {"request": "times", "faults": "rain"}
  > {"request": "times", "faults": 1}
  > {"request": "dated"}
  > {"request": "dated", "run": [{"event": {"event": "timer", "timer": 1}}]}
  > {"request": "dated", "run": [{"at": 3000, "event": {"event": "rain"}}]}
  > {"request": "dated", "run": [{"at": 3000, "event": {"event": "timer", "timer": 2}}]}
  > {"request": "dated", "run": [{"at": 3000, "event": {"event": "answer", "text": "1"}}]}
  > {"request": "dated", "run": [{"at": -1, "event": {"event": "timer", "timer": 1}}]}
  > {"request": "dated", "run": [{"at": 2000, "event": {"event": "timer", "timer": 1}}]}
  > {"request": "initial", "program": "while (true) { post a: 1 }", "fleet": ""}
  > {"request": "dated", "run": []}
  > END
  $ dolphin step < requests | cut -c 1-160
  {"error":{"code":"no-program","message":"no program was given: initial comes first"}}
  {"configuration":{"control":"script","end":null,"A":{},"B":[],"N":[],"store":{},"state":[["script",[["evaluate",4],4,[],[]]],[],[],[],[]]},"world":[]}
  {"ends":{"completed":[3000,3000]},"tasks":[],"endless":false,"missed":[]}
  {"error":{"code":"bad-faults","message":"unknown fault 'rain': did you mean fail?"}}
  {"error":{"code":"bad-faults","message":"\"faults\" is 1, not a text"}}
  {"error":{"code":"bad-request","message":"\"run\" is missing"}}
  {"error":{"code":"bad-event","message":"\"at\" is missing"}}
  {"error":{"code":"bad-event","message":"\"event\" is 'rain', not one of done, failed, timer, confirmation, no-confirmation, recruited, answer, no-answer, reply,
  {"error":{"code":"bad-run","message":"the end of timer 2 at 3000 is not awaited"}}
  {"error":{"code":"bad-run","message":"the answer 1 at 3000 is not awaited"}}
  {"error":{"code":"bad-run","message":"its dates go back"}}
  {"findings":[{"at":2000,"timer":1,"too":"early"}]}
  {"configuration":{"control":"script","end":null,"A":{},"B":[],"N":[],"store":{},"state":[["script",[["evaluate",5],5,[],[]]],[],[],[],[]]},"world":[]}
  {"error":{"code":"bad-run","message":"it never comes to a wait"}}

It ends when its input does.

  $ dolphin step < /dev/null
