"""Readers of the inputs of other programs: state graphs, states of `dolphin successors`, traces of the explorer,
conformance cases, the state of a simulated fleet, formulas and values on the command line, stored missions."""

import functools
import io
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

import mutate
from readers import INPUTS_FLEET as FLEET
from readers import PATIENCE, write
from verdict import bad_output, bad_text

ROOT = pathlib.Path(__file__).absolute().parents[2]
sys.path.insert(0, str(ROOT / "distributed"))
from dolphin_spark import successors as client  # noqa: E402

FORMULAS = [b"G (start(survey1) -> F done(survey1))", b"F ended", b"!F (halt | error) W input(abort)",
            b"G F running('survey', 'lauv-1') <-> X X bound('lauv-1')", b"done(p) R (a U b)", b"G (n > 3 -> F n == 0)"]
VALUES = [b"8", b"1..8", b"'text'", b"[1, 2.5, true]", b"41.18, -8.7", b"10.minutes", b"location 41.18, -8.7"]
CHOICES = [b"1", b"2", b"back", b"99", b"-1", b"help", b"\xff", b"\x1b[2J", b"write w.run", b"1e9"]
ORDERS = b"""{"kind": "hello", "protocol": 1, "dolphin": "1.0", "purpose": "run", "program": "m.dol", "resumes": false}
{"kind": "telemetry", "on": true}
{"kind": "hold", "vehicles": ["lauv-1"]}
{"kind": "start", "request": "k-1", "vehicle": "lauv-1", "plan": {"name": "survey"}, "timeout": 60}
{"kind": "resume", "request": "k-0", "vehicle": "lauv-1", "plan": {"name": "survey"}, "timeout": 60, "notes": [{}]}
{"kind": "timeout", "vehicles": null, "seconds": 30}
{"kind": "check", "id": 3, "plan": {"name": "p", "language": "imcPlan", "body": {"maneuvers": []}}}
{"kind": "ping", "id": 7}
{"kind": "stop", "request": "k-1", "vehicle": "lauv-1"}
{"kind": "release", "vehicles": ["lauv-1"]}
{"kind": "close"}
"""
MISSION = b"""QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t41.18\t-8.7\t10\t1
1\t0\t3\t22\t15\t0\t0\t0\t0\t0\t30\t1
2\t0\t3\t16\t0\t0\t0\t0\t41.181\t-8.7\t30\t1
3\t0\t3\t177\t2\t1\t0\t0\t0\t0\t0\t1
4\t0\t3\t21\t0\t0\t0\t0\t41.18\t-8.7\t0\t1
"""
FLEET_STATE = b"""{"began":1795765853.5}
{"time":0.1,"order":{"kind":"start","request":"k-0","vehicle":"lauv-1","plan":{"name":"survey"},"timeout":60.0}}
{"time":5,"order":{"kind":"stop","request":"k-0","vehicle":"lauv-1"}}
"""


def printed(bench, program, fleet, arguments):
    """The output of `dolphin`, or the file `out` that it writes, about a program and its fleet; None if it fails."""
    with tempfile.TemporaryDirectory(dir=bench.folder) as folder:
        folder = pathlib.Path(folder)
        write(folder, m_dol=program, m_fleet=fleet)
        ended = subprocess.run([bench.dolphin, *arguments], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                               timeout=60)
        out = folder / "out"
        if "out" in arguments:
            return out.read_bytes() if out.exists() else None
        return ended.stdout if ended.returncode == 0 else None


@functools.cache
def graphs_of_programs(bench):
    """State graphs, each in its two forms."""
    found = [{form: printed(bench, *program, ["lts", "m.dol", "--max-states", "100", "--format", form])
              for form in ("aut", "json")} for program in bench.programs[::9]]
    return [graph for graph in found if all(graph.values())]


@functools.cache
def traces_of_programs(bench):
    """Programs with their fleets, each with a run that the explorer shows."""
    arguments = ["explore", "m.dol", "--strict", "--faults", "all", "--max-states", "1000", "--workers", "1",
                 "--trace", "out"]
    found = [(*program, printed(bench, *program, arguments)) for program in bench.programs[::9]]
    return [seed for seed in found if seed[2]]


