"""Answers of people as inputs of the run: each is posted once, also if this process or the console dies meanwhile."""

from __future__ import annotations

import asyncio
import json
from typing import Any, Dict, Iterator, Mapping, Optional

import dolphin
from dolphin.posting import AGAIN
from dolphin.values import from_json, to_json

from .person import POSTING


class Answers:
    """For the run beside a journal; without one, instructions that take an answer cannot be given."""

    def __init__(self, journal: Optional[str]) -> None:
        self._journal = journal
        self._run = None if journal is None else dolphin.attach(journal)
        self.turn = asyncio.Lock()
        """Held while an answer is posted, and its notes are written."""

    async def undeclared(self, key: str) -> Optional[str]:
        """The reason why answers under this key cannot be posted; `None` if they can, or if that is not known yet."""
        if self._run is None:
            return "its answer needs the option --run of dolphin-people"
        try:
            declared = (await self._run.status())["inputs"]
        except dolphin.DolphinError:
            return None
        known = ", ".join(f"'{each}'" for each in declared)
        has = f"its inputs are {known}" if declared else "it declares no inputs"
        return None if key in declared else f"the program declares no input '{key}' for the answer: {has}"

    async def post(self, request: str, key: str, value: Any, is_repeated: bool) -> None:
        """Posts the answer to the instruction of a request, and returns once the journal has it. Raises `Failed` if the
        run refuses it. `is_repeated`: it may have been posted before, which the journal shows."""
        if self._run is None or self._journal is None:
            raise dolphin.Failed("the answer cannot be posted: --run is not given")
        while True:
            if is_repeated and await asyncio.to_thread(has_answer, self._journal, request, key, value):
                return
            try:
                await self._run.post(key, value)
                return
            except dolphin.RunEnded:
                return
            except dolphin.RequestRefused as refused:
                raise dolphin.Failed(f"the answer is refused: {refused}") from refused
            except dolphin.RunGone:
                is_repeated = True
                await asyncio.sleep(AGAIN)


def has_answer(journal: str, request: str, key: str, value: Any) -> bool:
    """Whether the journal has the input `key: value` after the note that the answer to a request is to be posted."""
    is_after = False
    for line in _lines(journal):
        if line.get("kind") == "platform":
            note = line.get("note") or {}
            is_after = is_after or note.get("request") == request and _state(note) == POSTING
        elif is_after and line.get("event") == "input" and line.get("key") == key:
            if from_json(line.get("value")) == from_json(json.loads(json.dumps(to_json(value)))):
                return True
    return False


def _state(note: Mapping[str, Any]) -> Optional[str]:
    """The decision that a note has kept."""
    kept = note.get("note")
    own = kept.get("note") if isinstance(kept, dict) else None
    return own.get("state") if isinstance(own, dict) else None


def _lines(journal: str) -> Iterator[Dict[str, Any]]:
    """The lines that may matter; journals can be long."""
    try:
        with open(journal, "rb") as file:
            for line in file:
                if b'"state"' in line or b'"input"' in line:
                    try:
                        found = json.loads(line)
                    except ValueError:  # the last line of a console that died
                        continue
                    if isinstance(found, dict):
                        yield found
    except OSError:
        return
