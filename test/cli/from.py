"""Runs of examples, cut off at drawn lines: what `dolphin time --from` says of the rest holds of the whole run, and
`dolphin explore --from` comes to an answer."""

import glob
import json
import os
import random
import subprocess
import sys

PAIRS = 40
ROUNDING = 0.002  # seconds: times of journals are exact, those of `time` whole milliseconds


def dolphin(*arguments):
    return subprocess.run(
        ["dolphin", *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def journal_of(program):
    """The lines of a run, if it completes by itself."""
    path = os.path.basename(program) + ".run"
    if not os.path.exists(path):
        dolphin("exec", program, "--journal", path)
    with open(path) as file:
        lines = file.readlines()
    return lines if lines and json.loads(lines[-1]).get("ending") == "completed" else None


def failure(program, lines, cut):
    with open("cut.run", "w") as file:
        file.writelines(lines[:cut])
    explored = dolphin("explore", program, "--from", "./cut.run", "--max-states", "20000")
    if explored.returncode == 2 and "this run is over" in explored.stderr:
        return None  # the event of the last line ends it
    if explored.returncode not in (0, 1, 3):
        return f"explore ends with status {explored.returncode}"
    timed = dolphin("time", program, "--from", "./cut.run", "--json", "--max-states", "20000")
    answer = json.loads(timed.stdout)
    window = answer["ends"].get("completed")
    end = json.loads(lines[-1])["time"]
    if "bound" in answer:
        return None
    if window is None:
        return "no run completes, says time"
    if end < window["earliest"] - ROUNDING or (window["latest"] is not None and end > window["latest"] + ROUNDING):
        return f"the run ends at {end}, not within {window}"
    return None


def check(programs, seed):
    draw = random.Random(seed)
    checked = 0
    while checked < PAIRS:
        program = draw.choice(programs)
        lines = journal_of(program)
        if not lines:
            programs.remove(program)
            continue
        cut = draw.randrange(1, len(lines) - 2)
        found = failure(program, lines, cut)
        if found:
            print(f"seed {seed}: {os.path.basename(program)} up to line {cut}: {found}")
        checked += 1


def is_steady(program):
    """No vehicle joins, leaves or loses its link by the fleet: from the middle of a run on, this is left out."""
    with open(program[: -len(".dol")] + ".fleet") as file:
        fleet = file.read()
    return not any(word in fleet for word in ("joins", "leaves", "drops"))


programs = list(filter(is_steady, sorted(glob.glob(sys.argv[1] + "/*.dol"))))
check(programs, 27)
if "DOLPHIN_SEED" in os.environ:
    check(programs, int(os.environ["DOLPHIN_SEED"]))
