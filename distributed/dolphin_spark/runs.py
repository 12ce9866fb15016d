"""Simulated runs, made in parts."""

import subprocess

from . import files


def parts(seed, runs, size):
    """(first seed, number) of each part, in order."""
    return [(first, min(size, seed + runs - first)) for first in range(seed, seed + runs, size)]


def made(command, part):
    """The lines of the runs of a part, as `dolphin exec --each` prints them."""
    seed, runs = part
    options = ["--runs=%d" % runs, "--seed=%d" % seed, "--jobs=1", "--each"]
    return subprocess.run(command + options, stdout=subprocess.PIPE, check=True).stdout


def maker(job):
    """A function for the machines, from a part to its lines."""
    return lambda part: made(files.command_line(job, "exec"), part)
