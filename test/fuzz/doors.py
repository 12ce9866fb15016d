"""Each door of Dolphin with hostile texts and numbers at the places where texts and numbers stand: the input is
valid otherwise, so that it reaches outputs. Each reader is as those of readers.py."""

import contextlib
import json
import os
import re
import sqlite3
import subprocess
import time
import zipfile

import consoles
import hostile
import searches
from readers import (ADAPTED, GPX, INPUTS, INPUTS_FLEET, KML, NMAP, PATIENCE, REPLIES, REPORTS, REQUESTS, SUPPLIED,
                     asked_on_socket, frame, write)
from verdict import bad_output

PROGRAM = b"""input 'go', 'key'
note = ask 'how far?'
message "note ${note} of ${note}"
v = pick { type 'UUV'; payload 'Sidescan'; timeout 1.second }
message "${v} ${v.id} ${position(v)} ${['a': 'b', 'c': [1.5, 'd']]}"
p = imcPlan {
  planName 'described'
  speed 1.5, Speed.Units.METERS_PS
  z 2, Z.Units.DEPTH
  locate location(41.185, -8.706)
  goTo()
}
post 'key': 'value', 'other': 3.5
execute until { poll 'go': 'now' } run (task('survey')[v] >> p[v] >> action { message 'acted' })
execute watch task('broken')[v] onError { e -> message "error ${e}" }
if (note == 'text') halt 'because'
"""
FLEET = b"""vehicle 'lauv-1', { type 'UUV'; payload 'Sidescan', 'Camera'; at 41.18, -8.7; battery 80.percent }
vehicle 'lauv-2', { type 'UUV'; payload 'Sidescan'; at 41.181, -8.71 }
plan 'survey', { duration 3.minutes }
answer 'how far?', 'text'
input 'go', 'now', after 5.minutes
plan 'broken', { duration 3.minutes; fails }
fence depth 30.m
"""
STEERED = b"v = pick { type 'UGV'; timeout 1.second }\nmessage v\nexecute task('name')[v]\n"
RUN_REPORTS = REPORTS + b"""{"kind": "taken", "request": "x"}
{"kind": "failed", "request": "x", "why": "engine"}
{"kind": "log", "vehicle": "r1", "text": "engine on"}
{"kind": "vehicle", "vehicle": "r1", "type": "UGV", "readings": {"Depth": 3.5}, "unready": "is charging"}
"""
# Reports of an adapter which takes each plan, and then says the lines that follow: they are of its request.
ANSWERING = """import json, sys
hello, *rest = open(sys.argv[1], "rb").read().split(b"\\n")
out = sys.stdout.buffer
out.write(hello + b"\\n"), out.write(b'{"kind": "vehicle", "vehicle": "r1", "type": "UGV", "latitude": 41, "longitude": -8, '
                                    b'"link": true}\\n'), out.flush()
for line in sys.stdin:
    order = json.loads(line)
    if order["kind"] == "start":
        out.write(b"\\n".join(rest).replace(b"REQUEST", order["request"].encode())), out.flush()
    elif order["kind"] == "check":
        out.write(b'{"kind": "checked", "id": %d, "problems": []}\\n' % order["id"]), out.flush()
    elif order["kind"] == "ping":
        out.write(b'{"kind": "pong", "id": %d}\\n' % order["id"]), out.flush()
    elif order["kind"] == "close":
        break
"""
LATER = b"""{"kind": "taken", "request": "REQUEST"}
{"kind": "progress", "request": "REQUEST", "share": 0.5, "remaining": 30}
{"kind": "note", "request": "REQUEST", "note": {"mission": "abc", "items": [1, 2.5]}, "id": 1}
{"kind": "log", "vehicle": "r1", "text": "engine on"}
{"kind": "vehicle", "vehicle": "r1", "readings": {"Depth": 3.5}, "battery": 0.5, "unready": "is charging"}
{"kind": "failed", "request": "REQUEST", "why": "engine failed"}
"""
HELLO = b'{"kind": "hello", "protocol": 1, "name": "rover", "version": "0.1", "plans": ["name"], "announce": 1, "patience": 1}'
EXPORTS = {"geojson": "json", "kml": "xml", "gpx": "xml", "csv": "source"}


