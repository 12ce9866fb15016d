# time_workers.py NUMBER ARGUMENT...: signals to `dolphin time` while it, and as many processes as it makes then, search
# for very long; and one to one of these: its output, its exit status, and that no process is left.
import signal
import subprocess
import sys

from processes import PATIENCE, children, is_gone, is_program, until


def end_by(number, command, number_of_others, whom):
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    until("other processes", lambda: is_program(process.pid) and len(children(process.pid)) == number_of_others)
    others = children(process.pid)
    subprocess.run(["kill", f"-{number.value}", str(process.pid if whom == "leader" else others[0])])
    output, _ = process.communicate(timeout=PATIENCE)
    until("the end of all processes", lambda: all(is_gone(child) for child in others))
    said = [line.split(";")[0] for line in output.splitlines() if "inconclusive" in line]
    print(number.name, "to the", whom, process.returncode, said)


number_of_others = int(sys.argv[1])
command = ["dolphin", "time"] + sys.argv[2:]
for number, whom in [
    (signal.SIGINT, "leader"),
    (signal.SIGTERM, "leader"),
    (signal.SIGKILL, "leader"),
    (signal.SIGKILL, "worker"),
]:
    end_by(number, command, number_of_others, whom)
