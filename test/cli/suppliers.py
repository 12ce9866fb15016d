"""Suppliers that misbehave, each in its own way, selected by the first argument."""
import json
import os
import signal
import sys
import time

how = sys.argv[1]
if how == "dies at once":
    sys.exit(3)


if how == "stays":
    for ignored in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        signal.signal(ignored, signal.SIG_IGN)
    with open("supplier.pid", "w") as file:
        file.write(str(os.getpid()))


def reply(request, value):
    print(json.dumps({"id": request["id"], "value": value}), flush=True)


for number, line in enumerate(sys.stdin):
    request = json.loads(line)
    if number == 0:
        reply(request, {"object": "supplier"})
    elif how == "dies":
        sys.exit(4)
    elif how == "hangs":
        time.sleep(600)
    elif how == "talks nonsense":
        print("all is well", flush=True)
    elif how == "mixes up requests":
        request["id"] += 7
        reply(request, True)
    elif how == "refuses":
        print(json.dumps({"id": request["id"], "error": "the queue is closed"}), flush=True)
    elif how == "hangs later":
        if request.get("call") == "await":
            time.sleep(600)
        reply(request, True if request.get("call") == "active" else {"object": "queue"})
    elif how == "echoes":
        arguments = request.get("arguments", [])
        reply(request, arguments[0] if arguments else {"object": "supplier"})

if how == "stays":
    time.sleep(600)