def journal_read(bench, random, folder, program):
    """The fault of a journal `m.run`, if the folder has it, or of the output of commands that read it; or None."""
    journal = folder / "m.run"
    if not journal.exists():
        return None
    why = bad_output("journal", "lines", journal.read_bytes())
    form = random.choice(list(EXPORTS))
    readings = [(["trace", "show", "m.run"], "text"), (["trace", "show", "--transitions", "m.run"], "text"),
                (["trace", "check", program, "m.run"], "text"), (["trace", "draw", "m.run", "-o", "-"], "xml"),
                (["trace", "export", "m.run", "--to", form], EXPORTS[form])]
    for arguments, form in random.sample(readings, 2):
        why = why or bench.run(arguments, folder, form)
    return why


def outputs(folder):
    """The fault of the files that commands have written there; or None."""
    forms = {"junit.xml": "xml", "sarif.json": "json", "m.svg": "xml", "trace.itf.json": "json", "trace.run": "lines"}
    for name, form in forms.items():
        if (folder / name).exists() and (why := bad_output(name, form, (folder / name).read_bytes())):
            return why
    return None


LIMITS = ["--workers", "1", "--max-states", "200", "--timeout", "4"]


def run_program(bench, random, folder, name="m.dol"):
    """A command that reads a program, and its outputs."""
    arguments, form = random.choice([
        (["check", name], "text"), (["parse", name], "text"), (["help", name], "text"), (["fmt", name], "source"),
        (["plan", name, "--json"], "json"), (["plan", name], "text"), (["walk", name], "text"),
        (["explore", name, *LIMITS, "--json", "--strict", "--junit", "junit.xml", "--sarif", "sarif.json", "--trace",
          random.choice(["trace.run", "trace.itf.json"]), "--draw", "m.svg"], "json"),
        (["explore", name, *LIMITS, "--strict", "--faults", "all"], "text"),
        (["time", name, *LIMITS, "--json"], "json"), (["time", name, *LIMITS], "text"),
        (["lts", name, *LIMITS, "--format", "json"], "json"), (["lts", name, *LIMITS, "--format", "dot"], "text"),
        (["lts", name, *LIMITS, "--format", "aut"], "text"), (["tla", name, "-o", "model"], "text"),
        (["exec", name, "--runs", "3"], "text"), (["exec", name, "--runs", "3", "--json"], "json"),
        *[(["exec", name, "--no-socket", "--journal", "m.run", "-vv"], "text")] * 4])
    endless = arguments[0] in ("exec", "plan", "explore", "time", "lts", "tla", "walk")
    why = bench.run(arguments, folder, form, interrupt_after=PATIENCE if endless else None)
    return why or outputs(folder) or journal_read(bench, random, folder, name)


def door_program(bench, random, folder):
    write(folder, m_dol=hostile.in_program(random, PROGRAM), m_fleet=FLEET)
    return run_program(bench, random, folder)


def door_fleet(bench, random, folder):
    write(folder, m_dol=PROGRAM, m_fleet=hostile.in_program(random, FLEET))
    return run_program(bench, random, folder)


def door_examples(bench, random, folder):
    program, fleet = random.choice(bench.programs)
    write(folder, m_dol=hostile.in_program(random, program), m_fleet=hostile.in_program(random, fleet or b"\n"))
    return run_program(bench, random, folder)


def door_file_names(bench, random, folder):
    """A program, its fleet and its included files, with hostile names."""
    name = hostile.file_name(random, b".dol")
    for path, content in [(name, PROGRAM), (name[:-4] + b".fleet", FLEET)]:
        with open(os.path.join(os.fsencode(folder), path), "wb") as file:
            file.write(content)
    return run_program(bench, random, folder, os.fsdecode(b"./" + name))


