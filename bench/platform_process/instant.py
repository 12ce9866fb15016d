"""An adapter whose vehicle is done with each plan at once."""
import json
import sys


def report(**members):
    sys.stdout.write(json.dumps(members) + "\n")
    sys.stdout.flush()


for line in sys.stdin:
    order = json.loads(line)
    if order["kind"] == "hello":
        report(kind="hello", protocol=1, name="instant", announce=1)
        report(kind="vehicle", vehicle="v", type="UUV", latitude=41, longitude=-8, link=True)
    elif order["kind"] == "start":
        report(kind="done", request=order["request"])
    elif order["kind"] == "close":
        report(kind="quiet")
        break
