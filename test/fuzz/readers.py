"""The readers of Dolphin. Each reader is a function of a `Bench`, a random number generator and
an empty folder: it writes a mutated input there, has it read, and returns the fault of the output, or None."""

import functools
import json
import os
import socket
import subprocess
import time

import mutate
from verdict import Running, bad_output, judge

PATIENCE = 2  # seconds until a run, which may be endless by right, is interrupted
INPUTS = b"""input 'n', 'over'
v = pick { type 'UUV' }
execute until { poll over: true } run task('survey')[v] | repeat condition { consume n: _ }
"""
INPUTS_FLEET = b"vehicle 'lauv-1', { type 'UUV' }\nplan 'survey', { duration 10.hours }\n"
REQUESTS = b"""{"request": "status", "id": 1}
{"request": "post", "key": "n", "value": {"latitude": 41.18, "longitude": -8.7}, "id": "a"}
{"request": "post", "key": "n", "value": [1, 1.5, "text", {"vehicles": ["lauv-1"]}, true]}
{"request": "replace", "program": "/nowhere/a.dol", "hash": "0", "set": {"n": "1"}, "id": 2}
{"request": "follow"}
{"request": "post", "key": "over", "value": true}
{"request": "stop"}
"""
ADAPTED = b"v = pick { type 'UGV'; timeout 1.seconds }\nexecute task('short')[v]\n"
REPORTS = b"""{"kind": "hello", "protocol": 1, "name": "fuzz", "version": "0.1", "plans": ["name"], "announce": 1, "patience": 1}
{"kind": "vehicle", "vehicle": "r1", "type": "UGV", "payload": ["camera"], "latitude": 41.185, "longitude": -8.706, "height": 120, "altitude": 64, "battery": 0.83, "speed": 18.2, "readings": {"Temperature": 14.2}, "link": true, "unready": null}
{"kind": "vehicle", "vehicle": "r1", "latitude": 41.186, "longitude": -8.706, "battery": 0.82}
{"kind": "vehicle", "vehicle": "r1", "unready": "is flown by its pilot"}
{"kind": "note", "text": "calibrating"}
{"kind": "pong", "id": 7}
{"kind": "gone", "vehicle": "r1"}
{"kind": "error", "why": "no such port"}
"""
SUPPLIED = b"""s = getSupplier()
message s.first()
message s.second(1, 'a')
pick { count 1 }
execute s.third()
message s.fourth()
"""
REPLIES = b"""{"id": 1, "value": {"object": "queue"}}
{"id": 2, "value": {"latitude": 41.18, "longitude": -8.7}}
{"id": 3, "value": [1, 1.5, "text", {"a": {"vehicles": ["lauv-1"]}}]}
{"id": 4, "value": {"task": "survey"}}
{"id": 5, "error": "the queue is closed"}
"""
KML = b"""<?xml version="1.0" encoding="UTF-8"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>
<Placemark><name>pier</name><Point><coordinates>-8.7,41.18,3</coordinates></Point></Placemark>
<Placemark><name>way</name><LineString><coordinates>
-8.7,41.18 -8.71,41.19,2 -8.72,41.2</coordinates></LineString></Placemark>
<Placemark><name>basin</name><MultiGeometry><Polygon><outerBoundaryIs><LinearRing><coordinates>-8.7,41.1 -8.6,41.1
-8.6,41.2 -8.7,41.1</coordinates></LinearRing></outerBoundaryIs></Polygon></MultiGeometry></Placemark>
<NetworkLink><name>more</name><Link><href>more.kml</href></Link></NetworkLink></Document></kml>"""
GPX = b"""<?xml version="1.0"?><gpx version="1.1" creator="x"><wpt lat="41.18" lon="-8.7"><ele>4</ele><name>buoy</name></wpt>
<rte><name>way</name><rtept lat="41.18" lon="-8.7"/><rtept lat="41.19" lon="-8.71"/></rte>
<trk><name>track</name><trkseg><trkpt lat="41.1" lon="-8.7"/><trkpt lat="41.2" lon="-8.6"/></trkseg></trk></gpx>"""
NMAP = b"""<map><features><mark><id>pier</id><coordinate><latitude>41N30'0''</latitude><longitude>8W15'0''</longitude>
<depth>2</depth></coordinate></mark><parallelepiped><id>box</id><coordinate><latitude>41N10'0''</latitude>
<longitude>8W42'0''</longitude></coordinate><width>100</width><length>50</length><height>2</height></parallelepiped>
</features></map>"""
PLAN = json.dumps({
    "fileType": "Plan", "version": 1,
    "geoFence": {"circles": [{"circle": {"center": [41.18, -8.7], "radius": 200}, "inclusion": True}],
                 "polygons": [{"inclusion": False, "polygon": [[41.1, -8.7], [41.2, -8.7], [41.2, -8.6]]}]},
    "mission": {"plannedHomePosition": [41.18, -8.7, 10], "items": [
        {"type": "SimpleItem", "command": command, "frame": 3, "doJumpId": i + 1,
         "params": [0, 0, 0, None, 41.18 + i / 1000, -8.7, 30]} for i, command in enumerate([22, 16, 16, 201, 177, 21])] + [
        {"type": "ComplexItem", "complexItemType": "survey", "polygon": [[41.1, -8.7], [41.11, -8.7], [41.11, -8.69]],
         "TransectStyleComplexItem": {"VisualTransectPoints": [[41.1, -8.7], [41.11, -8.7]]}}]},
    "rallyPoints": {"points": [[41.18, -8.7, 20]]}}).encode()