def door_map(bench, random, folder):
    ending = random.choice([*bench.maps, "kmz", "nmisz", "json"])
    original = {"kmz": KML, "nmisz": NMAP, "json": bench.maps["geojson"], "gpx": GPX}.get(ending) or bench.maps[ending]
    is_json = ending in ("geojson", "json", "plan")
    content = (hostile.in_json if is_json else hostile.in_xml)(random, original)
    path = folder / f"a.{ending}"
    if ending in ("kmz", "nmisz"):
        name = random.choice(["doc.kml", "a\x1b[2J.kml", "\u202e.kml"]) if ending == "kmz" else "maps/a.nmap"
        with zipfile.ZipFile(path, "w") as packed:
            packed.writestr(name, content)
    else:
        path.write_bytes(content)
    write(folder, m_fleet=FLEET, m_dol=b"m = map 'a.%b'\nmessage m.keys()\nmessage m\npost map: m\nv = pick { type 'UUV' }\n"
          b"execute task('survey')[v]\n" % ending.encode())
    if random.random() < 0.3:
        arguments = ["trace", "draw", "m.run", "--layer", path.name, "-o", "-"]
        (folder / "m.run").write_bytes(random.choice(bench.journals)[1])
        return bench.run(arguments, folder, "xml")
    return run_program(bench, random, folder)


def door_tiles(bench, random, folder):
    """A map as tiles whose metadata are hostile, in a console."""
    consoles.lay_out(bench, random, folder)
    path = folder / "a.mbtiles"
    database = sqlite3.connect(path)
    database.execute("CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)")
    database.execute("INSERT INTO tiles VALUES (1, 0, 1, ?)", (consoles.PNG,))
    database.execute("CREATE TABLE metadata (name text, value text)")
    known = {"name": b"chart", "minzoom": b"0", "maxzoom": b"3", "bounds": b"-9,41,-8.5,42", "attribution": b"us",
             "format": b"png"}
    for name, value in known.items():
        kind = random.random()
        value = hostile.number(random) if kind < 0.2 else hostile.text(random) if kind < 0.5 else value
        database.execute("INSERT INTO metadata VALUES (?, CAST(? AS TEXT))", (name, value))
    database.commit()
    database.close()
    return consoles.judged(bench, folder, [
        consoles.packed("GET", "layer", {"path": "a.mbtiles"}, None), consoles.packed("GET", "files", {}, None),
        consoles.packed("GET", "tile", {"path": "a.mbtiles", "zoom": "1", "column": "0", "row": "1"}, None)])


def door_journal(bench, random, folder):
    program, journal = random.choice(bench.journals)
    write(folder, m_dol=program, m_run=hostile.in_json(random, journal))
    form = random.choice(list(EXPORTS))
    arguments, form = random.choice([
        (["trace", "show", "m.run"], "text"), (["trace", "show", "--transitions", "m.run"], "text"),
        (["trace", "check", "m.dol", "m.run"], "text"), (["trace", "draw", "m.run", "-o", "-"], "xml"),
        (["trace", "export", "m.run", "--to", form], EXPORTS[form]),
        (["trace", "export", "m.run", "--to", "mcap", "-o", "m.mcap"], "text"), (["explore", "m.dol", "--from", "m.run"], "text"),
        (["exec", "m.dol", "--resume", "m.run", "--no-socket"], "text")])
    endless = arguments[0] in ("exec", "explore")
    why = bench.run(arguments, folder, form, interrupt_after=PATIENCE if endless else None)
    return why or (arguments[0] == "exec" and journal_after_resume(folder)) or None


