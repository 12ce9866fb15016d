"""Missions of a size: each writes its files into the current folder, and returns the command that is measured."""

import json
import math
import subprocess

VEHICLE = "vehicle 'v1', { type 'UUV'; at 41.185, -8.706; drain 0.percent }"


def write(name, lines):
    with open(name, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def inputs(_, pairs, posted):
    """A recorded run in which `posted` inputs arrive while N has `pairs` pairs."""
    write("inputs.fleet", [VEHICLE, "plan 'p', { duration 10.hours }"] + [
        f"input 'x', {i}, after {i}.seconds" for i in range(1, posted + 1)] + ["input 'over', true, after 9.hours"])
    write("inputs.dol", [
        "input 'x', 'over'", f"for (i in 1..{pairs}) {{ post k: i }}", "v = pick { type 'UUV' }",
        "execute until { poll over: true } run (task('p')[v] | condition { poll x: 0 })"])
    return ["exec", "inputs.dol", "-q", "--journal", "inputs.run"]


def declared(_, keys):
    """A program that declares `keys` inputs, beside a fleet that posts one pair of each."""
    write("declared.fleet", [VEHICLE] + [f"input 'k{i}', 1, after 1.minutes" for i in range(keys)])
    write("declared.dol", [f"input 'k{i}'" for i in range(keys)] + ["v = pick { count 1 }", "execute task('p')[v]"])
    return ["check", "declared.dol"]


def picture(dolphin, tasks):
    """The picture of a run with so many tasks, a bar each."""
    write("picture.fleet", [VEHICLE, "plan 'p', { duration 7 }"])
    write("picture.dol", ["v = pick { type 'UUV' }", f"for (i in 1..{tasks}) {{ execute task('p')[v] }}"])
    subprocess.run([dolphin, "exec", "picture.dol", "-q", "--journal", "picture.run"], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return ["trace", "draw", "picture.run", "-o", "picture.svg"]


def areas(_, corners):
    """A plan beside 158 areas of a map that have so many corners together."""
    each = corners // 158

    def area(i):
        place = (-8.7 + i % 13 * 0.02, 41.3 + i // 13 * 0.02)
        angles = [2 * math.pi * (k % each) / each for k in range(each + 1)]
        ring = [[place[0] + 0.008 * math.cos(a) * (1 + 0.05 * math.sin(40 * a)),
                 place[1] + 0.006 * math.sin(a) * (1 + 0.05 * math.sin(40 * a))] for a in angles]
        return {"type": "Feature", "properties": {"name": f"a{i}"},
                "geometry": {"type": "Polygon", "coordinates": [ring]}}

    write("areas.geojson", [json.dumps({"type": "FeatureCollection", "features": [area(i) for i in range(158)]})])
    write("areas.fleet", [VEHICLE])
    write("areas.dol", [
        "fence outside map('areas.geojson'), margin: 10.m", "v = pick { type 'UUV' }", "execute (imcPlan {",
        "  planName 'p'",
        "  speed 1.5, Speed.Units.METERS_PS", "  z 2, Z.Units.DEPTH", "  locate location(41.19, -8.7)", "  goTo()",
        "  move 500, 500", "  goTo()", "})[v]"])
    return ["exec", "areas.dol", "-q"]


def runs(_, count):
    """So many simulated runs of a program whose durations are drawn."""
    write("runs.fleet", [VEHICLE, "plan 'p', { duration 10, 20 }"])
    write("runs.dol", ["v = pick { type 'UUV' }", "execute task('p')[v] >> task('p')[v]"])
    return ["exec", "runs.dol", "--runs", str(count), "--jobs", "1"]
