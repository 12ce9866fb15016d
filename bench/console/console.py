#!/usr/bin/env python3
"""The load that a console withstands during a run: watchers, floods of nonsense, idle connections.

Usage: console.py DOLPHIN [WATCHERS [POSTS [NONSENSE]]]

A run waits for inputs. WATCHERS watchers follow it; inputs are posted one after the other, and for each the time is
taken until the first watcher reads it in the journal. Then nonsense is sent, and 1,000 connections stay idle; the
figures are taken once more. Everything is on the loopback address, and bounded."""

import json
import os
import random
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

DOLPHIN = sys.argv[1]
WATCHERS, POSTS, NONSENSE = (int(x) for x in (sys.argv[2:] + ["20", "200", "10000"][len(sys.argv) - 2:]))

PROGRAM = """input 'n', 'over'
execute until { poll over: true } run action { x = 0 } >> condition { poll never: 1 }
"""


def process_figures(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    with open(f"/proc/{pid}/status", encoding="ascii") as file:
        rss = next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK"), rss / 1024, len(os.listdir(f"/proc/{pid}/fd"))


def ask(port, path, body=None):
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(f"http://127.0.0.1:{port}/api/{path}", data, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=20) as reply:
        return json.load(reply)


class Watcher(threading.Thread):
    """Reads all events; notes when each input was seen."""

    def __init__(self, port, number):
        super().__init__(daemon=True)
        self.seen, self.news, self.count = {}, threading.Condition(), 0
        self.reply = urllib.request.urlopen(f"http://127.0.0.1:{port}/api/events?client=watcher-{number}")
        self.start()

    def run(self):
        for line in self.reply:
            if line.startswith(b"data: ") and b'"event":"input"' in line:
                with self.news:
                    self.count += 1
                    self.seen[json.loads(line[6:])["value"]] = time.perf_counter()
                    self.news.notify()

    def until(self, value):
        with self.news:
            self.news.wait_for(lambda: value in self.seen, timeout=20)
        return self.seen[value]


def latencies(port, watcher, first):
    found = []
    for n in range(first, first + POSTS):
        began = time.perf_counter()
        ask(port, "run/post", {"key": "n", "value": n})
        found.append(1000 * (watcher.until(n) - began))
    found.sort()
    return f"median {statistics.median(found):.1f} ms, 99 of 100 under {found[int(len(found) * 0.99) - 1]:.1f} ms"


def nonsense(port):
    chance = random.Random(18)
    pieces = [b"GET /api/run HTTP/1.1\r\n", b"POST /api/run/stop HTTP/1.1\r\n", b"Host: evil.example\r\n", b"\r\n\r\n",
              b"Content-Length: 99999999\r\n", b"Transfer-Encoding: chunked\r\n", b"%00", b"../../etc/passwd", b"\xff\x00"]
    replies = 0
    for _ in range(NONSENSE):
        text = b"".join(chance.choice(pieces) for _ in range(chance.randrange(1, 8))) + b"\r\n\r\n"
        with socket.create_connection(("127.0.0.1", port), timeout=20) as sock:
            try:
                sock.sendall(text)
                sock.shutdown(socket.SHUT_WR)
                replies += sock.recv(12)[9:10] in (b"4", b"5")
            except OSError:
                pass
    return replies


def idle(port):
    found = []
    for _ in range(1000):
        try:
            found.append(socket.create_connection(("127.0.0.1", port), timeout=5))
        except OSError:
            break
    return found


def main():
    with tempfile.TemporaryDirectory() as home:
        with open(os.path.join(home, "counts.dol"), "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        server = subprocess.Popen([DOLPHIN, "console", home, "--port", "0", "--no-browser"], stdout=subprocess.PIPE,
                                  env={**os.environ, "XDG_STATE_HOME": os.path.join(home, "state")}, text=True)
        try:
            port = int(server.stdout.readline().rsplit(":", 1)[1].strip(" /\n"))
            ask(port, "run", {"program": "counts.dol", "speed": 1})
            watchers = [Watcher(port, n) for n in range(WATCHERS)]
            while not ask(port, "status")["run"]["time"] > 0:
                time.sleep(0.05)
            print(f"{WATCHERS} watchers, from a post to its event: {latencies(port, watchers[0], 0)}")
            cpu, rss, files = process_figures(server.pid)
            began = time.monotonic()
            time.sleep(5)
            later = process_figures(server.pid)[0]
            print(f"at rest: {100 * (later - cpu) / (time.monotonic() - began):.1f}% of a core, {rss:.0f} MB, {files} files")
            began = time.monotonic()
            refused = nonsense(port)
            print(f"{NONSENSE} malformed requests: {refused} refused, none done, {time.monotonic() - began:.0f} s")
            connections = idle(port)
            print(f"{len(connections)} idle connections: the run is {ask_until(port)}")
            for sock in connections:
                sock.close()
            time.sleep(1)
            print(f"afterwards: {latencies(port, watchers[0], POSTS)}")
            _, rss, files = process_figures(server.pid)
            print(f"afterwards: {rss:.0f} MB, {files} files")
            time.sleep(2)
            missed = [w.count for w in watchers if w.count != 2 * POSTS]
            print(f"watchers that missed an event: {len(missed)}")
            ask(port, "run/stop", {})
            load(server.pid, port, home)
        finally:
            server.terminate()
            server.wait(20)


SPEED, SECONDS = 20, 180


def load(pid, port, home):
    """100 vehicles under way for an hour, each with 4 positions a second as time passes here, with all watchers."""
    while ask(port, "status")["run"]["state"] != "over":
        time.sleep(0.05)
    with open(os.path.join(home, "many.fleet"), "w", encoding="utf-8") as file:
        file.writelines(f"vehicle 'v{n}', {{ type 'UUV' }}\n" for n in range(100))
        file.write("plan 'p', { duration 4.hours }\n")
    with open(os.path.join(home, "many.dol"), "w", encoding="utf-8") as file:
        file.write("pick { count 100 }\nexecute " + " | ".join(["task('p')"] * 100) + "\n")
    ask(port, "run", {"program": "many.dol", "speed": SPEED})
    while len(ask(port, "world?program=many.dol")["vehicles"]) != 100 or ask(port, "status")["run"]["time"] < 30:
        time.sleep(0.2)
    runs = os.path.join(home, "state", "dolphin", "runs")
    journal = os.path.join(runs, next(name for name in os.listdir(runs) if name.endswith("many.run")))
    (cpu, _, _), began, lines, sizes = process_figures(pid), time.monotonic(), count(journal), []
    while time.monotonic() - began < SECONDS:
        time.sleep(SECONDS / 6)
        sizes.append(process_figures(pid)[1])
    later, passed = process_figures(pid)[0], time.monotonic() - began
    print(f"100 vehicles, {WATCHERS} watchers, an hour in {passed:.0f} s: {100 * (later - cpu) / passed:.0f}% of a core, "
          f"{(count(journal) - lines) / passed:.0f} lines of the journal a second, "
          f"MB: {', '.join(f'{size:.0f}' for size in sizes)}")


def count(path):
    with open(path, "rb") as file:
        return sum(1 for _ in file)


def ask_until(port):
    """The progress of the run, once connections are accepted again: idle connections are closed after a while."""
    for _ in range(90):
        try:
            return ask(port, "status")["run"]["state"]
        except OSError:
            time.sleep(1)
    return "out of reach"


main()
