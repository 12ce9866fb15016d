"""Gives the transitions of a journal the numbers that they would have."""
import re
import sys

number = 0
for line in sys.stdin:
    if line.startswith('{"kind":"transition"'):
        line = re.sub(r'"i":\d+', '"i":%d' % number, line, count=1)
        number += 1
    sys.stdout.write(line)
