"""Inputs from topics: each message is posted to the run, by the socket beside its journal."""

from __future__ import annotations

import asyncio
import collections
import importlib
import sys
from typing import Any, Callable, Deque, Mapping, Protocol, Set, Tuple

import dolphin

from . import interfaces
from .configuration import Topic

MOST = 1000
"""Messages that wait for the run at most; the oldest are dropped then."""
AGAIN = 0.5
"""Seconds between two attempts to reach the run, which may not listen yet."""


class Links(Protocol):
    def every(self, name: str, class_: Any, hear: Callable[[Any], None]) -> None: ...


class Inputs:
    """The inputs of a configuration, for the run `run`."""

    def __init__(self, topics: Mapping[str, Topic], run: dolphin.Run, links: Links,
                 load: interfaces.Load = importlib.import_module) -> None:
        self._run = run
        self._waiting: Deque[Tuple[str, Any]] = collections.deque(maxlen=MOST)
        self._there = asyncio.Event()
        self._told: Set[str] = set()
        for key, topic in topics.items():
            links.every(topic.name, interfaces.of(topic.type, load),
                        lambda message, key=key, topic=topic: self._hear(key, topic, message))

    def _hear(self, key: str, topic: Topic, message: Any) -> None:
        assert topic.path is not None
        value = topic.path.read(message)
        if not _is_plain(value):
            self._tell(f"input '{key}': {topic.path.text} of {topic.name} is not a number, a text, a truth or a list")
            return
        if len(self._waiting) == MOST:
            self._tell(f"more than {MOST} inputs wait for the run; the oldest are dropped")
        self._waiting.append((key, value))
        self._there.set()

    async def run(self) -> None:
        """Posts what comes, for as long as the adapter lives."""
        while True:
            await self._there.wait()
            while self._waiting:
                await self._reach()
                key, value = self._waiting.popleft()
                try:
                    await self._run.post(key, value)
                except dolphin.RequestRefused as refused:
                    self._tell(f"input '{key}' is refused: {refused}")
                except dolphin.RunGone as gone:
                    self._tell(f"input '{key}' may be lost: {gone}")
            self._there.clear()

    async def _reach(self) -> None:
        """Returns once the run listens."""
        while True:
            try:
                await self._run.status()
                return
            except dolphin.RunGone as gone:
                self._tell(f"inputs wait: {gone}")
                await asyncio.sleep(AGAIN)

    def _tell(self, why: str) -> None:
        """Writes it to standard error, once."""
        if why not in self._told and len(self._told) < 100:
            self._told.add(why)
            print(why, file=sys.stderr)


def _is_plain(value: Any) -> bool:
    return isinstance(value, (bool, int, float, str)) or isinstance(value, list) and all(map(_is_plain, value))
