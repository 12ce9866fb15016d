#!/usr/bin/env python3
# A supplier: answers each request, a line of JSON, with a line of JSON.
import json, sys

tasks = ["photograph_pier", "look_for_oil", "follow_coast"]
for line in sys.stdin:
    request = json.loads(line)
    values = {
        "getSupplier": lambda: {"object": "supplier"},
        "active": lambda: len(tasks) > 0,
        "queue": lambda: {"object": "queue"},
        "await": lambda: {"task": tasks.pop(0)},
    }
    value = values[request.get("call") or request.get("get")]()
    print(json.dumps({"id": request["id"], "value": value}), flush=True)
