"""Inputs from topics: each message is posted to the run, by the socket beside its journal."""

from __future__ import annotations

import importlib
from typing import Any, Callable, Mapping, Protocol

import dolphin
from dolphin.posting import Poster, Remarks

from . import interfaces
from .configuration import Topic


class Links(Protocol):
    def every(self, name: str, class_: Any, hear: Callable[[Any], None]) -> None: ...


class Inputs:
    """The inputs of a configuration, for the run `run`."""

    def __init__(self, topics: Mapping[str, Topic], run: dolphin.Run, links: Links,
                 load: interfaces.Load = importlib.import_module) -> None:
        self._remarks = Remarks()
        self._poster = Poster(run, self._remarks)
        for key, topic in topics.items():
            links.every(topic.name, interfaces.of(topic.type, load),
                        lambda message, key=key, topic=topic: self._hear(key, topic, message))

    def _hear(self, key: str, topic: Topic, message: Any) -> None:
        assert topic.path is not None
        value = topic.path.read(message)
        if not _is_plain(value):
            self._remarks.once(
                f"input '{key}': {topic.path.text} of {topic.name} is not a number, a text, a truth or a list")
            return
        self._poster.put(key, value)

    async def run(self) -> None:
        """Posts what comes, until the run has ended."""
        await self._poster.run()


def _is_plain(value: Any) -> bool:
    return isinstance(value, (bool, int, float, str)) or isinstance(value, list) and all(map(_is_plain, value))
