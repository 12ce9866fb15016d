#!/usr/bin/env python3
"""Whether a console and the pages attached to it slow down commands to vehicles.

Usage: latency.py DOLPHIN [PAGES [ROUNDS]]

20 simulated vehicles speak IMC in another process, over the loopback address, and run ten short plans each. For each
plan but the first the time is taken from the end of the one before to the START of this one, as the vehicles see it.
The same mission is run by `dolphin exec`, by a console without pages, and by one with PAGES pages (5), in turn, ROUNDS
times (4), each round beginning with another of the three. The last column compares medians with that of `dolphin exec`,
and the last line the console with pages and without: they have the same figures if the median is within a quarter and 1
ms, and the 99th percentile within a half and 5 ms. The exit status is 1 if they do not. On a machine with other work
this means little: processes that compute more wait longer for a processor."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

DOLPHIN = os.path.abspath(sys.argv[1])
PAGES, ROUNDS = (int(x) for x in (sys.argv[2:] + ["5", "4"][len(sys.argv) - 2:]))
VEHICLES, PLANS = 20, 10
FIRST = 24800
NETWORK = ["--imc-loopback", "--imc-discovery-ports", f"{FIRST}-{FIRST + 4}"]

PROGRAM = f"""v = pick {{ count {VEHICLES}; timeout 30.seconds }}
t = {" >> ".join(["task('short')"] * PLANS)}
all = t
for (i in 2..{VEHICLES}) {{ all = all | t }}
execute all
"""


def ask(port, path, body=None):
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(f"http://127.0.0.1:{port}/api/{path}", data, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=20) as reply:
        return json.load(reply)


def follow(port, number, counts):
    """Reads all events, as a page does, until the server ends."""
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/api/events?client=page-{number}") as reply:
            for line in reply:
                counts[number] += line.startswith(b"event: journal")
    except OSError:
        pass


def by_exec(home):
    subprocess.run([DOLPHIN, "exec", os.path.join(home, "plans.dol"), *NETWORK], check=True, stdout=subprocess.DEVNULL,
                   timeout=200, env=environment(home))


def by_console(home, pages):
    server = subprocess.Popen([DOLPHIN, "console", home, *NETWORK, "--port", "0", "--no-browser"],
                              stdout=subprocess.PIPE, text=True, env=environment(home))
    try:
        port = int(server.stdout.readline().rsplit(":", 1)[1].strip(" /\n"))
        counts = [0] * pages
        for number in range(pages):
            threading.Thread(target=follow, args=(port, number, counts), daemon=True).start()
        while ask(port, "status")["watching"] < pages:
            time.sleep(0.05)
        ask(port, "run", {"program": "plans.dol"})
        while ask(port, "status")["run"]["state"] != "over":
            time.sleep(1)
        how = ask(port, "status")["run"]["outcome"]["how"]
        if how != "completed" or any(count == 0 for count in counts):
            raise SystemExit(f"the run: {how}; events of the pages: {counts}")
    finally:
        server.terminate()
        server.wait(30)


def environment(home):
    return {**os.environ, "XDG_STATE_HOME": os.path.join(home, "state")}


def gaps(home, run):
    """The times from a plan's end to the next START, in milliseconds."""
    log = os.path.join(home, "log.jsonl")
    vehicles = subprocess.Popen([DOLPHIN, "sim", os.path.join(home, "many.fleet"), "--imc", "--announce", "1",
                                 "--contact", "0.2", "--discovery-ports", f"{FIRST}-{FIRST + 4}", "--port",
                                 str(FIRST + 10), "--log", log], stdout=subprocess.PIPE, text=True)
    try:
        vehicles.stdout.readline()
        run()
    finally:
        vehicles.terminate()
        vehicles.wait(30)
    ended, found = {}, []
    with open(log, encoding="utf-8") as file:
        for line in map(json.loads, file):
            if line["did"] == "completed":
                ended[line["vehicle"]] = line["time"]
            elif line["did"] == "started" and line["vehicle"] in ended:
                found.append(1000 * (line["time"] - ended.pop(line["vehicle"])))
    return found


def main():
    with tempfile.TemporaryDirectory() as home:
        with open(os.path.join(home, "plans.dol"), "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        with open(os.path.join(home, "many.fleet"), "w", encoding="utf-8") as file:
            file.writelines(f"vehicle 'v{n}', {{ type 'UUV' }}\n" for n in range(VEHICLES))
            file.write("plan 'short', { duration 0.5, 1.5 }\n")
        kinds = {"dolphin exec": lambda: by_exec(home), "a console without pages": lambda: by_console(home, 0),
                 f"a console with {PAGES} pages": lambda: by_console(home, PAGES)}
        found = {kind: [] for kind in kinds}
        for n in range(ROUNDS):
            names = list(kinds)
            for kind in names[n % len(names):] + names[:n % len(names)]:
                found[kind] += gaps(home, kinds[kind])
        print(f"load: {os.getloadavg()[0]:.1f}, processors: {os.cpu_count()}")
        figures = {}
        for kind, times in found.items():
            times.sort()
            median, high = figures[kind] = statistics.median(times), times[int(len(times) * 0.99)]
            print(f"{kind:26} median {median:.2f} ms, 99 of 100 under {high:.2f} ms ({len(times)}), "
                  f"{median / figures['dolphin exec'][0]:.2f}")
        (median, high), (median_with, high_with) = list(figures.values())[1:]
        same = median_with <= 1.25 * median + 1 and high_with <= 1.5 * high + 5
        print(f"with {PAGES} pages and without: {'the same figures' if same else 'not the same figures'}")
        raise SystemExit(not same)


main()
