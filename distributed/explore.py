"""Explores a program on Apache Spark, breadth first: dolphin explore for state spaces too large for one machine.
docs/scale.md describes its use."""

import argparse
import os
import subprocess
import sys
import tempfile
import time

from dolphin_spark import files
from dolphin_spark.facts import places_may_cycle
from dolphin_spark.local import Local
from dolphin_spark.successors import Inconclusive, Successors, run

HERE = os.path.dirname(os.path.abspath(__file__))
NOTES = ("no halt", "no leftover tuples")
ERRORS = ("no unhandled error", "assertions", "vehicles for all picks", "vehicles for all tasks")
RARE = ("vehicles for all picks",)  # printed only if it does not hold, as by dolphin explore


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", metavar="PROG")
    parser.add_argument("--fleet", help="by default the file beside PROG")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--answer", action="append", default=[], metavar="TEXT")
    parser.add_argument("--faults")
    parser.add_argument("--reduction", choices=["none", "por"], default="none")
    parser.add_argument("--invariant", action="append", default=[], metavar="CONDITION")
    parser.add_argument("--dolphin", default="dolphin", help="the command, which is sent to the machines")
    parser.add_argument("--master", default="local[2]", help="of Spark: spark://HOST:7077, yarn, k8s://... (local[2])")
    parser.add_argument("--partitions", type=int, default=16, help="by which states are spread (16)")
    parser.add_argument("--width", type=int, default=20000,
                        help="states that a level has before Spark takes over; until then one process searches (20000)")
    parser.add_argument("--folder", help="where levels are kept: a folder, or a URL that all machines reach")
    parser.add_argument("--resume", action="store_true", help="go on with the search in --folder")
    return parser.parse_args()


def main():
    a = arguments()
    dolphin = files.command(a.dolphin)
    fleet = a.fleet or files.beside(a.program)
    options = []
    for name, values in (("--set", a.set), ("--answer", a.answer), ("--invariant", a.invariant)):
        options += [word for value in values for word in (name, value)]
    options += (["--faults", a.faults] if a.faults else []) + ["--reduction", a.reduction]
    command = [dolphin, "successors", a.program] + (["--fleet", fleet] if fleet else []) + options
    if a.resume and not a.folder:
        sys.exit("--resume goes on with the search in a folder: give --folder")
    began = time.time()
    successors = Successors(command)
    search = None
    try:
        with tempfile.TemporaryDirectory(prefix="dolphin-") as scratch:
            local = Local(successors, a.invariant)
            if not a.resume:
                local.run(a.width)
            if a.resume or local.frontier:
                search = on_spark(a, dolphin, fleet, options, local, scratch)
            status = report(a, command, successors.greeting, search or local, began)
    except Inconclusive as why:
        print("inconclusive: %s" % why)
        status = 3
    except KeyboardInterrupt:
        status = 130
    successors.close()
    sys.exit(status)


def on_spark(a, dolphin, fleet, options, local, scratch):
    from dolphin_spark import ship
    from dolphin_spark.search import Search, Store
    spark = ship.context("dolphin explore", a.master, [dolphin, a.program] + ([fleet] if fleet else []), scratch)
    folder = a.folder or os.path.join(scratch, "levels")
    if "://" not in folder:
        folder = "file://" + os.path.abspath(folder)
    job = files.job(dolphin, a.program, fleet, options)
    job.update(greeting=local.successors.greeting, shown=a.program, conditions=a.invariant, partitions=a.partitions)

    def tell(search):
        print("depth %d: %d states, frontier %d" % (search.depth, search.states, search.frontier), file=sys.stderr)

    search = Search(spark, job, Store(spark, folder), tell, local.successors)
    if a.resume:
        search.resume()
    else:
        search.begin(local)
    search.run()
    return search


def termination(found):
    if found.facts.rounds:
        return "inconclusive: a task may go round by itself, which dolphin explore judges by fairness"
    if not places_may_cycle(found.facts.places):
        return "holds"
    return "violated" if found.may_cycle() else "holds"


def path(found, known, depth):
    """The states from after the initial one up to that of `known`."""
    states = []
    while depth > 0:
        state, known = found.find(known, depth)
        states.insert(0, state)
        depth -= 1
    return states


def report(a, command, greeting, found, began):
    facts = found.facts
    verdicts = [("no deadlock", None), ("termination", termination(found))] + [(name, None) for name in ERRORS]
    verdicts += [(name, None) for name in NOTES]
    verdicts += [("invariant " + condition, None) for condition in a.invariant]
    status = 0
    for name, verdict in verdicts:
        known = facts.first.get(name)
        if verdict is None:
            verdict = "holds" if known is None else "violated after %d step%s" % (known[0], "s" * (known[0] != 1))
            if known is None and name.startswith("invariant") and facts.trouble:
                verdict = "inconclusive: the condition cannot be evaluated: " + facts.trouble
        if verdict == "holds" and name in NOTES + RARE:
            continue
        if name in NOTES:
            name = "note: " + name
        elif verdict.startswith("violated"):
            status = 1
        elif verdict != "holds" and status == 0:
            status = 3
        print("%s: %s" % (name, verdict))
    for line in sorted(facts.unreached or ()):
        print("note: no run reaches %s" % line)
    seconds = time.time() - began
    print("%d states, %d transitions, depth %d, %.1f s" % (found.states, facts.transitions, found.depth, seconds))
    sys.stdout.flush()
    for name, (depth, known) in sorted(facts.first.items()):
        if name not in NOTES:
            print("\n%s: a run of %d steps" % (name, depth), flush=True)
            states = path(found, known, depth)
            subprocess.run(command + ["--run"], input=greeting + run(states, found.parts), check=False)
    return status


if __name__ == "__main__":
    main()
