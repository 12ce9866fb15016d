#!/usr/bin/env python3
"""An adapter for one rover: the platform protocol (docs/platform.md) with the standard library alone.

Put your vehicle where the class Rover is. Try it: dolphin platform check examples/adapter.py"""

import json
import sys
import threading


class Rover:
    """A vehicle that knows two plans by name, and only waits while it runs one."""

    name, plans = "rover-1", {"short": 0.5, "long": 60}
    timer = threading.Timer(0, None)

    def drive(self, plan, at_the_end):
        self.timer = threading.Timer(self.plans[plan], at_the_end)
        self.timer.daemon = True
        self.timer.start()

    def halt(self):
        self.timer.cancel()


rover, lock = Rover(), threading.RLock()
ENDS = ("done", "failed", "stopped")
said = {}  # by request: what was reported of it last
running = None  # the request that the rover runs


def report(kind, **members):
    with lock:
        print(json.dumps({"kind": kind, **members}), flush=True)


def show():
    report("vehicle", vehicle=rover.name, type="UGV", latitude=41.185, longitude=-8.706, link=True)


def say(request, kind, **members):
    """Reports on a request; after its end the rover is free, and no further report follows."""
    global running
    with lock:
        if said.get(request, {}).get("kind") in ENDS:
            return
        if kind != "taken" and running == request:
            running = None
        said[request] = {"kind": kind, **members}
        report(kind, request=request, **members)


def problems(plan):
    if "language" in plan:
        return [f"plans in the language {plan['language']} are not for a rover"]
    return [] if plan["name"] in rover.plans else [f"undefined plan '{plan['name']}'"]


def start(request, vehicle, plan):
    global running
    if request in said:  # a start that comes twice is one start
        report(request=request, **said[request])
    elif vehicle != rover.name or problems(plan):
        say(request, "failed", why="; ".join(problems(plan)) or f"there is no vehicle {vehicle}")
    else:
        if running:  # Dolphin has given up waiting for its stop
            stop(running)
        running = request
        say(request, "taken")
        rover.drive(plan["name"], lambda: say(request, "done"))


def stop(request):
    if said.get(request, {}).get("kind") in ENDS:
        report(request=request, **said[request])
    else:  # running, or in an unknown state: stopped now
        if running == request:
            rover.halt()
        say(request, "stopped")


for line in sys.stdin:
    order = json.loads(line)
    with lock:
        kind, request = order["kind"], order.get("request")
        if kind == "hello":
            report("hello", protocol=1, name="rover", plans=["name"], announce=1, patience=5)
            show()
        elif kind == "refused":  # a line of ours was refused: report again all that it may have contained
            show()
        elif kind == "ping":
            report("pong", id=order["id"])
        elif kind == "start":
            start(request, order["vehicle"], order["plan"])
        elif kind == "stop":
            stop(request)
        elif kind == "resume":  # this rover stops when its adapter dies, and has no memory
            say(request, "unknown", why="the rover was switched off") if request not in said else report(
                request=request, **said[request])
        elif kind == "check":
            report("checked", id=order["id"], problems=problems(order["plan"]))
        elif kind == "close":
            if running:
                stop(running)
            report("quiet")
            break
