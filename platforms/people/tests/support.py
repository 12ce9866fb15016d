"""Shared by the tests."""

from __future__ import annotations

import asyncio
import os
from typing import Any, Dict, List, Optional, Tuple

import dolphin

TEXT = """listen: {port: 8470, name: ship.local}
people:
  ana: {skills: [crane, boat], position: {latitude: 41.185, longitude: -8.706}}
  carla: {locate: true}
instructions:
  "launch_${boat}": {text: "Launch ${boat}.", within: 900}
  depth: {text: "Measure the depth.", answer: number, unit: m, from: 0, to: 50, input: depth}
  colour: {text: "Which buoy?", answer: choice, choices: [red, green], input: colour}
  look: {text: "What is there?", answer: text, input: seen}
  where: {text: "Where?", answer: position, input: where}
  picture: {text: "Take a photo of the hull.", answer: photo, input: picture}
  ring: {text: "Ring the bell.", acknowledge: false}
accept: 60
declined: 5
"""


class FakeAnswers:
    """Keeps the answers in `posts`."""

    def __init__(self) -> None:
        self.posts: List[Tuple[str, str, Any, bool]] = []
        self.turn = asyncio.Lock()
        self.missing: Dict[str, str] = {}

    async def undeclared(self, key: str) -> Optional[str]:
        return self.missing.get(key)

    async def post(self, request: str, key: str, value: Any, is_repeated: bool) -> None:
        self.posts.append((request, key, value, is_repeated))


class FakePlan(dolphin.Plan):
    """A plan that keeps its notes itself, as Dolphin's disk does."""

    async def note(self, note: Any) -> None:
        await asyncio.sleep(0)
        self.notes.insert(0, dict(note))


class Clock:
    """Time as the test wants it."""

    def __init__(self) -> None:
        self.now = 1000.0

    def __call__(self) -> float:
        return self.now


async def settled() -> None:
    """Returns when all that can go on without time has gone on."""
    for _ in range(20):
        await asyncio.sleep(0)


def beside(name: str) -> str:
    """A file of the adapter."""
    return os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), name)
