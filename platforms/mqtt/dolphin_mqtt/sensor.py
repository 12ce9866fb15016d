"""A sensor: from its messages, and from its silence, to pairs for the run. Time is an argument."""

from __future__ import annotations

import json
import math
from typing import Any, List, NamedTuple, Optional, Tuple, Union

import dolphin

from .configuration import Input

LONGEST = 60_000
"""Bytes of the longest value: requests of a run's socket are limited, docs/socket.md."""
DEEPEST = 20
"""Levels of lists and maps in a value at most."""


class Wrong(Exception):
    """A message that has no value for the program. `reason` is one of a few texts; `detail` may have parts of it."""

    def __init__(self, reason: str, detail: str = "") -> None:
        super().__init__(reason + (f": {detail}" if detail else ""))
        self.reason = reason


class Pair(NamedTuple):
    """A pair for the run."""

    key: str
    value: Any


class Remark(NamedTuple):
    """A remark for people. Of those of one `kind` only the first is written, unless it is `None`."""

    text: str
    kind: Optional[Tuple[str, str]]


News = List[Union[Pair, Remark]]


def value_of(payload: bytes, rule: Input) -> Any:
    """The value in a message. Raises `Wrong`."""
    try:
        text = payload.decode()
        found: Any = text if rule.is_text else json.loads(text, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        reason = "is not a text in UTF-8" if rule.is_text else "is not JSON"
        raise Wrong(reason, repr(payload[:60].decode(errors="replace"))) from None
    for step in rule.field:
        is_there = (
            isinstance(found, dict) and step in found if isinstance(step, str)
            else isinstance(found, list) and step < len(found)
        )
        if not is_there:
            raise Wrong(f"has no field '{rule.field_text}'", repr(text[:60]))
        found = found[step]
    value = _plain(found, 0)
    size = len(json.dumps(dolphin.values.to_json(value)))
    if size > LONGEST:
        raise Wrong(f"has a value of more than {LONGEST} bytes", str(size))
    return value


def _no_constant(name: str) -> Any:
    raise ValueError(f"{name} is not JSON")


def _plain(found: Any, depth: int) -> Any:
    """The value of programs that JSON stands for. Objects with a latitude and a longitude alone, or also a height, are
    positions, other ones are maps. Raises `Wrong`."""
    if depth > DEEPEST:
        raise Wrong(f"has a value of more than {DEEPEST} levels")
    if isinstance(found, list):
        return [_plain(item, depth + 1) for item in found]
    if isinstance(found, dict):
        members = {_text(key): _plain(item, depth + 1) for key, item in found.items()}
        if {"latitude", "longitude"} <= set(members) <= {"latitude", "longitude", "height"}:
            return dolphin.Position(**members)
        return members
    if isinstance(found, str):
        return _text(found)
    if found is None:
        raise Wrong("has the value null, which programs do not have")
    if not isinstance(found, bool) and not _is_finite(found):
        raise Wrong("has a number that is not finite")
    return found


def _text(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise Wrong("has a text with half a character of UTF-16") from None
    return text


def _is_finite(number: "int | float") -> bool:
    try:
        return math.isfinite(number)
    except OverflowError:  # a whole number beyond those of floating point
        return False


class Sensor:
    """The sensor behind an input, from the moment `now` on. Moments are seconds of any clock that goes on."""

    def __init__(self, rule: Input, now: float) -> None:
        self._rule = rule
        self._heard = now
        self._is_silent = False
        self._last: Optional[str] = None
        """The last value that was posted, as JSON: there `true` is not `1`."""
        self._next = -math.inf
        """The moment from which the next value may be posted."""
        self._held: List[Any] = []
        """The latest value that came before that moment, if any."""

    def hear(self, payload: bytes, retained: bool, now: float) -> News:
        """The news by a message. A retained one shows nothing about the sensor of this moment: silence goes on."""
        rule = self._rule
        if retained and not rule.retained:
            return []
        try:
            value = value_of(payload, rule)
        except Wrong as wrong:
            text = f"input '{rule.key}': a message of {rule.topic} {wrong}; others like it are not reported"
            return [Remark(text, (rule.key, wrong.reason))]
        news: News = []
        if not retained:
            self._heard = now
            if self._is_silent:
                self._is_silent = False
                news.append(Remark(f"input '{rule.key}': {rule.topic} is heard again", None))
        self._held = [value]
        return news + self._release(now)

    def tick(self, now: float) -> News:
        """The news by the passage of time."""
        rule = self._rule
        news = self._release(now)
        if rule.silence is not None and not self._is_silent and now - self._heard >= rule.silence:
            self._is_silent = True
            self._last, self._next = None, -math.inf  # the first value after the silence is news, and due at once
            news.append(Remark(f"input '{rule.key}': {rule.topic} has been silent for {rule.silence:g} s", None))
            if rule.silent is not None:
                news.append(Pair(rule.silent, rule.key))
        return news

    def due(self) -> float:
        """The next moment for `tick`; infinite if there is none."""
        silent = math.inf
        if self._rule.silence is not None and not self._is_silent:
            silent = self._heard + self._rule.silence
        return min(silent, self._next) if self._held else silent

    def _release(self, now: float) -> News:
        if not self._held or now < self._next:
            return []
        value = self._held.pop()
        shown = json.dumps(dolphin.values.to_json(value), sort_keys=True)
        if self._rule.change and shown == self._last:
            return []
        self._last, self._next = shown, now + self._rule.every
        return [Pair(self._rule.key, value)]
