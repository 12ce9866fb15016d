#!/usr/bin/env python3
"""growth.py DOLPHIN: the work of a command, counted in words that it allocates, grows with a mission and not faster.

Counts do not depend on the machine nor on its load. A linear part allocates four times as much for four times the
size, a quadratic one up to sixteen times. `bench/run` has the times of the same missions."""

import os
import re
import subprocess
import sys
import tempfile

import sizes

DOLPHIN = os.path.abspath(sys.argv[1])
MOST = 6  # times the words, for four times the size
FORTH = 4


def words(mission, *size):
    """The words that the command allocates, its processes together."""
    ended = subprocess.run([DOLPHIN, *mission(DOLPHIN, *size)], env={**os.environ, "OCAMLRUNPARAM": "v=0x400"},
                           stdin=subprocess.DEVNULL, capture_output=True, text=True)
    counts = re.findall(r"allocated_words: (\d+)", ended.stderr)
    if ended.returncode != 0 or not counts:
        sys.exit(f"{mission.__name__} {size} ends with {ended.returncode}: {ended.stderr}")
    return sum(map(int, counts))


def ratio_of_inputs(pairs, posted):
    """How much more the same inputs cost where N has four times the pairs."""
    few, many = (words(sizes.inputs, n, posted) - words(sizes.inputs, n, 0) for n in (pairs, FORTH * pairs))
    return many / few


def ratio(mission, size):
    return words(mission, FORTH * size) / words(mission, size)


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for what, found, most in [
                ("an input, by pairs of N", ratio_of_inputs(1_000, 400), 2),
                ("declared inputs, by their number", ratio(sizes.declared, 4_000), MOST),
                ("a picture, by its bars", ratio(sizes.picture, 2_000), MOST),
                ("areas beside a plan, by their corners", ratio(sizes.areas, 6_000), MOST),
                # Those of the process that collects the runs: they vary with the number of its looks, so its limit
                # is wider, and still below the ratio of quadratic work.
                ("simulated runs, by their number", ratio(sizes.runs, 8_000), 10)]:
            is_right = 0 < found <= most
            failures += not is_right
            print(f"{'ok' if is_right else 'FAILED'}: {what}: {found:.1f} times the words, at most {most}")
        os.chdir("/")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