@functools.cache
def searches(bench):
    """Programs with their fleets, each with the greeting of `dolphin successors`, and the first parts and states."""
    found = []
    for program, fleet in bench.programs[::9]:
        with tempfile.TemporaryDirectory(dir=bench.folder) as folder:
            write(pathlib.Path(folder), m_dol=program, m_fleet=fleet)
            if subprocess.run([bench.dolphin, "check", "m.dol"], cwd=folder, capture_output=True).returncode != 0:
                continue
            here = pathlib.Path(folder) / "m.dol"
            process = client.Successors([bench.dolphin, "successors", str(here)])
            try:
                states = states_of(process.initial())
                states += states_of(process.ask(*columns(states)).blocks[0])
                found.append((program, fleet, sorted(process.told), [(b"", 0), *states]))
            except client.Inconclusive:
                pass
            process.close()
    return found


def graphs(bench, random, folder):
    """Two graphs in files, one of them mutated."""
    texts = {ending: random.choice(graphs_of_programs(bench))[ending] for ending in ("aut", "json")}
    ending, other = random.choice(["aut", "json"]), random.choice(["aut", "json"])
    every = [graph[ending] for graph in graphs_of_programs(bench)]
    mutated = (mutate.json_text if ending == "json" else mutate.text)(random, texts[ending], every)
    (folder / f"a.{ending}").write_bytes(mutated)
    (folder / f"b.{other}").write_bytes(texts[other])
    arguments, form = random.choice([
        ([], "text"), (["--format", "json"], "json"), (["--format", "dot"], "text"),
        (["--quotient", "strong"], "text"), (["--compare", f"b.{other}"], "text")])
    return bench.run(["lts", f"a.{ending}", *arguments], folder, form, interrupt_after=PATIENCE)


class Answers(client.Successors):
    """The answers of a filter that has ended, read from its output."""

    def __init__(self, data):
        self.data, self.told, self.path, self.shown = io.BytesIO(data), set(), "m.dol", "m.dol"
        self.process = type("Ended", (), {"stdin": io.BytesIO()})
        self.waiting = []
        self.greeting = self.data.readline()

    def _bytes(self, n):
        found = self.data.read(n)
        if len(found) != n:
            raise ValueError("an answer is cut off")
        return found


def states_of(block):
    """The states of a block, each with its kind."""
    n = struct.unpack_from("<Q", block)[0]
    lengths = struct.unpack_from(f"<{n}I", block, 8 + 24 * n)
    kinds, at = block[8 + 28 * n:8 + 29 * n], 8 + 29 * n
    found = []
    for length, kind in zip(lengths, kinds):
        found.append((block[at:at + length], kind))
        at += length
    return found


def columns(states):
    lengths = b"".join(struct.pack("<I", len(state)) for state, _ in states)
    return lengths, bytes(kind for _, kind in states), b"".join(state for state, _ in states)


def bad_answers(data, asked):
    """The fault of the answers to batches, each (its states' columns, partitions, targets), or None; they may be fewer."""
    answers = Answers(data)
    try:
        json.loads(answers.greeting)
        for batch, partitions, targets in asked:
            if answers.data.tell() == len(data):
                return None
            try:
                answers.ask(*batch, partitions=partitions, targets=targets)
            except client.Inconclusive as error:
                if bad_text(str(error)):
                    return f"answers: {bad_text(str(error))}"
    except ValueError as error:
        return f"answers: {error}"
    rest = len(data) - answers.data.tell()
    return f"answers: {rest} bytes too many" if rest else None


