"""A run on a console whose server dies: resume.py start PORT, and on the next server resume.py resume PORT. Likewise
resume.py replace PORT, which gives the run another program, and resume.py onwards PORT."""

import json
import sys
import time
import urllib.request

URL = f"http://127.0.0.1:{sys.argv[2]}/api/"


def ask(path, body=None):
    data = None if body is None else json.dumps(body).encode()
    return json.load(urllib.request.urlopen(
        urllib.request.Request(URL + path, data, {"Content-Type": "application/json"}), timeout=10))


def until(holds):
    for _ in range(400):
        run = ask("status")["run"]
        if run and holds(run):
            return run
        time.sleep(0.05)
    raise SystemExit(f"it stays so: {run}")


def question():
    return until(lambda run: run["question"])["question"]


if sys.argv[1] == "start":
    ask("run", {"program": "mission.dol", "speed": 10, "people": True})
    print(question()["prompt"])
elif sys.argv[1] == "replace":
    ask("run", {"program": "mission.dol", "speed": 10, "people": True})
    ask("run/answer", {"question": question()["number"], "text": "3"})
    until(lambda run: not run["question"])
    ask("replacement", {"program": "longer.dol"})
    ask("run/replace", {"program": "longer.dol", "hash": ask("replacement")["hash"]})
    print(ask("status")["run"]["program"])
elif sys.argv[1] == "onwards":
    run = next(run for run in ask("runs")["runs"] if run["state"] == "broken off")
    ask("run/resume", {"run": run["run"], "people": True})
    ask("run/post", {"pairs": "go: 'south'"})
    print(until(lambda run: run["state"] == "over")["outcome"]["how"])
    # A replay knows the program that the run had last.
    told = urllib.request.urlopen(URL + "replay?run=" + run["run"], timeout=20).read().decode()
    print(*[word for word in ["says: the end"] if word in told])
else:
    run = next(run for run in ask("runs")["runs"] if run["state"] == "broken off")
    print(run["program"], run["state"])
    ask("run/resume", {"run": run["run"], "people": True})
    found = question()
    print(found["prompt"])
    ask("run/answer", {"question": found["number"], "text": "3"})
    ask("run/post", {"pairs": "go: 'south'"})
    print(until(lambda run: run["state"] == "over")["outcome"]["how"])
