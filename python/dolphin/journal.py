"""Journals of runs as records (docs/trace.md)."""

from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple, Type, TypeVar

from . import command
from .errors import JournalError
from .values import from_json

Raw = Mapping[str, Any]


@dataclass(frozen=True)
class Record:
    """A line of a journal. `raw` has all its members, also those that later versions add."""

    raw: Raw = field(repr=False, compare=False)
    time: float


@dataclass(frozen=True)
class Header(Record):
    """The first line: program, platform, and date of the start."""

    program: str
    platform: str
    started: str


@dataclass(frozen=True)
class Sighting(Record):
    """A vehicle as it is known from now on."""

    vehicle: str
    type: str
    latitude: float
    longitude: float
    height: float
    battery: Optional[float]
    connected: bool
    unready: Optional[str]
    readings: Mapping[str, Any]


@dataclass(frozen=True)
class Event(Record):
    """Something happened outside, and causes the next transition: `done`, `failed`, `timer`, `answer`, `input` ..."""

    event: str
    vehicle: Optional[str]
    why: Optional[str]
    key: Optional[str]
    value: Any


@dataclass(frozen=True)
class Transition(Record):
    """A transition of the semantics."""

    number: int
    label: str
    rule: Tuple[str, ...]
    at: Optional[str]
    effects: Tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Resumed(Record):
    """The console died, and another one resumed the run."""


@dataclass(frozen=True)
class Other(Record):
    """A line for platforms or about operators, or of a kind that this version does not know."""

    kind: str


@dataclass(frozen=True)
class End(Record):
    """The end of the run: `completed`, `halted`, `failed`, `interrupted` or `stuck`."""

    ending: str
    message: str


R = TypeVar("R", bound=Record)


@dataclass(frozen=True)
class TaskRun:
    """A plan that a vehicle ran. `end` and `outcome` (`done`, `failed` or `stopped`) are `None` while it runs."""

    vehicle: str
    plan: str
    start: float
    end: Optional[float] = None
    outcome: Optional[str] = None
    why: Optional[str] = None


def record(raw: Raw) -> Record:
    """The record of a line.

    >>> record({"kind": "end", "time": 12, "transitions": 3, "ending": "completed"})
    End(time=12, ending='completed', message='')
    """
    time = raw.get("time", 0)
    kind = raw.get("kind")
    try:
        if raw.get("format") == "dolphin-journal":
            return Header(raw, 0, raw["program"]["path"], raw["platform"], raw["started"])
        if kind == "vehicle":
            return Sighting(
                raw, time, raw["vehicle"], raw["type"], raw["latitude"], raw["longitude"], raw["height"],
                raw["battery"], raw["connected"], raw.get("unready"), raw.get("readings", {}),
            )
        if kind == "event":
            value = raw.get("value", raw.get("text"))
            return Event(
                raw, time, raw["event"], raw.get("vehicle"), raw.get("why"), raw.get("key"), from_json(value)
            )
        if kind == "transition":
            return Transition(
                raw, time, raw["i"], raw["label"], tuple(raw["rule"]), raw.get("at"), tuple(raw.get("effects", ()))
            )
        if kind == "resumed":
            return Resumed(raw, time)
        if kind == "end":
            return End(raw, time, raw["ending"], raw.get("message", ""))
    except (KeyError, TypeError) as error:
        raise JournalError(f"a line of the journal lacks {error}: {json.dumps(raw)[:200]}") from error
    return Other(raw, time, str(kind))


