"""Shared by the tests: a run that listens on a socket, in this process."""

from __future__ import annotations

import asyncio
import json
import os
from typing import Any, Callable, Dict, List, Optional, Tuple

TEXT = """broker: {host: localhost}
inputs:
  quay: {topic: harbour/quay, field: smoke.level, change: true, every: 10, silence: 60, silent: lost}
  door: {topic: harbour/door, text: true, retained: true, qos: 2}
"""


class FakeRun:
    """A run with the socket beside `journal`, that declares these inputs, and keeps its pairs in `posts`."""

    def __init__(self, journal: str, inputs: List[str]) -> None:
        self.journal, self.inputs = journal, inputs
        self.posts: List[Tuple[str, Any]] = []
        self.refusals: Dict[str, Tuple[str, str]] = {}
        """By requests: the code and the message of an error."""
        self._lines: List[Dict[str, Any]] = []
        self._is_alive = False
        self._server: Optional[asyncio.AbstractServer] = None
        self._writers: List[asyncio.StreamWriter] = []
        self._followers: List[asyncio.StreamWriter] = []

    async def open(self) -> "FakeRun":
        self._lines = [{
            "format": "dolphin-journal", "version": 1, "program": {"path": "m.dol", "md5": "0"}, "platform": "sim",
            "seed": 0, "speed": 1, "started": "2026-01-01T00:00:00Z"}]
        self._keep()
        self._is_alive = True
        self._server = await asyncio.start_unix_server(self._serve, self.journal + ".sock")
        return self

    def end(self) -> None:
        """The run ends in good order."""
        self._lines.append({"kind": "end", "time": 1, "transitions": 0, "ending": "completed"})
        self._keep()
        for writer in self._followers:
            writer.write(json.dumps(self._lines[-1]).encode() + b"\n")
        self.die()

    def die(self) -> None:
        """The console dies: connections end, and the socket stays."""
        assert self._server is not None
        self._is_alive = False
        self._server.close()
        for writer in self._writers:
            writer.close()
        self._writers, self._followers = [], []

    def _keep(self) -> None:
        with open(self.journal, "w", encoding="utf-8") as file:
            file.write("".join(json.dumps(line) + "\n" for line in self._lines))

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if not self._is_alive:  # it waited to be served as the run died
            writer.close()
            return
        self._writers.append(writer)
        try:
            while True:
                line = await reader.readline()
                if not line:
                    return
                request = json.loads(line)
                writer.write(json.dumps(self._reply(request)).encode() + b"\n")
                if request["request"] == "follow" and "follow" not in self.refusals:
                    for each in self._lines:
                        writer.write(json.dumps(each).encode() + b"\n")
                    self._followers.append(writer)
        except (ConnectionError, asyncio.CancelledError):  # cancelled as the test ends
            pass

    def _reply(self, request: Dict[str, Any]) -> Dict[str, Any]:
        name = request["request"]
        if name in self.refusals:
            code, message = self.refusals[name]
            return {"error": {"code": code, "message": message}}
        if name == "status":
            return {"ok": True, "time": 0.5, "inputs": self.inputs, "questions": []}
        if name == "post":
            self.posts.append((request["key"], request["value"]))
        return {"ok": True, "time": 0.5}


class FakeBroker:
    """A broker of which a test decides on the messages: `self.hear(topic, payload, retained)`."""

    def __init__(self) -> None:
        self.is_open: Optional[bool] = None
        self.topics: Dict[str, int] = {}
        self.hear: Callable[[str, bytes, bool], None] = lambda topic, payload, retained: None

    def connect(self, broker: Any, topics: Any, hear: Any, remarks: Any) -> "FakeBroker":
        self.topics, self.hear = dict(topics), hear
        return self

    def open(self) -> None:
        self.is_open = True

    def close(self) -> None:
        self.is_open = False


def beside(name: str) -> str:
    """A file of the adapter."""
    return os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), name)
