# Signals to `dolphin exec --runs` with endless runs: its output, and that its processes end with it.
import re
import signal
import subprocess

from processes import PATIENCE, children, is_gone, until

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
