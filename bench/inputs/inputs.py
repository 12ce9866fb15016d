#!/usr/bin/env python3
"""Inputs on the socket of a run: how long one takes to the step that it enables, and how many a second are taken.

inputs.py [DOLPHIN [SECONDS [RATE]]] (without DOLPHIN it is built first): in a simulated run in real time, and on a
vehicle that speaks IMC over loopback, while the vehicle runs a plan:
- of 300 inputs, one after the other, the time from sending each to reading in the journal the step that took it;
- of RATE inputs a second (1,000) for SECONDS seconds (60), how many were taken;
- both again with 20 followers, one of which never reads, for a sixth of the time;
- 10,000 malformed lines: each is answered by an error, and moves nothing.
Nothing may be lost, order must be kept, and each follower that reads must see the whole journal. Each figure stands
beside its target; the status is 1 if one is missed. On a machine that is busy otherwise, the processor's time counts.
"""
import hashlib
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM = """
input 'n', 'over'
v = pick { type 'UUV' }
message "starts"
execute until { poll over: true } run (task('survey')[v] | repeat condition { consume n: _ })
"""
FLEET = """
vehicle 'lauv-1', { type 'UUV' }
plan 'survey', { duration 10.hours }
"""
PORTS = "24300-24304"
LONGEST = 2  # milliseconds, of the median
KEPT = 0.99  # of the rate at which inputs are posted
WRONG = ["", "nothing", "[1]", "{}", '{"request": "dance"}', '{"request": "post"}', "[" * 1000, "x" * 70000, "\x00",
         '{"request": "post", "key": "other", "value": 1}', '{"request": "post", "key": "n", "value": {"task": "p"}}']


def connect(path):
    s = socket.socket(socket.AF_UNIX)
    s.connect(path)
    return s.makefile("rw", encoding="utf-8")


def connect_two_threads(path):
    """What one thread writes to and another one reads from: a file is not for two."""
    s = socket.socket(socket.AF_UNIX)
    s.connect(path)
    return s.makefile("w", encoding="utf-8"), s.makefile("r", encoding="utf-8")


def post(lines, key, value):
    lines.write(json.dumps({"request": "post", "key": key, "value": value}) + "\n")


def over(path):
    lines = connect(path)
    post(lines, "over", True)
    lines.flush()
    lines.readline()


def follow(path):
    lines = connect(path)
    lines.write('{"request": "follow"}\n')
    lines.flush()
    return lines


