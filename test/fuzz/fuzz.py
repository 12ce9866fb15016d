#!/usr/bin/env python3
"""Has every reader of Dolphin read mutated inputs, and judges the output.

fuzz.py DOLPHIN [--seconds S | --inputs N] [--seed N] [--only READER] [--first N] [--limit S] [--keep DIR]

Input i of a reader depends on the seed, the reader and i alone. Each has `limit` seconds of the processor's time and
1 GB. Faults are: other statuses than 0 to 3 and 130, death by a signal, no end, output that is not UTF-8, JSON or XML
that is not valid, control characters. What fails is kept in DIR/READER-SEED-i/, with `command` and what was written.
Missions for MAVLink are read by the Python that DOLPHIN_MAVLINK names, which has pymavlink; without it they are not."""

import argparse
import concurrent.futures
import itertools
import os
import pathlib
import random
import shutil
import sys
import tempfile
import time

import consoles
import doors
import readers
import searches
from readers import Bench

ROOT = pathlib.Path(__file__).absolute().parents[2]
MOST_KEPT = 100
READERS = {**readers.READERS, **searches.READERS, **consoles.READERS, **doors.READERS}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dolphin", type=lambda path: shutil.which(path) and os.path.abspath(shutil.which(path)))
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no input after so many seconds")
    parser.add_argument("--inputs", type=int, default=sys.maxsize, help="give each reader so many inputs")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=READERS, action="append", help="only this reader")
    parser.add_argument("--first", type=int, default=0, help="begin with this input")
    parser.add_argument("--limit", type=int, default=10, help="seconds of the processor's time for an input")
    parser.add_argument("--keep", type=pathlib.Path, help="where inputs with a fault are kept")
    return parser.parse_args()


def attempt(options, bench, scratch, name, index):
    """The fault with which the reader `name` reads its input `index`; or None. Inputs with a fault are kept."""
    folder = scratch / f"{name}-{options.seed}-{index}"
    folder.mkdir()
    try:
        why = READERS[name](bench, random.Random(f"{options.seed} {name} {index}"), folder)
        if why:
            (folder / "why").write_text(why + "\n", errors="replace")
            if options.keep and len(list(options.keep.glob("*"))) < MOST_KEPT:
                shutil.copytree(folder, options.keep / folder.name, dirs_exist_ok=True,
                                ignore=shutil.ignore_patterns("*.sock"))
    finally:
        shutil.rmtree(folder)
    return why


def main():
    options = arguments()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    names = options.only or list(READERS)
    end = time.monotonic() + options.seconds
    read = faults = 0
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor() as pool:
        scratch = pathlib.Path(scratch)
        os.environ.update(XDG_STATE_HOME=str(scratch / "state"), XDG_CACHE_HOME=str(scratch / "cache"))
        bench = Bench(options.dolphin, ROOT, options.limit, scratch, os.environ.get("DOLPHIN_MAVLINK"))
        for index in itertools.count(options.first):
            if index >= options.first + options.inputs or time.monotonic() > end:
                break
            for name, why in zip(names, pool.map(lambda name: attempt(options, bench, scratch, name, index), names)):
                read += 1
                if why:
                    faults += 1
                    print(f"{name} {index}: {why}", flush=True)
    print(f"{read} inputs of {len(names)} readers, seed {options.seed}: {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
