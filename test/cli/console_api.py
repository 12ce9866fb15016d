"""Asks a console for all that docs/openapi.json describes, and judges each reply by it.

Usage: console_api.py OPENAPI PORT
"""

import json
import os
import sys
import time
import urllib.error
import urllib.request

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "conformance"))
import schema  # noqa: E402

OPENAPI, PORT = sys.argv[1], sys.argv[2]
DOCUMENT = schema.document(OPENAPI)
ASKED = set()
WRONG = []


def ask(verb, path, body=None, query=""):
    """The status and the reply, judged by the description of this operation."""
    operation = DOCUMENT["paths"]["/api/" + path][verb.lower()]
    ASKED.add((verb, "/api/" + path))
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(f"http://127.0.0.1:{PORT}/api/{path}{query}", data,
                                     {"Content-Type": "application/json"}, method=verb)
    try:
        with urllib.request.urlopen(request, timeout=60) as reply:
            status, kind = reply.status, reply.headers["Content-Type"]
            text = (reply.readline() if path == "events" else reply.read()).decode(errors="replace")
    except urllib.error.HTTPError as error:
        status, kind, text = error.code, error.headers["Content-Type"], error.read().decode()
    told = operation["responses"].get(str(status), operation["responses"]["default"])["content"]
    if kind not in told:
        WRONG.append(f"{verb} {path}: {kind} is not described")
        return status, text
    if kind != "application/json":
        return status, text
    found = json.loads(text)
    WRONG.extend(f"{verb} {path}: {why}" for why in schema.wrong(found, told[kind]["schema"], OPENAPI))
    if body is not None and status < 400:
        taken = operation["requestBody"]["content"]["application/json"]["schema"]
        WRONG.extend(f"{verb} {path}, what was sent: {why}" for why in schema.wrong(body, taken, OPENAPI))
    return status, found


def until(path, holds):
    for _ in range(2400):
        found = ask("GET", path)[1]
        if holds(found):
            return found
        time.sleep(0.05)
    raise SystemExit(f"{path} stays as it is: {found}")


def replacing():
    """Another program for the run of mission.dol, which waits for its input, with n = 3."""
    for path in ["wrong.dol", "none.dol", "others.dol"]:
        print(f"{path}:", ask("POST", "replacement", {"program": path})[1]["error"]["code"])
    found = ask("POST", "run/differences", {"program": "longer.dol"})[1]
    print("added:", found["after"].removeprefix(found["before"]).strip())
    found = {}
    for path in ["mission.dol", "longer.dol"]:
        ask("POST", "replacement", {"program": path, "seconds": 20})
        found = until("replacement", lambda found: found["state"] != "running")
        violated = [v["property"] for v in found["result"]["verdicts"] if v["verdict"] == "violated"]
        print("may follow:", path, found["outcome"], violated)
    print("another text:", ask("POST", "run/replace", {"program": "longer.dol", "hash": "0" * 32})[1]["error"]["code"])
    print("replaced:", ask("POST", "run/replace", {"program": "longer.dol", "hash": found["hash"]})[0],
          ask("GET", "status")[1]["run"]["program"])