class Run:
    """A run with its journal, on a simulated vehicle, or on one of `dolphin sim --imc`."""

    def __init__(self, dolphin, imc, folder):
        self.journal = os.path.join(folder, "n.run")
        self.path = self.journal + ".sock"
        program, fleet = os.path.join(folder, "n.dol"), os.path.join(folder, "n.fleet")
        for name, text in (program, PROGRAM), (fleet, FLEET):
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        self.vehicles = None
        if imc:
            self.vehicles = subprocess.Popen([dolphin, "sim", fleet, "--imc", "--discovery-ports", PORTS],
                                             stdout=subprocess.DEVNULL)
            where = ["--imc-loopback", "--imc-discovery-ports", PORTS]
        else:
            where = ["--speed", "1"]
        self.run = subprocess.Popen([dolphin, "exec", program, "--journal", self.journal] + where,
                                    stdout=subprocess.DEVNULL)
        while not os.path.exists(self.path):
            time.sleep(0.01)
        lines = follow(self.path)
        while '"label":"start(lauv-1' not in lines.readline():
            pass

    def seconds(self):
        """The processor's seconds that dolphin has taken."""
        with open("/proc/%d/stat" % self.run.pid, encoding="utf-8") as file:
            fields = file.read().rsplit(") ", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def end(self, values):
        """Whether all that was posted is in the journal, in order, and the run was completed."""
        over(self.path)
        status = self.run.wait()
        if self.vehicles:
            self.vehicles.terminate()
            self.vehicles.wait()
        with open(self.journal, encoding="utf-8") as file:
            found = [e["value"] for e in map(json.loads, file) if e.get("event") == "input"]
        return status == 0 and found == values + [True]


class Followers:
    """Twenty, one of which never reads."""

    def __init__(self, path):
        self.deaf = follow(path)
        self.seen = []
        self.threads = [threading.Thread(target=self.read, args=(path,)) for _ in range(19)]
        for thread in self.threads:
            thread.start()

    def read(self, path):
        s = socket.socket(socket.AF_UNIX)
        s.connect(path)
        s.sendall(b'{"request": "follow"}\n')
        with s.makefile("rb") as lines:
            lines.readline()  # the reply
            seen = hashlib.sha256()
            while part := lines.read(65536):
                seen.update(part)
        self.seen.append(seen.digest())

    def end(self, journal):
        """How many of those that read have seen the whole journal."""
        for thread in self.threads:
            thread.join()
        with open(journal, "rb") as file:
            return self.seen.count(hashlib.sha256(file.read()).digest())


class Figures:
    """Lines of figures beside their targets."""

    def __init__(self):
        self.missed = 0

    def show(self, what, figure, target="", reached=True):
        self.missed += not reached
        print(f"  {what:58}{figure:>28}  {target}{'' if reached else '  MISSED'}", flush=True)


def latency(figures, run, begin, times, what):
    follower, poster = follow(run.path), connect(run.path)

    def one(i):
        label = '"label":"check(consume n:%d)"' % i
        start = time.perf_counter()
        post(poster, "n", i)
        poster.flush()
        while label not in follower.readline():
            pass
        seconds = time.perf_counter() - start
        poster.readline()
        return 1000 * seconds

    one(begin)  # the follower has read the journal so far
    took = sorted(one(begin + i) for i in range(1, times))
    median = statistics.median(took)
    figures.show(f"input to the step that it enables{what}: median", f"{median:.2f} ms", f"below {LONGEST} ms",
                 median < LONGEST)
    figures.show("  99 of 100; longest", f"{took[len(took) * 99 // 100]:.2f} ms; {took[-1]:.2f} ms")


def load(figures, run, begin, times, rate, what):
    lines, answers = connect_two_threads(run.path)
    replies = []
    reader = threading.Thread(target=lambda: replies.extend(answers.readline() for _ in range(times)))
    reader.start()
    start, cpu = time.perf_counter(), run.seconds()
    for i in range(times):
        wait = start + i / rate - time.perf_counter()
        if wait > 0:
            lines.flush()
            time.sleep(wait)
        post(lines, "n", begin + i)
    lines.flush()
    reader.join()
    seconds = time.perf_counter() - start
    taken = sum('"ok":true' in r for r in replies)
    figures.show(f"inputs taken{what}", f"{taken} in {seconds:.1f} s", f"all {times}", taken == times)
    figures.show("  a second", f"{times / seconds:.0f}", f"{rate:.0f}", times / seconds >= KEPT * rate)
    figures.show("  dolphin's processor time for each", f"{1000 * (run.seconds() - cpu) / times:.2f} ms")


def garbage(figures, run, times):
    lines, answers = connect_two_threads(run.path)
    size = os.path.getsize(run.journal)

    def send():
        for i in range(times):
            lines.write(WRONG[i % len(WRONG)] + "\n")
        lines.flush()

    sender = threading.Thread(target=send)
    start = time.perf_counter()
    sender.start()
    errors = sum("error" in json.loads(answers.readline()) for _ in range(times))
    sender.join()
    seconds = time.perf_counter() - start
    with open(run.journal, encoding="utf-8") as file:
        moved = [line for line in file.read()[size:].splitlines() if '"input"' in line]
    figures.show("malformed lines answered by an error", f"{errors} in {seconds:.1f} s", f"all {times}", errors == times)
    figures.show("  inputs in the journal meanwhile", f"{len(moved)}", "0", not moved)


def all_of(figures, dolphin, imc, seconds, rate):
    what = "on a vehicle that speaks IMC, over loopback" if imc else "simulated, in real time"
    print(f"{what:60}{'':>28}  target")
    most, few = int(seconds * rate), int(seconds * rate / 6)
    followed = ", with 20 followers"
    with tempfile.TemporaryDirectory() as folder:
        run = Run(dolphin, imc, folder)
        latency(figures, run, 0, 300, "")
        load(figures, run, 300, most, rate, "")
        followers = Followers(run.path)
        latency(figures, run, 300 + most, 300, followed)
        load(figures, run, 600 + most, few, rate, followed)
        garbage(figures, run, 10000)
        count = 600 + most + few
        kept = run.end(list(range(count)))
        figures.show("all inputs are in the journal, in order", "yes" if kept else "no", "yes", kept)
        whole = followers.end(run.journal)
        figures.show("followers that read have the whole journal", f"{whole}", "all 19", whole == 19)


def main():
    root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    if len(sys.argv) > 1:
        dolphin = os.path.abspath(sys.argv[1])
    else:
        subprocess.run(["dune", "build", "--profile", "release", "bin/dolphin.exe"], cwd=root, check=True)
        dolphin = os.path.join(root, "_build", "default", "bin", "dolphin.exe")
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60
    rate = float(sys.argv[3]) if len(sys.argv) > 3 else 1000
    figures = Figures()
    for imc in False, True:
        all_of(figures, dolphin, imc, seconds, rate)
    return 1 if figures.missed else 0


if __name__ == "__main__":
    sys.exit(main())
