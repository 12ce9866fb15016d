"""An adapter with a fault to order: a filter around a good one.

Usage: faulty.py FAULT COMMAND"""
import json
import os
import subprocess
import sys
import threading

FAULT, COMMAND = sys.argv[1:]
base = subprocess.Popen(COMMAND, shell=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
lock = threading.RLock()
vehicle_of, ended, resumed = {}, set(), set()  # of requests
starts, sights = 0, 0
just_started = None  # the request of the order before this one, if it was a start


def tell(**report):
    with lock:
        print(json.dumps(report), flush=True)


def pass_on(order):
    base.stdin.write((json.dumps(order) + "\n").encode())
    base.stdin.flush()


def running():
    return set(vehicle_of) - ended


def on_order(order):
    """Whether the order is kept from the good adapter."""
    global starts, just_started
    kind, request = order["kind"], order.get("request")
    before, just_started = just_started, request if kind == "start" else None
    if FAULT == "fragile" and kind == "dance":
        os._exit(1)
    if FAULT == "deaf" and kind == "ping" and running():
        return True
    if kind == "start":
        starts += 1
        if FAULT == "busy" and starts == 2:
            tell(kind="failed", request=request, why="busy")
            return True
        if FAULT == "starts again" and request in vehicle_of:
            tell(kind="failed", request=request, why="runs another plan")
            return True
        if FAULT == "one at a time" and running():
            return True
        vehicle_of[request] = order["vehicle"]
    if FAULT == "says all once" and kind == "refused":
        return True
    if kind == "stop":
        if FAULT == "no stop":
            return True
        if FAULT == "ignores strangers" and request not in vehicle_of:
            return True
        if FAULT == "stops too early" and request == before:
            return True
    if kind == "resume":
        if FAULT == "forgetful":
            tell(kind="absent", request=request)
            return True
        if FAULT == "trusts notes" and not order["notes"]:
            tell(kind="absent", request=request)
            return True
        if FAULT == "wavering" and request in resumed:
            tell(kind="unknown", request=request, why="it depends")
            return True
        resumed.add(request)
    return False


def on_report(report):
    """The lines in place of a report."""
    global sights
    kind, request = report["kind"], report.get("request")
    if kind in ("done", "failed", "stopped"):
        ended.add(request)
    if FAULT == "mute" and kind == "hello" or FAULT == "never quiet" and kind == "quiet":
        return []
    if FAULT == "prints" and kind == "taken":
        print("armed, waiting for the link", flush=True)
    if FAULT == "dies" and kind == "taken" and not os.path.exists("died"):
        open("died", "w").close()
        os._exit(4)
    if FAULT == "half a place" and kind == "vehicle":
        if sights == 1:
            del report["longitude"]
        sights += 1
    if FAULT == "typeless" and kind == "vehicle":
        del report["type"]
    if FAULT == "doubled ends" and kind == "done":
        return [report, report]
    if FAULT == "refuses without words" and kind == "failed":
        report["why"] = " "
    if FAULT == "yes-man" and kind == "checked":
        report["problems"] = []
    if FAULT == "loses lines" and kind == "pong" and report["id"] % 1000 == 0:
        return []
    if FAULT == "forgets ends" and kind == "done" and request in resumed:
        return [{"kind": "absent", "request": request}]
    if FAULT == "boaster" and kind == "absent":
        return [{"kind": "done", "request": request}]
    return [report]


def reports():
    for line in base.stdout:
        with lock:
            for report in on_report(json.loads(line)):
                tell(**report)
    os._exit(0)


if FAULT == "chatty":
    print("connecting ...", flush=True)
threading.Thread(target=reports, daemon=True).start()
for line in sys.stdin:
    with lock:
        if not on_order(json.loads(line)):
            pass_on(json.loads(line))
if FAULT == "stops at the end of input":
    for request in running():
        pass_on({"kind": "stop", "request": request, "vehicle": vehicle_of[request]})
if FAULT == "lingers":
    threading.Event().wait()
base.stdin.close()
base.wait()