class Bench:
    """A command `dolphin`, the time that it has for each input, and the valid inputs that are mutated."""

    def __init__(self, dolphin, root, seconds, folder, mavlink=None):
        self.dolphin, self.seconds, self.folder, self.mavlink = dolphin, seconds, folder, mavlink
        self.case_texts = [path.read_bytes() for path in sorted(root.glob("conformance/cases/*/*.json"))]
        cases = [json.loads(text) for text in self.case_texts]
        self.examples = sorted(root.glob("examples/*.dol"))
        self.programs = [(path.read_bytes(), path.with_suffix(".fleet").read_bytes()) for path in self.examples]
        self.programs += [("\n".join(case["program"]).encode(), "\n".join(case.get("fleet", [])).encode())
                          for case in cases if isinstance(case.get("program"), list)]
        self.program_texts = [program for program, _ in self.programs]
        self.fleet_texts = [fleet for _, fleet in self.programs]
        harbour = (root / "examples/maps/harbour.geojson").read_bytes()
        self.maps = {"geojson": harbour, "kml": KML, "gpx": GPX, "plan": PLAN, "nmap": NMAP}
        self.definition = (root / "test/imc/data/sample.xml").read_bytes()

    @functools.cached_property
    def journals(self):
        """Programs, each with the journal of one of its runs."""
        return [journal for journal in map(self.journal, self.examples[::4]) if journal]

    @functools.cached_property
    def questions(self):
        """Valid requests of `dolphin step`: pairs of a first and a later one."""
        return [pair for program in self.programs[::6] for pair in self.ask(*program)]

    def journal(self, program):
        """A program and the journal of one of its runs; None if it has none."""
        path = self.folder / "valid.run"
        path.unlink(missing_ok=True)
        subprocess.run([self.dolphin, "exec", program.absolute(), "-q", "--journal", path], stdin=subprocess.DEVNULL,
                       capture_output=True, timeout=60)
        return (program.read_bytes(), path.read_bytes()) if path.exists() else None

    def ask(self, program, fleet):
        begin = {"request": "initial", "program": program.decode(), "fleet": fleet.decode()}
        answered = subprocess.run([self.dolphin, "step"], input=json.dumps(begin).encode() + b"\n", capture_output=True,
                                  timeout=60).stdout
        initial = json.loads(answered.splitlines()[0]) if answered.startswith(b'{"configuration"') else None
        return [(begin, {"request": "step", "configuration": initial["configuration"]})] if initial else []

    def run(self, arguments, folder, form="text", stdin=b"", interrupt_after=None):
        """The fault with which `dolphin` reads it, or None; the folder keeps the command, to be repeated by hand."""
        (folder / "command").write_bytes(os.fsencode(" ".join(["dolphin", *arguments]) + "\n"))
        if stdin:
            (folder / "stdin").write_bytes(stdin)
        ended = Running([self.dolphin, *arguments], folder, self.seconds, stdin).end(interrupt_after)
        (folder / "stdout").write_bytes(ended.out)
        (folder / "stderr").write_bytes(ended.err)
        return judge(ended, form)


def write(folder, **files):
    for name, text in files.items():
        (folder / name.replace("_", ".")).write_bytes(text)