def main():
    ask("GET", "operators")
    ask("POST", "operators", {"shut_out": "ana"})  # this console has no admin
    for path in ["status", "files", "runs", "exploration", "timing", "graph", "replacement"]:
        ask("GET", path)
    ask("DELETE", "replacement", {})
    for path in ["replacement", "run/differences"]:
        print("no run:", ask("POST", path, {"program": "mission.dol"})[1]["error"]["code"])
    ask("GET", "events", query="?client=api")
    text = ask("GET", "file", query="?path=mission.dol")[1]
    ask("PUT", "file", {"path": "mission.dol", "text": text["text"], "hash": text["hash"]})
    ask("PUT", "file", {"path": "mission.dol", "text": "", "hash": "old"})
    ask("GET", "file", query="?path=../mission.dol")
    ask("GET", "file")
    print("layers:", ask("GET", "files")[1]["layers"])
    print("shapes:", [s["name"] for s in ask("GET", "layer", query="?path=zones.kml")[1]["shapes"]])
    print("tiles:", ask("GET", "layer", query="?path=chart.mbtiles")[1]["tiles"])
    print("a tile:", ask("GET", "tile", query="?path=chart.mbtiles&zoom=1&column=0&row=0")[0],
          ask("GET", "tile", query="?path=chart.mbtiles&zoom=1&column=0&row=1")[0])
    for query in ["?path=mission.dol", "?path=none.kml", "?path=broken.mbtiles"]:
        ask("GET", "layer", query=query)
        ask("GET", "tile", query=query + "&zoom=1&column=0&row=0")
    ask("GET", "tile", query="?path=zones.kml&zoom=1&column=0&row=0")
    ask("GET", "tile", query="?path=chart.mbtiles&zoom=1&column=-1&row=0")
    document = {"path": "mission.dol", "text": text["text"]}
    for path in ["check", "format"]:
        ask("POST", path, document)
    ask("POST", "format", {"path": "mission.dol", "text": "(("})
    drawn = {"path": "mission.dol", "text": "a = polygon([location(1, 2), location(1, 3), location(2, 3)])\nb = a.centre ^ 9.m"}
    print("drawn:", [s["kind"] for s in ask("POST", "shapes", drawn)[1]["shapes"]])
    ask("POST", "shapes", {"path": "mission.dol", "text": "(("})
    point = {"type": "Feature", "properties": {"name": "buoy"}, "geometry": {"type": "Point", "coordinates": [-8, 41]}}
    contents = json.dumps(point).encode().hex()
    print("imported:", ask("PUT", "layer", {"path": "imported.geojson", "contents": contents})[1]["names"])
    ask("PUT", "layer", {"path": "imported.geojson", "contents": ""})
    for path in ["complete", "hover", "signature", "definition"]:
        ask("POST", path, {**document, "at": 5})
    ask("POST", "hover", {**document, "at": document["text"].index("message") + 1})
    ask("POST", "definition", {**document, "at": document["text"].rindex("x")})
    print("called:", ask("POST", "signature", {**document, "at": document["text"].index("message") + 8})[1]["form"])
    ask("GET", "world", query="?program=mission.dol")
    ask("GET", "world", query="?program=none.dol")
    ask("POST", "plans", {"program": "none.dol"})
    ask("POST", "plans", {"program": "wrong.dol"})
    found = ask("POST", "plans", {"program": "plans.dol", "set": {"n": "2"}})[1]
    print("known:", {v["vehicle"]: v["knows"] for v in found["vehicles"]})
    for plan in found["plans"]:
        way = plan["way"] and [m["maneuver"] + f" {len(m['points'])} {m['stays']}" for m in plan["way"]["maneuvers"]]
        print("plan:", plan["plan"], plan["vehicles"], way or "by name", plan["way"] and round(plan["way"]["seconds"]))
    print("a question:", ask("POST", "plans", {"program": "mission.dol", "fleet": "plans.fleet"})[1]["unfinished"])
    ask("DELETE", "exploration", {})
    ask("POST", "exploration", {"program": "mission.dol", "seconds": 20})
    ask("POST", "exploration", {"program": "wrong.dol"})
    found = until("exploration", lambda found: found["state"] != "running")
    verdicts = found["result"]["verdicts"]
    print("explored:", found["state"], [v["property"] for v in verdicts if v["verdict"] == "violated"])
    print("counterexample:", [step["label"] for step in found["counterexample"]["steps"]])
    ask("POST", "run/counterexample", {"of": "timing"})
    ask("POST", "run/counterexample", {"of": "graph"})
    ask("POST", "run/counterexample", {"of": "exploration", "speed": None})
    found = until("status", lambda found: found["run"]["state"] == "over")["run"]
    print("carried out:", found["counterexample"], found["journal"], found["outcome"]["how"])
    for path in ["timing", "graph"]:
        ask("DELETE", path, {})
        ask("POST", path, {"program": "wrong.dol"})
    ask("POST", "exploration", {"program": "mission.dol", "faults": "floods"})
    print("no such faults:", until("exploration", lambda found: found["state"] != "running")["state"])
    ask("POST", "timing", {"program": "short.dol", "deadline": "1.minute"})
    found = until("timing", lambda found: found["state"] != "running")
    print("timed:", found["result"]["verdict"], found["result"]["ends"], found["counterexample"]["property"])
    print("with dates:", [step["time"] for step in found["counterexample"]["steps"]])
    ask("POST", "graph", {"program": "mission.dol", "states": 0})
    ask("POST", "graph", {"program": "mission.dol", "states": 1})
    print("too large:", until("graph", lambda found: found["state"] != "running")["state"])
    before = ask("GET", "status")[1]["graph"]["number"]
    ask("POST", "graph", {"program": "mission.dol", "faults": "interrupt"})
    print("another number:", ask("GET", "status")[1]["graph"]["number"] > before)
    found = until("graph", lambda found: found["state"] != "running")["result"]
    print("graph:", found["states"], "states,", len(found["transitions"]), "transitions")
    ask("POST", "run", {"program": "wrong.dol"})
    ask("POST", "run", {"program": "mission.dol", "set": {"m": "3"}})
    ask("POST", "run", {"program": "mission.dol", "speed": 10, "seed": 1, "people": True, "set": {"n": "3"}})
    until("status", lambda found: found["run"]["question"])
    ask("POST", "run", {"program": "mission.dol"})
    ask("POST", "run/answer", {"question": 1, "text": "3 +"})
    until("status", lambda found: found["run"]["question"] and found["run"]["question"]["number"] == 2)
    ask("POST", "run/answer", {"question": 2, "text": "3"})
    ask("POST", "run/answer", {"question": 2, "text": "3"})
    replacing()
    ask("POST", "run/post", {"key": "none", "value": 1})
    ask("POST", "run/post", {"key": "go", "value": {"latitude": 41, "longitude": -8}})
    ask("POST", "run/post", {"pairs": "go: 'north'"})
    ask("POST", "helm", {"want": "take"})
    ask("POST", "helm", {"want": "give-up"})
    ask("POST", "run/stop", {"all": False})
    until("status", lambda found: found["run"]["state"] == "over")
    ask("POST", "run/resume", {"run": "none"})
    run = ask("GET", "runs")[1]["runs"][0]
    print("kept:", run["program"], run["state"])
    for note in [{"text": "here it waits", "time": 1.5}, {"text": "again", "time": 0}, {"text": " ", "time": 1}]:
        ask("POST", "notes", {"run": run["run"], **note})
    print("notes:", [(n["time"], n["text"], n["by"]) for n in ask("GET", "notes", query="?run=" + run["run"])[1]["notes"]])
    print("of no run:", ask("GET", "notes", query="?path=mission.dol")[1]["error"]["code"])
    told = ask("GET", "replay", query="?run=" + run["run"])[1]
    print("replayed to its end:", told.endswith("event: end\ndata: {}\n\n"))
    described = {(verb.upper(), path) for path, verbs in DOCUMENT["paths"].items() for verb in verbs}
    print("not asked for:", sorted(described - ASKED))
    print("\n".join(WRONG) or "all as described")


main()
