"""Outputs of a run: its messages, posts and transitions as topics, so that a robot's own nodes can listen."""

from __future__ import annotations

import asyncio
import json
import sys
from typing import Any, Callable, Dict, Iterator, Mapping, Protocol, Set, Tuple

import dolphin

AGAIN = 0.5
"""Seconds between two attempts to reach the run, which may not listen yet."""


class Links(Protocol):
    def publisher(self, name: str) -> Callable[[str], None]: ...


class Outputs:
    """The outputs of a configuration, of the run `run`. If the run had begun before, only news is published."""

    def __init__(self, topics: Mapping[str, str], run: dolphin.Run, links: Links, is_resumed: bool = False) -> None:
        self._run, self._is_resumed = run, is_resumed
        self._publish = {key: links.publisher(name) for key, name in topics.items()}
        self._told: Set[str] = set()

    async def run(self) -> None:
        """Publishes the news of the run, until it ends."""
        now = await self._time()
        try:
            async for record in self._run:
                if isinstance(record, dolphin.Transition) and (record.time > now or not self._is_resumed):
                    for key, content in news(record):
                        if key in self._publish:
                            self._publish[key](json.dumps(content, ensure_ascii=False))
        except dolphin.RunGone:
            pass  # the console has died, and this adapter is about to end

    async def _time(self) -> float:
        """The time of the run, once it listens."""
        while True:
            try:
                return float((await self._run.status())["time"])
            except dolphin.RunGone as gone:
                if not self._told:
                    self._told.add(str(gone))
                    print(f"outputs wait: {gone}", file=sys.stderr)
                await asyncio.sleep(AGAIN)


def news(step: dolphin.Transition) -> Iterator[Tuple[str, Dict[str, Any]]]:
    """The contents of messages about a transition, by the keys of `outputs`.

    >>> raw = {"kind": "transition", "time": 3, "i": 7, "rule": ["ACTION"], "label": "act(post k:3; message 'hi')",
    ...        "N": {"posted": ["k:3"]}, "effects": [{"say": "hi"}]}
    >>> for key, content in news(dolphin.journal.record(raw)): print(key, content)
    states {'time': 3, 'number': 7, 'label': "act(post k:3; message 'hi')", 'rule': ['ACTION']}
    messages {'time': 3, 'number': 7, 'text': 'hi'}
    posts {'time': 3, 'number': 7, 'key': 'k', 'value': '3'}
    """
    head: Dict[str, Any] = {"time": step.time, "number": step.number}
    yield "states", {**head, "label": step.label, "rule": list(step.rule)}
    for effect in step.effects:
        if "say" in effect:
            yield "messages", {**head, "text": effect["say"]}
    for pair in step.raw.get("N", {}).get("posted", ()):
        key, _, value = pair.partition(":")
        yield "posts", {**head, "key": key, "value": value}