def source_commands(random):
    return random.choice([
        (["check", "m.dol"], "text"), (["parse", "m.dol"], "source"), (["help", "m.dol"], "text"),
        (["plan", "m.dol", "--json"], "json"),
        (["explore", "m.dol", "--workers", "1", "--max-states", "300", "--timeout", "4", "--json"], "json"),
        (["time", "m.dol", "--workers", "1", "--max-states", "300", "--timeout", "4", "--json"], "json"),
        (["lts", "m.dol", "--workers", "1", "--max-states", "300", "--timeout", "4", "--format", "json"], "json"),
        (["tla", "m.dol", "-o", "model"], "text"), (["walk", "m.dol"], "text"),
        (["exec", "m.dol", "--no-socket", "--journal", "m.run"], "text")])


def read_source(bench, random, folder):
    arguments, form = source_commands(random)
    endless = arguments[0] in ("exec", "plan", "explore", "time", "lts", "tla", "walk")
    why = bench.run(arguments, folder, form, interrupt_after=PATIENCE if endless else None)
    journal = folder / "m.run"
    return why or (journal.exists() and bad_output("journal", "lines", journal.read_bytes())) or None


def programs(bench, random, folder):
    program, fleet = random.choice(bench.programs)
    write(folder, m_dol=mutate.text(random, program, bench.program_texts), m_fleet=fleet)
    return read_source(bench, random, folder)


def fleets(bench, random, folder):
    program, fleet = random.choice(bench.programs)
    write(folder, m_dol=program, m_fleet=mutate.text(random, fleet or b"\n", bench.fleet_texts))
    return read_source(bench, random, folder)


def formatting(bench, random, folder):
    program, fleet = random.choice(bench.programs)
    write(folder, m_dol=mutate.text(random, program, bench.program_texts),
          m_fleet=mutate.text(random, fleet or b"\n", bench.fleet_texts))
    return bench.run(["fmt", random.choice(["m.dol", "m.fleet"])], folder, "source")


def journals(bench, random, folder):
    program, journal = random.choice(bench.journals)
    write(folder, m_dol=program, m_run=mutate.json_text(random, journal, [journal]))
    form = random.choice(["csv", "geojson", "kml", "gpx"])
    arguments, form = random.choice([
        (["trace", "show", "m.run"], "text"), (["trace", "show", "--transitions", "m.run"], "text"),
        (["trace", "check", "m.dol", "m.run"], "text"), (["trace", "draw", "m.run", "-o", "m.svg"], "text"),
        (["trace", "export", "m.run", "--to", form],
         {"geojson": "json", "kml": "xml", "gpx": "xml", "csv": "source"}[form]),
        (["exec", "m.dol", "--resume", "m.run", "--no-socket"], "text")])
    endless = arguments[0] == "exec"
    why = bench.run(arguments, folder, form, interrupt_after=PATIENCE if endless else None)
    picture = folder / "m.svg"
    return why or (picture.exists() and bad_output("picture", "xml", picture.read_bytes())) or None


def maps(bench, random, folder):
    ending = random.choice([*bench.maps, "kmz", "nmisz"])
    others = list(bench.maps.values())
    if ending == "kmz":
        content = mutate.archive(random, [("doc.kml", KML), ("more.kml", KML)], others)
    elif ending == "nmisz":
        content = mutate.archive(random, [("mission.nmis", b"<mission-def/>"), ("maps/a.nmap", NMAP)], others)
    else:
        mutation = mutate.json_text if ending in ("geojson", "plan") else mutate.text
        content = mutation(random, bench.maps[ending], others)
    (folder / f"a.{ending}").write_bytes(content)
    write(folder, m_dol=b"m = map 'a.%b'\nmessage m.keys()\nmessage m\n" % ending.encode())
    return bench.run(random.choice([["exec", "m.dol"], ["check", "m.dol"]]), folder, interrupt_after=PATIENCE)


def definitions(bench, random, folder):
    write(folder, IMC_xml=mutate.text(random, bench.definition, [bench.definition]), m_dol=b"""p = imcPlan {
  planName 'p'
  speed 1.5, Speed.Units.METERS_PS
  z 2, Z.Units.DEPTH
  locate location(41.18, -8.7)
  goTo()
}
execute p[pick { type 'UUV' }]
""")
    return bench.run(["plan", "m.dol", "p", "--imc-xml", "IMC.xml"], folder, "json")


def steps(bench, random, folder):
    lines = [json.dumps(random.choice(random.choice(bench.questions))).encode() for _ in range(4)]
    begin, step = random.choice(bench.questions)
    lines += [mutate.json_text(random, json.dumps(begin).encode(), lines), json.dumps(begin).encode()]
    lines += [mutate.json_text(random, json.dumps(step).encode(), lines) for _ in range(4)]
    return bench.run(["step"], folder, "lines", b"\n".join(lines) + b"\n")


