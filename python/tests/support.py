"""Shared by the tests: conversations in memory, and programs in a folder of their own."""

from __future__ import annotations

import asyncio
import os
import shutil
import tempfile
import unittest
from typing import Any, Awaitable, Callable, Dict, List, Mapping, Optional

from dolphin.adapter import Adapter
from dolphin.channel import Channel

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "examples")
ENDS = ("done", "failed", "stopped", "absent")


class Console(Channel):
    """Dolphin's side of the platform protocol, in memory: `order` gives orders, `reports` has the answers. Notes are
    kept at once, unless `keeps` is false."""

    def __init__(self) -> None:
        self.reports: List[Dict[str, Any]] = []
        self.keeps = True
        self._orders: "asyncio.Queue[Optional[Dict[str, Any]]]" = asyncio.Queue()

    async def receive(self) -> Optional[Dict[str, Any]]:
        return await self._orders.get()

    def send(self, message: Mapping[str, Any]) -> None:
        self.reports.append(dict(message))
        if message["kind"] == "note" and self.keeps:
            self.order("kept", id=message["id"])

    def order(self, kind: str, **members: Any) -> None:
        self._orders.put_nowait({"kind": kind, **members})

    def die(self) -> None:
        self._orders.put_nowait(None)

    def hello(self, **members: Any) -> None:
        self.order("hello", **{"protocol": 1, "dolphin": "test", "purpose": "run", "resumes": False, **members})

    def start(self, request: str, vehicle: str = "v", name: str = "p", **plan: Any) -> None:
        self.order("start", request=request, vehicle=vehicle, plan={"name": name, **plan}, timeout=60)

    def resume(self, request: str, notes: List[Any], vehicle: str = "v", name: str = "p") -> None:
        self.order("resume", request=request, vehicle=vehicle, plan={"name": name}, timeout=60, notes=notes)

    def stop(self, request: str, vehicle: str = "v") -> None:
        self.order("stop", request=request, vehicle=vehicle)

    def words(self, request: str) -> List[str]:
        """The reports on a request, without estimates and notes."""
        kinds = [r["kind"] for r in self.reports if r.get("request") == request]
        return [kind for kind in kinds if kind not in ("progress", "note")]

    def notes(self, request: str) -> List[Any]:
        """Its notes, as a `resume` has them."""
        found = [r["note"] for r in self.reports if r["kind"] == "note" and r["request"] == request]
        return found[::-1]

    def why(self, request: str) -> Optional[str]:
        """The reason in the last report on a request."""
        last = [r for r in self.reports if r.get("request") == request and r["kind"] != "note"][-1]
        return last.get("why")


async def settled() -> None:
    """Lets all that is ready on the loop happen."""
    for _ in range(30):
        await asyncio.sleep(0)


def converse(adapter: Adapter, script: Callable[[Console], Awaitable[None]], hello: bool = True) -> bool:
    """Runs a script against an adapter; whether the conversation was closed in good order."""

    async def go() -> bool:
        console = Console()
        if hello:
            console.hello()
        conversation = asyncio.ensure_future(adapter.converse(console))
        await script(console)
        console.die()
        return await conversation

    return asyncio.run(go())


class InFolder(unittest.TestCase):
    """A test in a folder of its own, with some examples."""

    examples: List[str] = []

    def setUp(self) -> None:
        self.folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for name in self.examples:
            shutil.copy(os.path.join(EXAMPLES, name), name)

    def write(self, name: str, text: str) -> str:
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)
        return name