def successors(bench, random, folder):
    """Batches of states: parts, states or kinds mutated, with their lengths right, or any bytes."""
    program, fleet, known, states = random.choice(searches(bench))
    write(folder, m_dol=program, m_fleet=fleet)
    greeting = subprocess.run([bench.dolphin, "successors", "m.dol", "--greeting"], cwd=folder, capture_output=True,
                              timeout=60).stdout
    asked, sent = [], [greeting]
    for _ in range(random.choice([1, 2, 3])):
        chosen = [random.choice(states) for _ in range(random.choice([1, 2, 20]))]
        given = list(known)
        if given and random.random() < 0.5:
            i = random.randrange(len(given))
            given[i] = mutate.text(random, given[i], known)
        if random.random() < 0.6:
            i = random.randrange(len(chosen))
            chosen[i] = (mutate.text(random, chosen[i][0], [s for s, _ in states]), random.choice([0, 5, 128, 200]))
        partitions, targets = random.choice([1, 1, 3, 1000]), random.random() < 0.5
        asked.append((columns(chosen), partitions, targets))
        sent.append(client.batch(*asked[-1][0], given, partitions, targets))
    stream, framed = b"".join(sent), True
    if random.random() < 0.3:
        stream, framed = mutate.text(random, stream, [greeting]), False
    run = random.random() < 0.3
    why = bench.run(["successors", "m.dol", *(["--run"] if run else [])], folder, "bytes", stream)
    return why or (bad_output("run", "source", (folder / "stdout").read_bytes()) if run else
                   framed and bad_answers((folder / "stdout").read_bytes(), asked)) or None


def traces(bench, random, folder):
    """Traces that the explorer wrote, followed by others."""
    program, fleet, trace = random.choice(traces_of_programs(bench))
    write(folder, m_dol=program, m_fleet=fleet, t_run=mutate.json_text(random, trace, [trace]))
    arguments = random.choice(
        [["exec", "m.dol", "--follow", "t.run", "--no-socket"], ["walk", "m.dol", "--trace", "t.run"]])
    choices = b"\n".join(random.choice(CHOICES) for _ in range(8)) + b"\n"
    return bench.run(arguments, folder, stdin=choices, interrupt_after=PATIENCE)


def cases(bench, random, folder):
    case = random.choice(bench.case_texts)
    (folder / "cases").mkdir()
    (folder / "cases" / "a.json").write_bytes(mutate.json_text(random, case, bench.case_texts))
    return bench.run(["conform", "cases", *random.choice([[], ["-v"], ["--matrix"]])], folder, interrupt_after=PATIENCE)


def orders(bench, random, folder):
    """Orders for a simulated fleet, and the file that it outlives its process in."""
    write(folder, m_fleet=FLEET, state=mutate.json_text(random, FLEET_STATE, [FLEET_STATE, ORDERS]))
    stdin = ORDERS if random.random() < 0.5 else mutate.json_text(random, ORDERS, [ORDERS, FLEET_STATE])
    state = random.choice([[], ["--state", "state"]])
    return bench.run(["sim", "m.fleet", "--platform", *state], folder, "lines", stdin, interrupt_after=PATIENCE)


def options(bench, random, folder):
    """Formulas, conditions and values on the command line."""
    program, fleet = random.choice(bench.programs)
    write(folder, m_dol=program, m_fleet=fleet)
    name, originals = random.choice([
        ("--ltl", FORMULAS), ("--invariant", FORMULAS), ("--answer", VALUES),
        ("--set", [b"n=" + value for value in VALUES]), ("--faults", [b"fail=1,loss=2", b"all"])])
    value = mutate.text(random, random.choice(originals), originals).replace(b"\0", b"")[:100_000]
    command = random.choice(["explore", "explore", "time", "lts", "walk"])
    if name in ("--ltl", "--invariant"):
        command = "explore"
    limits = ["--max-states", "300", "--timeout", "4"] if command != "walk" else []
    return bench.run([command, "m.dol", *limits, f"{name}={os.fsdecode(value)}"], folder, interrupt_after=PATIENCE)


def missions(bench, random, folder):
    """Stored missions of the adapter for MAVLink, if Python has what it needs."""
    if not bench.mavlink:
        return None
    ending = random.choice(["plan", "waypoints"])
    original = bench.maps["plan"] if ending == "plan" else MISSION
    mutation = mutate.json_text if ending == "plan" else mutate.text
    (folder / f"a.{ending}").write_bytes(mutation(random, original, [original]))
    write(folder, m_dol=b"v = pick { type 'UAV' }\nexecute task('a')[v]\n")
    adapter = f"DOLPHIN_MAVLINK={bench.mavlink} {ROOT / 'platforms/mavlink/dolphin-mavlink'} --missions ."
    return bench.run(["check", "m.dol", "--platform", adapter], folder)


READERS = {reader.__name__: reader for reader in (
    graphs, successors, traces, cases, orders, options, missions)}