def journal_after_resume(folder):
    """The lines that resuming has added: those that were there may be wrong already."""
    data = (folder / "m.run").read_bytes()
    added = data.split(b'"resumed"')
    return bad_output("journal", "lines", added[-1].partition(b"\n")[2]) if len(added) > 1 else None


def door_step(bench, random, folder):
    lines = []
    for _ in range(3):
        begin, step = random.choice(bench.questions)
        if random.random() < 0.3:
            source = hostile.in_program(random, begin["program"].encode()).decode(errors="surrogateescape")
            lines.append(json.dumps({**begin, "program": source}, ensure_ascii=random.random() < 0.5)
                         .encode(errors="surrogateescape"))
        lines += [hostile.in_json(random, json.dumps(begin).encode()), json.dumps(begin).encode(),
                  hostile.in_json(random, json.dumps(step).encode())]
    return bench.run(["step"], folder, "lines", b"\n".join(lines) + b"\n")


def door_socket(bench, random, folder):
    requests = b"".join(hostile.in_json(random, REQUESTS) for _ in range(2))
    return asked_on_socket(bench, folder, requests) or journal_read(bench, random, folder, "m.dol")


def door_console(bench, random, folder):
    """Requests over HTTP with hostile queries, bodies and headers."""
    consoles.lay_out(bench, random, folder)
    consoles.tiles(random, folder / "a.mbtiles")
    if random.random() < 0.3:
        path = os.path.join(os.fsencode(folder), hostile.file_name(random, b".dol"))
        with open(path, "wb") as file:
            file.write(PROGRAM)
    requests = []
    for verb, path, query, body in random.sample(consoles.requests_of("m.dol"), 10):
        data = None if body is None else json.dumps(body).encode()
        if query and (data is None or random.random() < 0.5):
            request = consoles.packed(verb, path, query, data)
            key = random.choice(list(query)).encode() + b"="
            before, _, after = request.partition(key)
            request = before + key + hostile.in_query(random).encode() + after[after.index(b" "):]
        elif data is not None:
            request = consoles.packed(verb, path, query, hostile.in_json(random, data))
        else:
            request = consoles.packed(verb, path, query, data).replace(
                b"X-Dolphin-Client: fuzz", b"X-Dolphin-Client: " + hostile.text(random))
        requests.append(request)
    return consoles.judged(bench, folder, requests)


def door_editor(bench, random, folder):
    text = hostile.in_program(random, random.choice([PROGRAM, FLEET])).decode(errors="replace")
    document = {"uri": random.choice(["file:///m.dol", "file:///m.fleet"])}
    params = {"textDocument": document, "position": {"line": random.randrange(12), "character": random.randrange(40)},
              "context": {"includeDeclaration": True}, "options": {"tabSize": 4, "insertSpaces": True}, "query": "v",
              "newName": "w"}
    names = ["hover", "completion", "definition", "references", "documentSymbol", "formatting", "rename", "signatureHelp"]
    asked = [{"jsonrpc": "2.0", "id": i + 2, "method": "textDocument/" + name, "params": params}
             for i, name in enumerate(names)]
    opened = {"textDocument": {**document, "languageId": "dolphin", "version": 1, "text": text}}
    bodies = [json.dumps(message).encode() for message in [
        {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}, "rootUri": "file:///"}},
        {"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": opened}, *asked]]
    for _ in range(random.choice([0, 1, 3])):
        i = random.randrange(len(bodies))
        bodies[i] = hostile.in_json(random, bodies[i])
    bodies += [b'{"jsonrpc": "2.0", "id": 99, "method": "shutdown"}', b'{"jsonrpc": "2.0", "method": "exit"}']
    return bench.run(["lsp"], folder, "frames", b"".join(map(frame, bodies)))


