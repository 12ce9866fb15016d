"""`dolphin console` as a reader: requests over HTTP, and the files of its folder, maps as tiles among them."""

import json
import os
import re
import socket
import sqlite3
import time
import urllib.parse

import mutate
from readers import KML, write
from verdict import Running, bad_json, judge

READY = 30  # seconds until the server listens, on a loaded machine
STREAM = 0.3  # seconds for which events are read
ENDLESS = """WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)
SELECT i AS zoom_level, i AS tile_column, i AS tile_row, zeroblob(100) AS tile_data FROM n"""
PNG = b"\x89PNG\r\n\x1a\n" + bytes(20)
TEXT = "v = pick { type 'UUV' }\nexecute task('survey')[v]\nmessage v\n"


def requests_of(path):
    """Valid requests: verb, path, query, body; `path` is that of a program in the folder."""
    document = {"path": path, "text": TEXT}
    at = {**document, "at": 5}
    run = {"program": path, "fleet": "m.fleet", "speed": None, "seed": 1, "answers": ["1", "true"], "set": {},
           "people": False}
    return [
        ("GET", "status", {}, None), ("GET", "files", {}, None), ("GET", "runs", {}, None),
        ("GET", "events", {"client": "fuzz", "last": "1"}, None), ("GET", "file", {"path": path}, None),
        ("PUT", "file", {}, {"path": "saved.dol", "text": TEXT}), ("GET", "layer", {"path": "a.kml"}, None),
        ("GET", "layer", {"path": "a.mbtiles"}, None), ("GET", "layer", {"path": "a.geojson"}, None),
        ("GET", "tile", {"path": "a.mbtiles", "zoom": "1", "column": "0", "row": "1"}, None),
        ("POST", "check", {}, document), ("POST", "format", {}, document), ("POST", "complete", {}, at),
        ("POST", "hover", {}, at), ("POST", "signature", {}, at), ("POST", "definition", {}, at),
        ("GET", "world", {"program": path, "fleet": "m.fleet"}, None),
        ("POST", "plans", {}, {"program": path, "set": {}}),
        ("POST", "exploration", {}, {"program": path, "faults": "fail=1", "seconds": 2}),
        ("GET", "exploration", {}, None),
        ("POST", "timing", {}, {"program": path, "deadline": "1.minute", "seconds": 2}), ("GET", "timing", {}, None),
        ("POST", "graph", {}, {"program": path, "states": 100}), ("GET", "graph", {}, None),
        ("POST", "replacement", {}, {"program": path, "faults": "fail=1", "seconds": 2}), ("GET", "replacement", {}, None),
        ("POST", "run/differences", {}, {"program": path, "set": {"n": "2"}}),
        ("POST", "run/replace", {}, {"program": path, "hash": "d41d8cd98f00b204e9800998ecf8427e", "set": {}}),
        ("DELETE", "exploration", {}, {}), ("POST", "run", {}, run),
        ("POST", "run/answer", {}, {"question": 1, "text": "1"}),
        ("POST", "run/post", {}, {"key": "over", "value": True}), ("POST", "run/post", {}, {"pairs": "over: [1, 2.5]"}),
        ("POST", "run/stop", {}, {"all": True}), ("POST", "run/counterexample", {}, {"of": "exploration", "speed": 2}),
        ("POST", "run/resume", {}, {"run": "j.run"}), ("GET", "replay", {"path": "j.run"}, None),
        ("GET", "notes", {"path": "j.run"}, None),
        ("POST", "notes", {}, {"path": "j.run", "time": 1.5, "text": "here"}),
        ("POST", "helm", {}, {"want": "take"})]


def packed(verb, path, query, body):
    """The bytes of a request."""
    target = f"/api/{path}" + ("?" + urllib.parse.urlencode(query, errors="surrogateescape") if query else "")
    head = f"{verb} {target} HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Dolphin-Client: fuzz\r\n"
    if body is not None:
        head += f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n"
    return head.encode() + b"\r\n" + (body or b"")


def mutated(random, request, others):
    verb, path, query, body = request
    data = None if body is None else json.dumps(body).encode()
    kind = random.randrange(4)
    if kind == 0:
        return mutate.text(random, packed(verb, path, query, data), others)
    if kind == 1 and query:
        key = random.choice(list(query))
        value = mutate.text(random, query[key].encode(), others)[:2000].decode(errors="surrogateescape")
        return packed(verb, path, {**query, key: value}, data)
    return packed(verb, path, query, data and mutate.json_text(random, data, others))


class Server:
    """A console that serves `folder` on a port of its own."""

    def __init__(self, bench, folder):
        self.running = Running([bench.dolphin, "console", "--no-browser", "--port", "0", "."], folder, bench.seconds)
        self.port, self.patience = None, 3 * bench.seconds
        until = time.monotonic() + READY
        while self.port is None and self.running.process.poll() is None and time.monotonic() < until:
            line = os.pread(self.running.files[1].fileno(), 10_000, 0)
            if b"http://127.0.0.1:" in line and b"/\n" in line:
                self.port = int(line.split(b"http://127.0.0.1:")[1].split(b"/")[0])
            time.sleep(0.01)

    def ask(self, request, is_stream=False):
        """The reply, as soon as all of it is there; of a stream, its first part."""
        reply, until = b"", time.monotonic() + (STREAM if is_stream else self.patience)
        try:
            with socket.create_connection(("127.0.0.1", self.port), timeout=2) as client:
                client.sendall(request.replace(b"Host: 127.0.0.1\r\n", b"Host: 127.0.0.1:%d\r\n" % self.port))
                client.shutdown(socket.SHUT_WR)
                while (left := until - time.monotonic()) > 0:
                    client.settimeout(left)
                    data = client.recv(65536)
                    if not data:
                        return reply
                    reply += data
        except TimeoutError:
            return reply if is_stream or b"text/event-stream" in reply else None
        except OSError:
            pass  # the server has closed it
        return reply


