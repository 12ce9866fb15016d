#!/usr/bin/env python3
"""Missions over a bad network: the vehicles' logs, compared with the console's.

Usage: bench/imc_platform/lossy.py [--runs N] [--first SEED] [--at-once N] [--speed X] [--keep FOLDER] [DOLPHIN]

The mission of the paper runs N times (100), on simulated vehicles in another process that lose 30% of all datagrams,
double 10% and reorder 20%, both ways. Of each run, with a seed of its own, the log of the vehicles is compared with
that of the console: did the mission complete, was each plan started once, and was every restart of a plan reported?

The status is 1 if a mission did not complete, or if a request was sent again to a vehicle that had taken it.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "examples", "rendezvous.dol")
FLEET = os.path.join(ROOT, "examples", "rendezvous.fleet")
FAULTS = ["--loss", "0.3", "--duplication", "0.1", "--reordering", "0.2"]
PLANS = 9
PATIENCE = 180


def run(dolphin, folder, seed, speed):
    """One mission: its status, the console's log, the vehicles' log."""
    first = 43000 + seed % 200 * 40
    ports = f"{first}-{first + 4}"
    log = os.path.join(folder, f"vehicles-{seed}.jsonl")
    vehicles = subprocess.Popen(
        [dolphin, "sim", FLEET, "--imc", "--speed", str(speed), "--announce", "1", "--contact", "1",
         "--seed", str(seed), "--discovery-ports", ports, "--port", str(first + 10), "--log", log, *FAULTS],
        stdout=subprocess.PIPE, text=True)
    try:
        vehicles.stdout.readline()
        console = subprocess.run(
            [dolphin, "exec", PROGRAM, "--imc-loopback", "--imc-discovery-ports", ports, "--fleet", FLEET],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, timeout=PATIENCE)
        status, said = console.returncode, console.stdout
    except subprocess.TimeoutExpired as error:
        status, said = "no end", (error.stdout or b"").decode()
    finally:
        vehicles.send_signal(signal.SIGTERM)
        vehicles.wait(10)
    with open(os.path.join(folder, f"console-{seed}.txt"), "w", encoding="utf-8") as file:
        file.write(said)
    with open(log, encoding="utf-8") as file:
        return status, said, [json.loads(line) for line in file]


def compare(seed, said, deeds):
    """The outcomes of plans, counted; and the number of restarts reported by the console that did not happen."""
    taken = collections.defaultdict(list)
    for deed in deeds:
        if deed["did"] == "started":
            taken[deed["vehicle"], deed["plan"]].append((deed["request_id"], deed["sent"]))
    remarks = re.findall(r"(\S+): (?:plan (\S+) (?:begins anew|runs though|is requested again)|"
                         r".*?plan (\S+) is started again|the request for plan (\S+) arrived late)", said)
    remarked = {(vehicle, next(name for name in names if name).rstrip(";")) for vehicle, *names in remarks}
    count = collections.Counter()
    for where, starts in taken.items():
        requests = {number for number, _ in starts}
        copies = {sent for _, sent in starts}
        count["plans"] += 1
        if len(starts) == 1:
            count["once"] += 1
        elif len(copies) > len(requests):
            count["sent again in vain"] += 1
        else:
            # The same datagram, more than once.
            count["anew"] += 1
            count["anew, said"] += where in remarked
            if where not in remarked:
                print(f"run {seed}: not said: {where}", flush=True)
    count["said of a plan that began once"] = len([w for w in remarked if len(taken.get(w, [])) < 2])
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--first", type=int, default=1, help="the seed of the first run")
    parser.add_argument("--at-once", type=int, default=8, help="runs beside each other; they wait most of the time")
    parser.add_argument("--speed", type=float, default=60)
    parser.add_argument("--keep", help="a folder for the logs")
    parser.add_argument("dolphin", nargs="?")
    arguments = parser.parse_args()
    dolphin = arguments.dolphin
    if dolphin is None:
        subprocess.run(["dune", "build", "bin/dolphin.exe"], cwd=ROOT, check=True)
        dolphin = os.path.join(ROOT, "_build", "default", "bin", "dolphin.exe")
    total, completed, began = collections.Counter(), 0, time.time()
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        seeds = range(arguments.first, arguments.first + arguments.runs)
        with concurrent.futures.ThreadPoolExecutor(arguments.at_once) as pool:
            runs = pool.map(lambda seed: run(os.path.abspath(dolphin), folder, seed, arguments.speed), seeds)
            for seed, (status, said, deeds) in zip(seeds, runs):
                completed += status == 0
                if status != 0:
                    print(f"run {seed}: status {status}: {said.splitlines()[-1:] or ''}", flush=True)
                total += compare(seed, said, deeds)
    print(f"{completed} of {arguments.runs} missions completed, in {time.time() - began:.0f} s")
    print(f"{total['plans']} of {PLANS * arguments.runs} plans started; once: {total['once']}; "
          f"begun anew by a request that the network doubled: {total['anew']}, "
          f"of which the console said {total['anew, said']}")
    print(f"requests sent again to a vehicle that had taken them: {total['sent again in vain']}")
    print("plans of which the console said that they began anew, and they did not: "
          f"{total['said of a plan that began once']}")
    sys.exit(0 if completed == arguments.runs and total["sent again in vain"] == 0 else 1)


if __name__ == "__main__":
    main()
