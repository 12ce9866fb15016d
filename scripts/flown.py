"""The way that a vehicle went under a plan, from the journal of a run: whether a plan that was stopped, and went on by
`rest`, was flown once, as in a run without stops."""

import json
import math
import os
import signal
import subprocess
import time

METRES_PER_DEGREE = 111194.9
OFF = 20.0  # metres that a place of the way may be missed by
TWICE = 20.0  # metres that each stop may add or take away
CORNERS = 0.03  # of the way that lines between reports may be shorter


class Flown(Exception):
    """Why the plan was not flown once."""


def fly(command, folder, kills, patience, **more):
    """Runs the command `dolphin exec` with a journal in the folder, and returns the journal. The console is killed as
    many seconds after its start, or resumption, as each of [kills], and resumed a moment later; the last one has
    [patience] seconds to end."""
    journal, output = os.path.join(folder, "run"), os.path.join(folder, "output")
    for number in range(len(kills) + 1):
        kept = ["--journal" if number == 0 else "--resume", journal]
        with open(output, "a", encoding="utf-8") as printed:
            console = subprocess.Popen([*command, *kept], stdout=printed, stderr=printed, **more)
            try:
                status = console.wait(kills[number] if number < len(kills) else patience)
            except subprocess.TimeoutExpired:
                console.send_signal(signal.SIGKILL)
                status = console.wait() if number < len(kills) else 1
        if status == 0:
            break
        if status != -signal.SIGKILL:
            with open(output, encoding="utf-8") as printed:
                raise Flown(f"the run ended with status {status}: {printed.read()[-600:]}")
        time.sleep(0.5)
    return journal


def distance(p, q):
    north = (q[0] - p[0]) * METRES_PER_DEGREE
    east = (q[1] - p[1]) * METRES_PER_DEGREE * math.cos(math.radians(p[0]))
    return math.hypot(north, east)


def between(p, q, share):
    return (p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share)


def _nearest(p, q, place):
    """The point from p to q that is nearest to a place."""
    scale = math.cos(math.radians(p[0]))
    x, y = (q[1] - p[1]) * scale, q[0] - p[0]
    length = x * x + y * y
    if length == 0.0:
        return p
    share = ((place[1] - p[1]) * scale * x + (place[0] - p[0]) * y) / length
    return between(p, q, min(1.0, max(0.0, share)))


def _from_first(places, first, near):
    """The places from the one on where the vehicle is near the first place of its way."""
    for i, (p, q) in enumerate(zip(places, places[1:])):
        if distance(_nearest(p, q, first), first) <= near:
            while i + 2 < len(places) and distance(places[i + 2], first) < distance(places[i + 1], first):
                i += 1
            here = _nearest(places[i], places[i + 1], first)
            return [here, *places[i + 1:]]
    return []


def parts(journal, vehicle, plan, near=OFF):
    """What the vehicle flew under the plan, a list of places for each start, from its first place on."""
    found, places, first = [], None, None
    with open(journal, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file if line.endswith("\n")]
    here = None
    for line in lines:
        if line.get("kind") == "vehicle" and line["vehicle"] == vehicle:
            here = (line["latitude"], line["longitude"])
            if places is not None:
                places.append(here)
        elif line.get("kind") == "transition" and vehicle in (line.get("A") or {}):
            if places is not None:
                found.append(_from_first(places, first, near))
                places = None
            if line["A"][vehicle] == plan and vehicle in line.get("ways", {}):
                first = tuple(line["ways"][vehicle][1])
                places = [] if here is None else [here]
    if places is not None:
        found.append(_from_first(places, first, near))
    return [part for part in found if part]


def metres(places):
    return sum(distance(p, q) for p, q in zip(places, places[1:]))


def _dense(places):
    dense = places[:1]
    for p, q in zip(places, places[1:]):
        n = max(1, math.ceil(distance(p, q) / 2.0))
        dense += [between(p, q, (k + 1) / n) for k in range(n)]
    return dense


def _passes(way, flown, off):
    j = 0
    for place in way:
        while distance(flown[j], place) > off:
            j += 1
            if j == len(flown):
                return False
    return True


def compare(whole, broken, stops, twice=TWICE):
    """Metres by which a place of the way was missed, at most; and metres flown more than in the run without stops."""
    way = _dense([p for part in whole for p in part])
    flown = [p for part in broken for p in _dense(part)]
    if not way or not flown:
        raise Flown("nothing was flown")
    off = next((k / 2 for k in range(1, 2 * int(OFF) + 1) if _passes(way, flown, k / 2)), None)
    more = sum(metres(part) for part in broken) - sum(metres(part) for part in whole)
    if off is None:
        raise Flown(f"a place of the way was missed by more than {OFF:g} m; {more:+.0f} m")
    if abs(more) > twice * max(1, stops) + CORNERS * sum(metres(part) for part in whole):
        raise Flown(f"{more:+.0f} m flown with {stops} stops; at most {off:g} m off")
    return off, more
