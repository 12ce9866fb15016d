"""Inputs for a run from a program that stays beside it, such as a bridge from sensors: they wait while the run does not
listen, and are posted in their order."""

from __future__ import annotations

import asyncio
import collections
import sys
from typing import Any, Callable, Deque, Optional, Set, Tuple

from .errors import RequestRefused, RunEnded, RunGone
from .runs import Run

MOST = 1000
"""Inputs that wait for the run at most; the oldest are dropped then."""
AGAIN = 0.5
"""Seconds between two attempts to reach the run, which may not listen yet."""
REMARKS = 100
"""Different remarks that are written at most."""


class Remarks:
    """Remarks for people, on standard error unless `write` is given: each once, so that a fault that recurs does not
    flood."""

    def __init__(self, write: Optional[Callable[[str], None]] = None) -> None:
        self._write = write or (lambda text: print(text, file=sys.stderr, flush=True))
        self._made: Set[object] = set()

    def once(self, text: str, kind: object = None) -> None:
        """Writes the remark unless it, or one of the same kind, was written."""
        mark = text if kind is None else kind
        if mark not in self._made and len(self._made) < REMARKS:
            self._made.add(mark)
            self._write(text)

    def now(self, text: str) -> None:
        """Writes the remark."""
        self._write(text)


class Poster:
    """Posts inputs to a run. `put` never waits; `run` does the work."""

    def __init__(self, run: Run, remarks: Remarks) -> None:
        self._run, self._remarks = run, remarks
        self._waiting: Deque[Tuple[str, Any]] = collections.deque(maxlen=MOST)
        self._there = asyncio.Event()

    def put(self, key: str, value: Any) -> None:
        """Adds an input, after all that wait."""
        if len(self._waiting) == MOST:
            self._remarks.once(f"more than {MOST} inputs wait for the run; the oldest are dropped")
        self._waiting.append((key, value))
        self._there.set()

    async def run(self) -> None:
        """Posts the inputs that were put, until the run has ended."""
        while True:
            await self._there.wait()
            while self._waiting:
                await self._reach()
                key, value = self._waiting.popleft()
                try:
                    await self._run.post(key, value)
                except RunEnded:
                    return
                except RequestRefused as refused:
                    self._remarks.once(f"input '{key}' is refused: {refused}", (key, refused.code))
                except RunGone as gone:
                    self._remarks.once(f"input '{key}' may be lost: {gone}")
            self._there.clear()

    async def _reach(self) -> None:
        """Returns once the run listens."""
        is_first = True
        while True:
            try:
                await self._run.status()
                return
            except RunEnded:
                return  # as the post will find
            except RunGone as gone:
                if not is_first:  # a run that has just ended does not listen either
                    self._remarks.once(f"inputs wait: {gone}")
                is_first = False
                await asyncio.sleep(AGAIN)
