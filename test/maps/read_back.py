"""The output of `dolphin trace export` and `dolphin plan export`, as GDAL's ogr2ogr reads it: the same features and the
same positions in each format."""

import csv
import json
import subprocess
import tempfile
from pathlib import Path

PLAN = 'look "here" <&>, é'
VEHICLE = 'b <&>, "c"'
here = Path(__file__).parent
folder = Path(tempfile.mkdtemp())


def dolphin(*arguments, status=0):
    done = subprocess.run(["dolphin", *map(str, arguments)], capture_output=True, text=True, timeout=60)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done.stdout, done.stderr


def read(path, *options):
    """The features of the file, as GDAL understands them."""
    command = ["ogr2ogr", "-f", "GeoJSON", "-lco", "COORDINATE_PRECISION=9", "/vsistdout/", str(path), *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and not done.stderr, (path, done.stderr)
    return json.loads(done.stdout)["features"]


def name(feature):
    return feature["properties"].get("name") or feature["properties"].get("Name")


def positions(feature):
    """Of a point, a line or several lines."""
    geometry = feature["geometry"]
    found = geometry["coordinates"]
    if geometry["type"] == "Point":
        found = [found]
    elif geometry["type"] == "MultiLineString":
        found = [p for part in found for p in part]
    return [tuple(p) for p in found]


def lines(features):
    return {name(f): positions(f) for f in features if f["geometry"]["type"].endswith("LineString")}


def points(features):
    return sorted((name(f), positions(f)[0]) for f in features if f["geometry"]["type"] == "Point")


def same(a, b):
    return len(a) == len(b) and all(abs(x - y) < 2e-8 for p, q in zip(a, b) for x, y in zip(p, q))


def all_formats(kind, *arguments):
    """The features of each format, and the rows of the table."""
    files = {f: folder / f"{kind}.{f}" for f in ("geojson", "kml", "gpx", "csv")}
    for path in files.values():
        dolphin(*arguments, "-o", path)
    gpx = [f for layer in ("waypoints", "routes", "tracks") for f in read(files["gpx"], layer)]
    with open(files["csv"], newline="") as table:
        rows = list(csv.DictReader(table))
    return {"geojson": read(files["geojson"]), "kml": read(files["kml"]), "gpx": gpx}, rows, files


def check_same(found):
    """All three have the lines and the points of one another."""
    lists = {f: (lines(fs), points(fs)) for f, fs in found.items()}
    wanted_lines, wanted_points = lists["geojson"]
    for form, (found_lines, found_points) in lists.items():
        assert found_lines.keys() == wanted_lines.keys(), (form, found_lines.keys())
        for key, line in wanted_lines.items():
            assert same(line, found_lines[key]), (form, key)
        assert [n for n, _ in found_points] == [n for n, _ in wanted_points], (form, found_points)
        assert same([p for _, p in found_points], [p for _, p in wanted_points]), form
    return wanted_lines, wanted_points


run = folder / "survey.run"
dolphin("exec", here / "survey.dol", "--journal", run)

# A run: each sample of the table is on the track of its vehicle, and with it the plan that the vehicle ran then.
found, rows, files = all_formats("run", "trace", "export", run)
tracks, starts = check_same(found)
assert set(tracks) == {"a", VEHICLE}, tracks.keys()
for vehicle, track in tracks.items():
    sampled = [tuple(float(r[k]) for k in ("longitude", "latitude")) for r in rows if r["vehicle"] == vehicle]
    assert len(sampled) > 20 and same([p[:2] for p in track], sampled), vehicle
assert sorted(n for n, _ in starts) == sorted([PLAN, "by, name"]), starts
assert {r["task"] for r in rows if r["vehicle"] == "a"} == {PLAN, ""}, "tasks in the table"
assert [float(r["time"]) for r in rows] == sorted(float(r["time"]) for r in rows)
task = next(f for f in found["geojson"] if name(f) == PLAN)["properties"]
assert task["ending"] == "done" and task["vehicle"] == "a" and task["from"][:11] < task["until"] > task["from"], task

# GDAL finds the positions of the table by its columns.
options = ["-oo", "X_POSSIBLE_NAMES=longitude", "-oo", "Y_POSSIBLE_NAMES=latitude"]
assert len(read(files["csv"], *options)) == len(rows)

# Plans: the described one; the other one has no way.
found, rows, files = all_formats("plan", "plan", "export", here / "survey.dol")
ways, stops = check_same(found)
assert list(ways) == [PLAN], ways.keys()
assert [n for n, _ in stops] == ["1.Goto", "2.Goto", "3.Loiter"], stops
assert same(ways[PLAN], [(float(r["longitude"]), float(r["latitude"]), float(r["height"])) for r in rows])
assert ways[PLAN][0] == (-8.706, 41.185, -2), ways
told = dolphin("plan", here / "survey.dol", "--to", "gpx")
assert told[0] == files["gpx"].read_text(), "plan --to is plan export"
assert "left out, since only vehicles know their way: by, name" in told[1], told[1]

# Exports that are refused.
for arguments, words in [
    (("trace", "export", run), "give --to FORMAT or -o FILE; the formats are csv, geojson, kml, gpx, mcap"),
    (("trace", "export", run, "-o", folder / "run.txt"), "has no extension of a known format, csv, geojson, kml, gpx, mcap"),
    (("trace", "export", run, "--to", "bag"), "'bag' is not one of the formats csv, geojson, kml, gpx, mcap"),
    (("plan", "export", here / "survey.dol", "nothing", "--to", "csv"), "no vehicle is given a plan 'nothing'"),
    (("plan", "export", here / "survey.dol", "by, name", "--to", "csv"), "nothing here has a place on a map"),
    (("plan",), "required argument PROG is missing"),
    (("plan", here / "survey.dol", "a", "b"), "too many arguments"),
]:
    _, told = dolphin(*arguments, status=2)
    assert words in " ".join(told.split()), told
dolphin("trace", "export", run, "-o", folder / "none" / "run.csv", status=3)