def bad_reply(reply):
    """The fault of a reply of the server; None if it has none, or if the request was cut off and has no reply."""
    if reply is None:
        return "no reply"
    head, _, body = reply.partition(b"\r\n\r\n")
    if not head:
        return None
    if not head.startswith(b"HTTP/1.1 "):
        return f"not a reply: {head[:60]!r}"
    if head.startswith(b"HTTP/1.1 500"):
        return f"an error in the server: {body[:200]!r}"
    if b"worker-died" in body or b"too-long" in body:
        return body.decode(errors="replace")
    lowered = head.lower()
    if b"content-type: text/event-stream" in lowered:
        lines = body[:body.rfind(b"\n") + 1].split(b"\n")
        texts = [line[6:] for line in lines if line.startswith(b"data: ")]
    elif b"content-type: application/json" in lowered:
        length = re.search(rb"content-length: (\d+)", lowered)
        texts = [body[:int(length.group(1))] if length else body]  # a mutated request may be several
    else:
        return None
    try:
        return next((why for text in texts if text and (why := bad_json(text.decode()))), None)
    except UnicodeDecodeError as error:
        return f"invalid UTF-8: {error}"


def judged(bench, folder, requests):
    """The fault of a console of `folder`: in its replies to requests, or to one more, a valid one; or None."""
    (folder / "command").write_text("dolphin console --no-browser --port 0 .\n")
    server = Server(bench, folder)
    why = None
    if server.port is not None:
        for i, request in enumerate(requests):
            (folder / f"request-{i}").write_bytes(request)
            reply = server.ask(request, b"/events" in request or b"/replay" in request)
            (folder / f"reply-{i}").write_bytes(reply or b"")
            why = why or (bad := bad_reply(reply)) and f"request-{i}: {bad}"
        last = server.ask(packed("GET", "status", {}, None))
        why = why or bad_reply(last) or (None if last.startswith(b"HTTP/1.1 200") else f"status: {last[:100]!r}")
    ended = server.running.end(interrupt_after=0.1)
    (folder / "stdout").write_bytes(ended.out)
    (folder / "stderr").write_bytes(ended.err)
    return judge(ended, "text") or why or (None if server.port else "does not listen")


def tiles(random, path):
    """A map as tiles, MBTiles, mutated as a database or as bytes."""
    path.unlink(missing_ok=True)
    database = sqlite3.connect(path)
    view = random.choice(["", "", "", ENDLESS])
    if view:
        database.execute(f"CREATE VIEW tiles AS {view}")
    else:
        database.execute(
            "CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)")
        database.execute("CREATE UNIQUE INDEX tile_index ON tiles (zoom_level, tile_column, tile_row)")
        for column in range(2):
            data = random.choice(
                [PNG, b"\xff\xd8\xff\xe0", b"", PNG * 100_000, "text", None, 1.5, mutate.text(random, PNG, [KML])])
            row = random.choice([0, 1, 2 ** 62, -1])
            database.execute("INSERT INTO tiles VALUES (?, ?, ?, ?)", (1, column, row, data))
    database.execute("CREATE TABLE metadata (name text, value text)")
    known = {"minzoom": b"0", "maxzoom": b"3", "bounds": b"-9,41,-8.5,42", "attribution": b"us", "format": b"png"}
    for name, value in known.items():
        mutation = value if random.random() < 0.6 else mutate.text(random, value, list(known.values()))[:100_000]
        database.execute("INSERT INTO metadata VALUES (?, CAST(? AS TEXT))", (name, mutation))
    database.commit()
    database.close()
    if random.random() < 0.5:
        path.write_bytes(mutate.text(random, path.read_bytes(), [KML]))


def lay_out(bench, random, folder):
    """A folder with files of all kinds; the parts of it that are valid."""
    program, journal = random.choice(bench.journals)
    write(folder, m_dol=TEXT.encode(), m_fleet=b"vehicle 'lauv-1', { type 'UUV' }\n", a_kml=KML, j_dol=program,
          j_run=journal, a_geojson=bench.maps["geojson"])


def consoles(bench, random, folder):
    """Mutated requests, among others that are valid."""
    lay_out(bench, random, folder)
    tiles(random, folder / "a.mbtiles")
    every = requests_of("m.dol")
    others = [packed(*request[:3], request[3] and json.dumps(request[3]).encode()) for request in every]
    chosen = [random.choice(every) for _ in range(10)]
    return judged(bench, folder, [
        random.choice(others) if random.random() < 0.2 else mutated(random, request, others) for request in chosen])


def folders(bench, random, folder):
    """Mutated files in a console's folder, and requests that have them read."""
    lay_out(bench, random, folder)
    tiles(random, folder / "a.mbtiles")
    for name in random.sample(["m.dol", "m.fleet", "a.kml", "a.geojson", "j.run"], 2):
        path = folder / name
        mutation = mutate.text if name[-3:] in ("dol", "eet", "kml") else mutate.json_text
        original = path.read_bytes()
        path.write_bytes(mutation(random, original, bench.program_texts if name == "m.dol" else [original]))
    reading = [request for request in requests_of("m.dol") if request[1] in (
        "files", "file", "layer", "tile", "world", "plans", "exploration", "timing", "graph", "run", "replay", "runs",
        "run/resume")]
    return judged(bench, folder, [
        packed(*request[:3], None if request[3] is None else json.dumps(request[3]).encode())
        for request in random.sample(reading, 10)])


READERS = {reader.__name__: reader for reader in (consoles, folders)}
