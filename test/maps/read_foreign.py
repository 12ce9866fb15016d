"""Maps that GDAL's ogr2ogr writes, in each format that it and Dolphin have: Dolphin reads the same features."""

import json
import math
import subprocess
import tempfile
from pathlib import Path

folder = Path(tempfile.mkdtemp())


def ring(x, y, size, turn=1):
    corners = [[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]
    return corners[::turn]


FEATURES = {
    "Point": [("buoy", "Point", [-8.7, 41.1]), ("Leixões <&>", "Point", [-8.5, 41.25])],
    "LineString": [("fairway", "LineString", [[-8.7, 41.1], [-8.69, 41.12], [-8.68, 41.15]])],
    "Polygon": [
        ("basin", "Polygon", [ring(-8.71, 41.18, 0.01)]),
        ("with a hole", "Polygon", [ring(-8.61, 41.18, 0.01), ring(-8.607, 41.183, 0.002, -1)]),
        ("basin", "Polygon", [ring(-8.51, 41.18, 0.01)]),
    ],
    "MultiPolygon": [("two", "MultiPolygon", [[ring(-8.71, 41.18, 0.01)], [ring(-8.69, 41.18, 0.01)]])],
}


def collection(features):
    return {
        "type": "FeatureCollection",
        "features": [
            {"type": "Feature", "properties": {"name": n}, "geometry": {"type": kind, "coordinates": coordinates}}
            for n, kind, coordinates in features
        ],
    }


def ogr(source, target, *options):
    done = subprocess.run(["ogr2ogr", *options, str(target), str(source)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, (options, done.stderr)


def shown(path):
    """The result of a program: names, with sizes of areas in square metres, or positions. No warnings."""
    program = folder / "p.dol"
    program.write_text(
        f"m = map '{path.name}'\n"
        "for (e in m) { message \"${e.key} = ${e.value}\" }\n"
        "for (e in m) { if (!(e.key in NAMES)) { message \"${e.key}: ${e.value.size.round()}\" } }\n".replace(
            "NAMES", str([n for kind in ("Point", "LineString") for n, _, _ in FEATURES[kind]])
        )
    )
    done = subprocess.run(["dolphin", "exec", str(program)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and not done.stderr, (path, done.stdout, done.stderr)
    return [line.split("says: ")[1] for line in done.stdout.splitlines() if "says: " in line]


def as_dolphin_writes(point):
    return f"({point[1]:.6f}, {point[0]:.6f})"


EXPECTED = {
    "Point": [f"{n} = {as_dolphin_writes(c)}" for n, _, c in FEATURES["Point"]],
    "LineString": [f"{n} = [{', '.join(map(as_dolphin_writes, c))}]" for n, _, c in FEATURES["LineString"]],
}


def size(south, width):
    """Square metres of the ellipsoid between parallels and meridians that are `width` degrees apart."""
    b, e = 6_356_752.314245, 0.0818191908426

    def below(latitude):
        s = math.sin(math.radians(latitude))
        return s / (1 - (e * s) ** 2) + math.atanh(e * s) / e

    return math.radians(width) * b * b / 2 * (below(south + width) - below(south))


ONE = size(41.18, 0.01)
SIZES = {
    "Polygon": [("basin", ONE), ("with a hole", ONE - size(41.183, 0.002)), ("basin 2", ONE)],
    "MultiPolygon": [("two", 2 * ONE)],
}
FORMATS = {
    "geojson": ("GeoJSON", ["-lco", "RFC7946=YES"], FEATURES),
    "old.geojson": ("GeoJSON", [], FEATURES),
    "kml": ("KML", [], FEATURES),
    "libkml.kml": ("LIBKML", [], FEATURES),
    "kmz": ("LIBKML", [], FEATURES),
    "gpx": ("GPX", [], ["Point", "LineString"]),
}

count = 0
for suffix, (driver, options, kinds) in FORMATS.items():
    for kind in kinds:
        source, target = folder / "source.geojson", folder / f"{kind}.{suffix}"
        source.write_text(json.dumps(collection(FEATURES[kind])))
        ogr(source, target, "-f", driver, *options)
        found = shown(target)
        if kind in EXPECTED:
            assert found == EXPECTED[kind], (target, found)
        else:
            sizes = [line for line in found if " = " not in line]
            assert len(sizes) == len(SIZES[kind]), (target, found)
            for line, (name, metres) in zip(sizes, SIZES[kind]):
                assert line.startswith(name + ": ") and abs(int(line.split(": ")[1]) / metres - 1) < 1e-5, (target, line)
        count += 1

# Another coordinate system is refused; GDAL writes it into GeoJSON of before RFC 7946.
source = folder / "source.geojson"
source.write_text(json.dumps(collection(FEATURES["Point"])))
for system in ("EPSG:3857", "EPSG:32629"):
    target = folder / f"{system[5:]}.geojson"
    ogr(source, target, "-f", "GeoJSON", "-t_srs", system)
    (folder / "p.dol").write_text(f"m = map '{target.name}'\n")
    done = subprocess.run(["dolphin", "check", str(folder / "p.dol")], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "its coordinates are in the system" in done.stdout + done.stderr, done
    count += 1

# Geometries without positions.
source.write_text(json.dumps(collection([("a", "Point", [-8.7, 41.1])])))
table = folder / "empty.csv"
table.write_text('WKT,name\n"POINT EMPTY",e\n"POINT (-8.7 41.1)",a\n"POLYGON EMPTY",f\n')
for driver, suffix in (("GeoJSON", "geojson"), ("KML", "kml")):
    target = folder / f"empty.{suffix}"
    ogr(table, target, "-f", driver, "-oo", "GEOM_POSSIBLE_NAMES=WKT", "-a_srs", "EPSG:4326", "-skipfailures")
    (folder / "p.dol").write_text(f"m = map '{target.name}'\nmessage m.a\n")
    done = subprocess.run(["dolphin", "exec", str(folder / "p.dol")], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "says: (41.100000, -8.700000)" in done.stdout, (target, done)
    count += 1

print(f"passed: {count} files of ogr2ogr")
