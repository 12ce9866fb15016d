"""The output of `dolphin trace export` and `dolphin plan export` in MCAP, as Foxglove's own library reads it: the same
positions as in the table, and all that happened in order. Checksums are compared."""

import csv
import io
import json
import subprocess
import tempfile
from pathlib import Path

from mcap.reader import NonSeekingReader, SeekingReader

PLAN = 'look "here" <&>, é'
VEHICLE = 'b <&>, "c"'
here = Path(__file__).parent
folder = Path(tempfile.mkdtemp())


def dolphin(*arguments, status=0):
    done = subprocess.run(["dolphin", *map(str, arguments)], capture_output=True, timeout=120)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done.stdout


def read(data):
    """The messages by topic, in order, as (nanoseconds, schema, content); both ways of reading find the same."""
    with_index = SeekingReader(io.BytesIO(data), validate_crcs=True)
    summary = with_index.get_summary()
    found, straight = {}, []
    for schema, channel, message in with_index.iter_messages():
        assert schema.encoding == "jsonschema" and channel.message_encoding == "json"
        content = json.loads(message.data)
        check(json.loads(schema.data), content)
        of_topic = found.setdefault(channel.topic, [])
        assert message.sequence == len(of_topic) and message.log_time == message.publish_time
        of_topic.append((message.log_time, schema.name, content))
    for _, channel, message in NonSeekingReader(io.BytesIO(data), validate_crcs=True).iter_messages():
        straight.append((channel.topic, message.data))
    assert len(straight) == sum(map(len, found.values())) == summary.statistics.message_count
    counts = {summary.channels[n].topic: k for n, k in summary.statistics.channel_message_counts.items()}
    assert counts == {topic: len(messages) for topic, messages in found.items()}
    times = [time for messages in found.values() for time, _, _ in messages]
    assert (summary.statistics.message_start_time, summary.statistics.message_end_time) == (min(times), max(times))
    assert summary.statistics.chunk_count == len(summary.chunk_indexes)
    return found, summary


def check(schema, content):
    """The schema's rules for objects, arrays, numbers and texts."""
    kinds = {"object": dict, "array": list, "number": (int, float), "integer": int, "string": str, "null": type(None)}
    allowed = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    assert any(isinstance(content, kinds[kind]) for kind in allowed), (schema, content)
    if isinstance(content, dict):
        assert content.keys() == schema["properties"].keys(), (schema, content)
        for name, part in content.items():
            check(schema["properties"][name], part)
    if isinstance(content, list):
        assert schema["minItems"] <= len(content) <= schema["maxItems"]
        for part in content:
            check(schema["items"], part)
    if "maximum" in schema:
        assert schema["minimum"] <= content <= schema["maximum"], (schema, content)


run = folder / "survey.run"
dolphin("exec", here / "survey.dol", "--journal", run)
path = folder / "run.mcap"
dolphin("trace", "export", run, "-o", path)
assert path.read_bytes() == dolphin("trace", "export", run, "--to", "mcap")
found, summary = read(path.read_bytes())
rows = list(csv.DictReader(io.StringIO(dolphin("trace", "export", run, "--to", "csv").decode(), newline="")))
assert set(found) == {"/a/location", "/a/state", "/a/plan", f"/{VEHICLE}/location", f"/{VEHICLE}/state", "/log"}, set(found)

# Each sample of the table.
first = min(time for time, _, _ in found["/log"])
for vehicle in ("a", VEHICLE):
    own = [row for row in rows if row["vehicle"] == vehicle]
    places, states = found[f"/{vehicle}/location"], found[f"/{vehicle}/state"]
    assert len(own) == len(places) == len(states) > 20
    for row, (time, schema, fix), (again, _, state) in zip(own, places, states):
        assert schema == "foxglove.LocationFix" and time == again
        assert abs((time - first) / 1e9 - float(row["time"])) < 2e-3, (time, row)
        assert fix["timestamp"]["sec"] * 10**9 + fix["timestamp"]["nsec"] == time
        assert abs(fix["latitude"] - float(row["latitude"])) < 2e-8
        assert abs(fix["longitude"] - float(row["longitude"])) < 2e-8
        assert abs(fix["altitude"] - float(row["height"])) < 2e-3 and fix["frame_id"] == vehicle
        assert abs(state["battery"] - float(row["battery"])) < 2e-6 and state["task"] == row["task"]

# The events, in order.
log = [(entry["name"], entry["message"]) for _, _, entry in found["/log"]]
assert [schema for _, schema, _ in found["/log"]] == ["foxglove.Log"] * len(log)
assert log.index(("a", "is picked")) < log.index(("a", "starts " + PLAN)) < log.index(("a", "ends " + PLAN)), log
assert log.index(("a", "ends " + PLAN)) < log.index(("a", "is released")) and log[-1] == ("program", "completed"), log

# The planned way.
(time, schema, planned), = found["/a/plan"]
line = json.loads(planned["geojson"])["features"][0]
assert schema == "foxglove.GeoJSON" and line["properties"]["name"] == PLAN and len(line["geometry"]["coordinates"]) > 3

# Plans alone.
found, _ = read(dolphin("plan", "export", here / "survey.dol", "--to", "mcap"))
assert list(found) == ["/" + PLAN], found.keys()
names = [f["properties"]["name"] for f in json.loads(found["/" + PLAN][0][2]["geojson"])["features"]]
assert names == [PLAN, "1.Goto", "2.Goto", "3.Loiter"], names

# Several chunks, each with its index: one minute of a long run is found without reading the others.
lines = run.read_text().splitlines()
at = max(n for n, line in enumerate(lines) if '"kind":"vehicle"' in line and '"vehicle":"a"' in line)
sample, end = json.loads(lines[at]), float(json.loads(lines[-1])["time"])
more = [json.dumps({**sample, "time": sample["time"] + (end - sample["time"]) * n / 8000}) for n in range(8000)]
long = folder / "long.run"
long.write_text("\n".join(lines[: at + 1] + more + lines[at + 1 :]) + "\n")
data = dolphin("trace", "export", long, "--to", "mcap")
found, summary = read(data)
assert len(summary.chunk_indexes) > 2 and len(found["/a/location"]) > 8000
times = [time for time, _, _ in found["/a/location"]]
middle = times[len(times) // 2]
part = list(SeekingReader(io.BytesIO(data)).iter_messages(topics=["/a/location"], starting_at=middle))
assert len(part) == sum(time >= middle for time in times)
