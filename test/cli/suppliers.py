"""Suppliers that misbehave, each in its own way: the first argument says how."""
import json
import os
import sys
import time

how = sys.argv[1]
if how == "dies at once":
    sys.exit(3)


def reply(request, value):
    print(json.dumps({"id": request["id"], "value": value}), flush=True)


for number, line in enumerate(sys.stdin):
    request = json.loads(line)
    if number == 0:
        reply(request, {"object": "supplier"})
    elif how == "dies":
        os.abort() if "core" in sys.argv else sys.exit(4)
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
        reply(request, {"active": True, "queue": {"object": "queue"}}.get(request.get("call") or request.get("get")))
        if request.get("call") == "await":
            time.sleep(600)
    elif how == "echoes":
        arguments = request.get("arguments", [])
        reply(request, arguments[0] if arguments else {"object": "supplier"})
