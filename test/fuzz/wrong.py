#!/usr/bin/env python3
"""A wrong reader: stands in for Dolphin, and does what the environment variable WRONG names."""

import os
import signal
import sys
import time


def need_memory():
    try:
        bytearray(2 << 30)
    except MemoryError:
        sys.exit("out of memory")


WRONG = {
    "utf-8": lambda: sys.stderr.buffer.write(b"unexpected '\xff'\n"),
    "control": lambda: sys.stderr.write("unexpected '\x1b[2J'\n"),
    "c1": lambda: sys.stderr.write("unexpected '\x9b2J'\n"),
    "direction": lambda: sys.stderr.write("unexpected '\u202e'\n"),
    "json": lambda: sys.stdout.write('{"battery": NaN}\n'),
    "infinite": lambda: sys.stdout.write('{"height": 1e999}\n'),
    "bug": lambda: sys.exit(125),
    "signal": lambda: os.kill(os.getpid(), signal.SIGSEGV),
    "busy": lambda: all(iter(lambda: True, False)),
    "asleep": lambda: time.sleep(3600),
    "memory": need_memory,
    "none": lambda: None,
}
WRONG[os.environ["WRONG"]]()