class Journal:
    """The records of a run, in order."""

    def __init__(self, records: List[Record], path: Optional[str] = None) -> None:
        self.records = records
        self.path = path

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records)

    def __len__(self) -> int:
        return len(self.records)

    def of(self, kind: Type[R]) -> List[R]:
        """The records of a class: `journal.of(Sighting)`."""
        return [record for record in self.records if isinstance(record, kind)]

    @property
    def header(self) -> Header:
        first = self.records[0]
        assert isinstance(first, Header)
        return first

    @property
    def end(self) -> Optional[End]:
        """The end of the run; `None` if it goes on, or its console died."""
        last = self.records[-1]
        return last if isinstance(last, End) else None

    @property
    def completed(self) -> bool:
        return self.end is not None and self.end.ending == "completed"

    def messages(self) -> List[str]:
        """The messages of the program."""
        said = [effect["say"] for step in self.of(Transition) for effect in step.effects if "say" in effect]
        return [str(text) for text in said]

    def tasks(self) -> List[TaskRun]:
        """The plans that vehicles ran, by their starts."""
        runs: List[TaskRun] = []
        open_: Dict[str, int] = {}
        cause: Optional[Event] = None

        def close(vehicle: str, time: float, outcome: str, why: Optional[str] = None) -> None:
            if vehicle in open_:
                at = open_.pop(vehicle)
                before = runs[at]
                runs[at] = TaskRun(before.vehicle, before.plan, before.start, time, outcome, why)

        for each in self.records:
            if isinstance(each, Event):
                cause = each
                continue
            if not isinstance(each, Transition):
                continue
            if cause is not None and cause.vehicle is not None and cause.event in ("done", "failed"):
                close(cause.vehicle, each.time, cause.event, cause.why)
            cause = None
            for effect in each.effects:
                if "stop" in effect:
                    close(effect["stop"], each.time, "stopped")
                if "start" in effect:
                    open_[effect["on"]] = len(runs)
                    runs.append(TaskRun(effect["on"], effect["start"], each.time))
        return runs

    def tracks(self) -> Dict[str, List[Sighting]]:
        """For each vehicle where it was seen, in order."""
        found: Dict[str, List[Sighting]] = {}
        for sighting in self.of(Sighting):
            found.setdefault(sighting.vehicle, []).append(sighting)
        return found

    def geojson(self) -> Dict[str, Any]:
        """The ways of the vehicles that the program held, and where their tasks started, as GeoJSON (RFC 7946):
        `dolphin trace export --to geojson`."""
        exported: Dict[str, Any] = json.loads(self._command(["trace", "export"], ["--to", "geojson"]))
        return exported

    def svg(self) -> str:
        """A drawing of the run: `dolphin trace draw`."""
        with tempfile.TemporaryDirectory(prefix="dolphin-") as folder:
            picture = os.path.join(folder, "run.svg")
            self._command(["trace", "draw"], ["-o", picture])
            with open(picture, encoding="utf-8") as file:
                return file.read()

    def _repr_svg_(self) -> str:
        """The picture in a notebook."""
        return self.svg()

    def write(self, path: command.PathLike) -> None:
        """Writes the journal into a file."""
        with open(path, "w", encoding="utf-8") as file:
            for each in self.records:
                file.write(json.dumps(each.raw, ensure_ascii=False, separators=(",", ":")) + "\n")

    def _command(self, words: List[str], options: List[str]) -> str:
        with tempfile.TemporaryDirectory(prefix="dolphin-") as folder:
            path = self.path
            if path is None or not os.path.exists(path):
                path = os.path.join(folder, "kept.run")
                self.write(path)
            output = command.call([*words, path, *options])
        if output.status != 0:
            raise output.error()
        return output.stdout


def read(path: command.PathLike) -> Journal:
    """The journal of a file. The torn last line of a console that died is left out."""
    records: List[Record] = []
    with open(path, "rb") as file:
        for number, line in enumerate(file, 1):
            if not line.endswith(b"\n"):
                break
            try:
                raw = json.loads(line)
            except ValueError as error:
                raise JournalError(f"{os.fspath(path)}:{number}: the line is not JSON: {error}") from error
            if number == 1 and (not isinstance(raw, dict) or raw.get("format") != "dolphin-journal"):
                raise JournalError(f"{os.fspath(path)} is not a journal")
            if number == 1 and raw.get("version") != 1:
                raise JournalError(f"{os.fspath(path)} has version {raw.get('version')} of the format, not 1")
            records.append(record(raw))
    if not records:
        raise JournalError(f"{os.fspath(path)} is not a journal: it is empty")
    return Journal(records, os.fspath(path))
