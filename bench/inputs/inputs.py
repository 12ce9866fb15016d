#!/usr/bin/env python3
"""Inputs on the socket of a run: how long one takes to the step that it enables, and how many a second are taken.

inputs.py DOLPHIN [SECONDS [RATE]]: of RATE inputs a second (1,000) for so many SECONDS (60), in a simulated run in real
time, with a follower; and of 300 inputs, one after the other, the time from sending each to reading in the journal
the step that took it. Nothing may be lost, and order must be kept.
"""
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
taken = 0
while (taken < TIMES) {
    execute condition { consume n: taken }
    taken = taken + 1
}
execute condition { consume over: true }
"""


def connect(path):
    s = socket.socket(socket.AF_UNIX)
    s.connect(path)
    return s.makefile("rw", encoding="utf-8")


def post(lines, key, value):
    lines.write(json.dumps({"request": "post", "key": key, "value": value}) + "\n")


def with_run(dolphin, times, f):
    with tempfile.TemporaryDirectory() as folder:
        program, journal = os.path.join(folder, "n.dol"), os.path.join(folder, "n.run")
        with open(program, "w", encoding="utf-8") as file:
            file.write(PROGRAM.replace("TIMES", str(times)))
        run = subprocess.Popen([dolphin, "exec", program, "--speed", "1", "--journal", journal],
                               stdout=subprocess.DEVNULL)
        while not os.path.exists(journal + ".sock"):
            time.sleep(0.01)
        f(journal + ".sock")
        status = run.wait()
        with open(journal, encoding="utf-8") as file:
            values = [e["value"] for e in map(json.loads, file) if e.get("event") == "input"]
        assert status == 0 and values == list(range(times)) + [True], "something was lost, or out of order"


def latency(path):
    follower, poster = connect(path), connect(path)
    follower.write('{"request": "follow"}\n')
    follower.flush()
    took = []
    for i in range(300):
        label = '"label":"check(consume n:%d)"' % i
        start = time.perf_counter()
        post(poster, "n", i)
        poster.flush()
        while label not in follower.readline():
            pass
        took.append(1000 * (time.perf_counter() - start))
        poster.readline()
    post(poster, "over", True)
    poster.flush()
    poster.readline()
    took.sort()
    print("input to the step that it enables: median %.2f ms, 99 of 100 under %.2f ms, longest %.2f ms"
          % (statistics.median(took), took[297], took[-1]))


def load(times, rate):
    def run(path):
        lines = connect(path)
        replies = []
        reader = threading.Thread(target=lambda: replies.extend(lines.readline() for _ in range(times)))
        reader.start()
        start = time.perf_counter()
        for i in range(times):
            wait = start + i / rate - time.perf_counter()
            if wait > 0:
                lines.flush()
                time.sleep(wait)
            post(lines, "n", i)
        lines.flush()
        reader.join()
        seconds = time.perf_counter() - start
        assert all('"ok":true' in r for r in replies)
        post(lines, "over", True)
        lines.flush()
        print("%d inputs in %.1f s, %.0f a second: none lost, in order" % (times, seconds, times / seconds))
    return run


if __name__ == "__main__":
    dolphin = os.path.abspath(sys.argv[1])
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60
    rate = float(sys.argv[3]) if len(sys.argv) > 3 else 1000
    with_run(dolphin, 300, latency)
    times = int(seconds * rate)
    with_run(dolphin, times, load(times, rate))
