# Processes that a command makes: to wait for them, and for their ends.
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


# Before it is a program, it is the script that starts it.
def is_program(pid):
    try:
        with open(f"/proc/{pid}/comm") as file:
            return file.read() == "dolphin.exe\n"
    except OSError:
        return False


# A zombie is gone, whether or not anybody has asked how it ended.
def is_gone(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True