def door_adapter(bench, random, folder):
    """Lines of an adapter, at the start or about a plan that it has taken; to `exec`, `fleet`, `check` and the kit."""
    if random.random() < 0.5:
        write(folder, m_dol=ADAPTED, reports=hostile.in_json(random, REPORTS))
        adapter = "cat reports; sleep 1"
    else:
        reports = HELLO + b"\n" + hostile.in_json(random, LATER)
        write(folder, m_dol=STEERED, reports=reports, answering_py=ANSWERING.encode())
        adapter = "python3 answering.py reports"
    arguments, form = random.choice([
        *[(["exec", "m.dol", "--platform", adapter, "--journal", "m.run", "--no-socket"], "text")] * 4,
        (["fleet", "--platform", adapter, "--once", "--seconds", "1"], "text"),
        (["fleet", "--platform", adapter, "--once", "--seconds", "1", "--json"], "lines"),
        (["check", "m.dol", "--platform", adapter], "text")])
    why = bench.run(arguments, folder, form, interrupt_after=PATIENCE)
    return why or journal_read(bench, random, folder, "m.dol")


def door_supplier(bench, random, folder):
    write(folder, m_dol=SUPPLIED, replies=hostile.in_json(random, REPLIES))
    why = bench.run(["exec", "m.dol", "--supplier", "cat replies; sleep 1", "--journal", "m.run"], folder,
                    interrupt_after=PATIENCE)
    return why or journal_read(bench, random, folder, "m.dol")


def door_definition(bench, random, folder):
    write(folder, IMC_xml=hostile.in_xml(random, bench.definition), m_dol=PROGRAM, m_fleet=FLEET)
    return bench.run(["plan", "m.dol", "--imc-xml", "IMC.xml"], folder, "json")


def door_options(bench, random, folder):
    """Hostile texts and numbers on the command line."""
    write(folder, m_dol=PROGRAM, m_fleet=FLEET)
    value = os.fsdecode((hostile.text(random) if random.random() < 0.7 else hostile.number(random)).replace(b"\0", b""))
    option = random.choice(["--set=note=", "--answer=", "--seed=", "--speed=", "--ltl=", "--invariant=", "--timeout=",
                            "--fleet=", "--faults=", "--until=", "--only=", "--resume=", "--supplier=", "--imc-type="])
    command = "explore" if option in ("--ltl=", "--invariant=", "--timeout=", "--faults=") else "exec"
    if option == "--supplier=":
        value = "exit 3 #" + value.replace("\n", "")
    limits = LIMITS if command == "explore" and option != "--timeout=" else []
    return bench.run([command, "m.dol", *limits, option + value], folder, interrupt_after=PATIENCE)


def door_posts(bench, random, folder):
    """Pairs on the command line of `dolphin post`, and of a run that is not there."""
    write(folder, m_dol=INPUTS, m_fleet=INPUTS_FLEET)
    value = os.fsdecode(hostile.text(random).replace(b"\0", b""))
    why = bench.run(["post", "m.run", f"n: '{value}'"], folder)
    return why or bench.run(["post", value or "x", "n: 1"], folder)


def door_case(bench, random, folder):
    (folder / "cases").mkdir()
    (folder / "cases" / "a.json").write_bytes(hostile.in_json(random, random.choice(bench.case_texts)))
    return bench.run(["conform", "cases", *random.choice([[], ["-v"], ["--matrix"]])], folder, interrupt_after=PATIENCE)


def door_trace(bench, random, folder):
    """A trace of the explorer, followed, and walked by choices that are hostile."""
    program, fleet, trace = random.choice(searches.traces_of_programs(bench))
    write(folder, m_dol=program, m_fleet=fleet, t_run=hostile.in_json(random, trace))
    arguments = random.choice(
        [["exec", "m.dol", "--follow", "t.run", "--no-socket"], ["walk", "m.dol", "--trace", "t.run"]])
    choices = b"\n".join(hostile.text(random) for _ in range(4)) + b"\n1\n2\n"
    return bench.run(arguments, folder, stdin=choices, interrupt_after=PATIENCE)


