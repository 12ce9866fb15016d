"""Journals as data frames, and drawn: with pandas and matplotlib, where they are installed (`pip install
'dolphin-missions[pandas,plots]'`)."""

from __future__ import annotations

from typing import Any

from .journal import Journal


def samples(journal: Journal) -> Any:
    """Where vehicles were, as a frame of pandas: a row for each sample, a column for each quantity measured."""
    pandas = _module("pandas")
    rows = [
        {"time": s.time, "vehicle": s.vehicle, "type": s.type, "latitude": s.latitude, "longitude": s.longitude,
         "height": s.height, "battery": s.battery, "connected": s.connected, **s.readings}
        for track in journal.tracks().values() for s in track
    ]
    names = ["time", "vehicle", "type", "latitude", "longitude", "height", "battery", "connected"]
    frame = pandas.DataFrame(rows, columns=None if rows else names)
    return frame.sort_values("time", kind="stable", ignore_index=True)


def tasks(journal: Journal) -> Any:
    """The plans that vehicles ran, as a frame of pandas."""
    pandas = _module("pandas")
    names = ["vehicle", "plan", "start", "end", "outcome", "why"]
    return pandas.DataFrame([[getattr(t, name) for name in names] for t in journal.tasks()], columns=names)


COLOURS = {"done": "tab:blue", "failed": "tab:red", "stopped": "tab:orange", None: "tab:gray"}


def timeline(journal: Journal, axes: Any = None) -> Any:
    """Draws the tasks of each vehicle over time with matplotlib, and returns the axes."""
    if axes is None:
        axes = _module("matplotlib.pyplot").subplots()[1]
    last = journal.records[-1].time
    runs = journal.tasks()
    vehicles = sorted({run.vehicle for run in runs})
    for run in runs:
        row, end = vehicles.index(run.vehicle), last if run.end is None else run.end
        axes.broken_barh([(run.start, end - run.start)], (row - 0.4, 0.8), facecolors=COLOURS[run.outcome])
        axes.annotate(run.plan, (run.start, row), va="center")
    axes.set_yticks(range(len(vehicles)))
    axes.set_yticklabels(vehicles)
    axes.set_xlabel("seconds")
    return axes


def _module(name: str) -> Any:
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"this needs {name.split('.')[0]}, which is not installed") from error
