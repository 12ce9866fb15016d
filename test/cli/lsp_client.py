"""A client of the language server: sends the requests that it reads, one JSON a line, and prints what comes back."""

import json
import subprocess
import sys

server = subprocess.Popen(["dolphin", "lsp", "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def send(text):
    data = text.encode()
    server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
    server.stdin.flush()


def receive():
    length = 0
    while True:
        line = server.stdout.readline().strip()
        if not line:
            break
        name, value = line.split(b":")
        if name.lower() == b"content-length":
            length = int(value)
    return json.loads(server.stdout.read(length)) if length else None


def place(range):
    return "{}:{}-{}:{}".format(
        range["start"]["line"], range["start"]["character"], range["end"]["line"], range["end"]["character"]
    )


def with_places(json):
    """Ranges in one word."""
    if isinstance(json, list):
        return [with_places(item) for item in json]
    if isinstance(json, dict):
        if set(json) == {"start", "end"}:
            return place(json)
        return {key: with_places(value) for key, value in json.items()}
    return json


def short(message):
    """The message without uninformative parts: ids, versions and the long lists of completion."""
    if message is None:
        return "nothing"
    if "method" in message:
        found = message["params"]["diagnostics"]
        uri = message["params"]["uri"].rsplit("/", 1)[-1]
        return "\n  ".join(["diagnostics of " + uri] + [place(d["range"]) + " " + d["message"] for d in found])
    if "error" in message:
        return "error {code}: {message}".format(**message["error"])
    result = message["result"]
    if isinstance(result, dict) and "capabilities" in result:
        return "capabilities " + " ".join(sorted(result["capabilities"]))
    if isinstance(result, list) and result and "label" in result[0]:
        return "names " + " ".join(item["label"] for item in result)
    return json.dumps(with_places(result))


for line in sys.stdin:
    line = line.strip()
    if not line or line.startswith("#"):
        continue
    answers = 0
    if line.startswith("{"):
        message = json.loads(line)
        message["jsonrpc"] = "2.0"
        # Each open or changed document gets its diagnostics, and each request its answer.
        answers = 1 if "id" in message or message["method"].startswith("textDocument/did") else 0
        send(json.dumps(message))
    else:
        send(line)
        answers = 1
    for _ in range(answers):
        print(short(receive()))
server.stdin.close()
server.wait()
if server.returncode != 0:
    print("status", server.returncode)