def door_graph(bench, random, folder):
    ending = random.choice(["aut", "json"])
    graph = random.choice(searches.graphs_of_programs(bench))[ending]
    (folder / f"a.{ending}").write_bytes(
        hostile.in_json(random, graph) if ending == "json" else hostile.filled(
            random, graph, hostile.STRING, lambda _: hostile.json_string(random)))
    arguments, form = random.choice([
        ([], "text"), (["--format", "json"], "json"), (["--format", "dot"], "text"), (["--format", "aut"], "text"),
        (["--quotient", "strong"], "text")])
    return bench.run(["lts", f"a.{ending}", *arguments], folder, form, interrupt_after=PATIENCE)


def door_fleet_of_orders(bench, random, folder):
    write(folder, m_fleet=INPUTS_FLEET, state=hostile.in_json(random, searches.FLEET_STATE))
    return bench.run(["sim", "m.fleet", "--platform", *random.choice([[], ["--state", "state"]])], folder, "lines",
                     hostile.in_json(random, searches.ORDERS), interrupt_after=PATIENCE)


def door_mission(bench, random, folder):
    """Stored missions of the adapter for MAVLink, if Python has what it needs."""
    if not bench.mavlink:
        return None
    ending = random.choice(["plan", "waypoints"])
    content = (hostile.in_json(random, bench.maps["plan"]) if ending == "plan" else
               hostile.in_columns(random, searches.MISSION))
    with open(os.path.join(os.fsencode(folder), random.choice([b"a", hostile.file_name(random, b"")]) + b"." +
                           ending.encode()), "wb") as file:
        file.write(content)
    write(folder, m_dol=b"v = pick { type 'UAV'; timeout 1.second }\nexecute task('a')[v]\n")
    adapter = f"DOLPHIN_MAVLINK={bench.mavlink} {searches.ROOT / 'platforms/mavlink/dolphin-mavlink'} --missions ."
    return bench.run(["check", "m.dol", "--platform", adapter], folder)


def door_answers(bench, random, folder):
    """Lines typed by a person."""
    write(folder, m_dol=b"x = ask 'what?'\ny = confirm('sure?')\nn = ask 'n'\npost k: [x, y, n]\nmessage \"${x} ${n}\"\n")
    stdin = b"".join(random.choice([hostile.text, hostile.number])(random) + b"\n" for _ in range(4))
    why = bench.run(["exec", "m.dol", "--journal", "m.run", "--no-socket"], folder, "text", stdin, interrupt_after=PATIENCE)
    return why or journal_read(bench, random, folder, "m.dol")


# Sequences that our own screens send to a terminal: colours, the cursor up, the rest of a line or of the screen gone.
OWN = re.compile(r"\x1b\[(?:[0-9;]*m|\d+A|[JK]|\?7[lh]|\?25[lh])|\r")


def door_terminal(bench, random, folder):
    """A run on a terminal, with its live screen."""
    write(folder, m_dol=hostile.in_program(random, PROGRAM), m_fleet=hostile.in_program(random, FLEET))
    (folder / "command").write_text("dolphin exec m.dol --no-socket, on a terminal\n")
    ours, theirs = os.openpty()
    process = subprocess.Popen([bench.dolphin, "exec", "m.dol", "--no-socket"], cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=theirs, stderr=theirs, env={**os.environ, "TERM": "xterm"})
    os.close(theirs)
    shown, until = b"", time.monotonic() + 3 * bench.seconds
    with contextlib.suppress(OSError):  # the end of a terminal
        while time.monotonic() < until and (data := os.read(ours, 65536)):
            shown += data
    os.close(ours)
    process.kill()
    process.wait()
    (folder / "terminal").write_bytes(shown)
    if time.monotonic() >= until:
        return "does not end"
    others = OWN.sub("", shown.decode(errors="surrogateescape"))
    return bad_output("terminal", "text", others.encode(errors="surrogateescape"))


READERS = {name: reader for name, reader in globals().items() if name.startswith("door_")}