def asked_on_socket(bench, folder, requests):
    """Runs a program in `folder`, with the journal `m.run`, and sends `requests` to its socket; the fault of the replies
    and of the output of the run, or None."""
    write(folder, m_dol=INPUTS, m_fleet=INPUTS_FLEET, requests=requests)
    command = ["exec", "m.dol", "--speed", "1", "--journal", "m.run"]
    (folder / "command").write_text(" ".join(["dolphin", *command, "< requests on its socket"]) + "\n")
    running = Running([bench.dolphin, *command], folder, bench.seconds)
    replies = b""
    until = time.monotonic() + bench.seconds
    while not (folder / "m.run.sock").exists() and running.process.poll() is None and time.monotonic() < until:
        time.sleep(0.01)
    try:
        with socket.socket(socket.AF_UNIX) as client:
            client.settimeout(1)
            client.connect(str(folder / "m.run.sock"))
            client.sendall(requests)
            client.shutdown(socket.SHUT_WR)
            while data := client.recv(65536):
                replies += data
    except OSError:
        pass  # the run ended, or goes on with nothing to write
    ended = running.end(interrupt_after=0.1)
    write(folder, replies=replies, stdout=ended.out, stderr=ended.err)
    whole = replies[:replies.rfind(b"\n") + 1]
    return judge(ended, "text") or bad_output("replies", "lines", whole)


def sockets(bench, random, folder):
    return (asked_on_socket(bench, folder, mutate.json_text(random, REQUESTS, [REQUESTS])) or
            bad_output("journal", "lines", (folder / "m.run").read_bytes()))


def adapters(bench, random, folder):
    hello, rest = REPORTS.split(b"\n", 1)
    lines = mutate.json_text(random, REPORTS, [REPORTS])
    if random.random() < 0.7:
        lines = hello + b"\n" + mutate.json_text(random, rest, [REPORTS])
    write(folder, m_dol=ADAPTED, reports=lines)
    why = bench.run(["exec", "m.dol", "--platform", "cat reports; sleep 1", "--journal", "m.run", "--no-socket"], folder,
                    interrupt_after=PATIENCE)
    journal = folder / "m.run"
    return why or (journal.exists() and bad_output("journal", "lines", journal.read_bytes())) or None


def suppliers(bench, random, folder):
    write(folder, m_dol=SUPPLIED, replies=mutate.json_text(random, REPLIES, [REPLIES]))
    why = bench.run(["exec", "m.dol", "--supplier", "cat replies; sleep 1", "--journal", "m.run"], folder,
                    interrupt_after=PATIENCE)
    journal = folder / "m.run"
    return why or (journal.exists() and bad_output("journal", "lines", journal.read_bytes())) or None


def frame(body):
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


def editors(bench, random, folder):
    program, _ = random.choice(bench.programs)
    text = mutate.text(random, program, bench.program_texts).decode(errors="replace")
    document = {"uri": "file:///m.dol"}
    asked = []
    for i, name in enumerate(["hover", "completion", "definition", "references", "documentSymbol", "formatting"]):
        place = {"line": random.randrange(20), "character": random.randrange(40)}
        params = {"textDocument": document, "position": place, "context": {"includeDeclaration": True},
                  "options": {"tabSize": 4, "insertSpaces": True}}
        asked.append({"jsonrpc": "2.0", "id": i + 2, "method": "textDocument/" + name, "params": params})
    opened = {"textDocument": {**document, "languageId": "dolphin", "version": 1, "text": text}}
    messages = [{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}},
                {"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": opened}, *asked]
    bodies = [json.dumps(message).encode() for message in messages]
    i = random.randrange(len(bodies))
    bodies[i] = random.choice([bodies[i], mutate.json_text(random, bodies[i], bodies)])
    bodies += [b'{"jsonrpc": "2.0", "id": 99, "method": "shutdown"}', b'{"jsonrpc": "2.0", "method": "exit"}']
    stream = b"".join(map(frame, bodies))
    if random.random() < 0.1:
        stream = mutate.text(random, stream, bodies)
    return bench.run(["lsp"], folder, "frames", stream)


READERS = {reader.__name__: reader for reader in (
    programs, fleets, formatting, journals, maps, definitions, steps, sockets, adapters, suppliers, editors)}
