#!/usr/bin/env python3
"""A run on a console from a program: starts it, watches it, posts to it, stops it. docs/api.md describes the interface.

Usage: client.py [PROGRAM [PAIRS]]     as: client.py abort.dol 'abort: true'
"""

import json
import sys
import urllib.request

CONSOLE = "http://127.0.0.1:8642/api/"
NAME = "client.py"


def ask(path, body=None):
    data = None if body is None else json.dumps(body).encode()
    headers = {"Content-Type": "application/json", "X-Dolphin-Client": NAME}
    return urllib.request.urlopen(urllib.request.Request(CONSOLE + path, data, headers))


def events():
    kind = ""
    for line in ask("events?client=" + NAME):
        name, _, text = line.decode().rstrip("\n").partition(": ")
        if name == "event":
            kind = text
        elif name == "data":
            yield kind, json.loads(text)


def main(program="rendezvous.dol", pairs=None):
    watched = events()
    next(watched)
    run = json.load(ask("run", {"program": program, "speed": None if pairs is None else 60}))["run"]
    shown = None
    for kind, data in watched:
        if kind == "run":
            shown = data["id"]
        if shown != run:
            continue
        if kind == "log":
            print(data["text"])
        if pairs and kind == "waiting" and data["for"]:
            ask("run/post", {"pairs": pairs})
            pairs = None
        if kind == "status" and data["run"]["state"] == "over":
            print(data["run"]["outcome"]["text"])
            break
    ask("helm", {"want": "give-up"})


if __name__ == "__main__":
    main(*sys.argv[1:])
