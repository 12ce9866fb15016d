"""Kills the console, or the adapter, of a mission at many points, and looks whether anything is doubled or lost.

Usage: kills.py console|adapter|journal POINTS

The mission runs on a simulated fleet that outlives its adapter. It is killed once its journal has n lines, for POINTS
values of n, and a little later. After that a console resumes the run (or the adapter is started again), and
- the mission completes, and its journal is one of a run of the program,
- by the fleet's own file each plan was started once.
With "journal" the console is killed, and the journal loses its end: the last note or two on requests.
On failure the journal and the fleet's file of that point are kept, and named."""
import glob
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

WHO, POINTS = sys.argv[1], int(sys.argv[2])
SEED = int(os.environ.get("DOLPHIN_SEED", "1"))
PLANS = [f"{side}{n}" for side in "ab" for n in range(1, 5)]
PROGRAM = """v = pick { id 'auv-1' }
w = pick { id 'auv-2' }
execute v: imcPlan('a1') >> imcPlan('a2') >> imcPlan('a3') >> imcPlan('a4'),
        w: imcPlan('b1') >> imcPlan('b2') >> imcPlan('b3') >> imcPlan('b4')
"""
FLEET = "vehicle 'auv-1', { type 'UUV' }\nvehicle 'auv-2', { type 'UUV' }\n" + "".join(
    f"plan '{plan}', {{ duration 4.seconds }}\n" for plan in PLANS)
LINES = 36  # of the journal of this mission, about


def lines(path):
    try:
        with open(path, "rb") as file:
            return file.read().count(b"\n")
    except FileNotFoundError:
        return 0


def wait_for(condition, process, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        if condition():
            return True
        time.sleep(0.002)
    return False


def lose(path, count):
    """The last `count` notes on orders are lost, with the lines after them: as far as those are no transitions."""
    with open(path, encoding="utf-8") as file:
        kept = [line for line in file if line.endswith("\n")]
    for n in range(len(kept) - 1, 0, -1):
        line = json.loads(kept[n])
        if count == 0 or line["kind"] not in ("platform", "vehicle"):
            break
        if "asked" in line.get("note", {}):
            kept, count = kept[:n], count - 1
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(kept)


class Mission:
    def __init__(self, folder):
        self.folder = folder
        self.journal, self.state = (os.path.join(folder, name) for name in ("mission.run", "fleet.state"))
        self.pid = os.path.join(folder, "adapter.pid")
        for name, text in (("m.dol", PROGRAM), ("m.fleet", FLEET)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)

    def console(self, *more):
        adapter = "echo $$ > adapter.pid; exec dolphin sim m.fleet --platform --state fleet.state --speed 20"
        with open(os.path.join(self.folder, "log"), "a", encoding="utf-8") as log:
            return subprocess.Popen(["dolphin", "exec", "m.dol", "--platform", adapter, *more], cwd=self.folder,
                                    stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def kill_adapter(self):
        with open(self.pid, encoding="utf-8") as file:
            os.kill(int(file.read()), signal.SIGKILL)

    def is_over(self):
        with open(self.journal, "rb") as file:
            return b'"kind":"end"' in file.read()

    def verdict(self, status):
        if status != 0:
            return f"the console ended with status {status}"
        check = subprocess.run(["dolphin", "trace", "check", "m.dol", "mission.run"], cwd=self.folder,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if check.returncode != 0 or "; completed" not in check.stdout:
            return "the journal: " + check.stdout
        with open(self.state, encoding="utf-8") as file:
            orders = [json.loads(line).get("order", {}) for line in file]
        started = sorted(order["plan"]["name"] for order in orders if order.get("kind") == "start")
        return None if started == PLANS else f"these were started: {' '.join(started)}"


def is_open(path):
    """Whether some process has the file open, by /proc."""
    wanted = os.path.realpath(path)
    for descriptor in glob.iglob("/proc/[0-9]*/fd/*"):
        try:
            if os.readlink(descriptor) == wanted:
                return True
        except OSError:
            pass
    return False


def trial(folder, n, delay):
    mission = Mission(folder)
    console = mission.console("--journal", "mission.run")
    if not wait_for(lambda: lines(mission.journal) >= n, console):
        return mission.verdict(console.wait(timeout=60))
    time.sleep(delay)
    if WHO in ("console", "journal"):
        console.kill()
        console.wait()
        if mission.is_over():
            return mission.verdict(0)
        for _ in range(20):  # the adapter that has lost its console may still write the fleet's file
            if not is_open(mission.state):
                break
            time.sleep(0.05)
        if WHO == "journal":
            lose(mission.journal, 1 + n % 2)
        console = mission.console("--resume", "mission.run")
    elif os.path.exists(mission.pid):
        mission.kill_adapter()
    try:
        return mission.verdict(console.wait(timeout=60))
    except subprocess.TimeoutExpired:
        console.kill()
        return "the console did not end within 60 s"


def main():
    chance = random.Random(SEED)
    bad = 0
    for point in range(POINTS):
        n = 1 + point * (LINES - 2) // max(1, POINTS - 1)
        delay = chance.choice([0, 0, 0.002, 0.02, 0.1])
        folder = tempfile.mkdtemp(prefix=f"dolphin-kill-{WHO}-")
        wrong = trial(folder, n, delay)
        if wrong is None:
            shutil.rmtree(folder)
        else:
            bad += 1
            print(f"killed at line {n}, {delay} s later: {wrong} ({folder})", flush=True)
    print(f"{POINTS - bad} of {POINTS} missions went well")
    return bad > 0


sys.exit(main())
