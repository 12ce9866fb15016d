# Signals to `dolphin exec --runs` while its runs go on for ever: what it says, and that its processes end with it.
import re
import signal
import subprocess
import sys
import time

PATIENCE = 60


def until(what, condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            sys.exit("in vain: " + what)
        time.sleep(0.02)


def children(pid):
    try:
        with open(f"/proc/{pid}/task/{pid}/children") as file:
            return [int(child) for child in file.read().split()]
    except OSError:
        return []


# A zombie is gone, whether or not anybody has asked how it ended.
def is_gone(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True


def end_by(number, command):
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    until("two processes", lambda: len(children(process.pid)) == 2)
    processes = children(process.pid)
    process.send_signal(number)
    output, _ = process.communicate(timeout=PATIENCE)
    until("the end of all processes", lambda: all(is_gone(child) for child in processes))
    lines = [re.sub(r", [0-9.]* s$", "", line) for line in output.splitlines()]
    print(signal.Signals(number).name, process.returncode, lines)


command = ["dolphin", "exec", "endless.dol", "--runs", "10", "--jobs", "2"]
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
    end_by(number, command)
