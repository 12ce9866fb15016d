"""The socket of a run (docs/socket.md)."""

from __future__ import annotations

import asyncio
import json
from typing import Any, AsyncIterator, Dict, Optional

from .errors import RequestRefused, RunEnded, RunGone

LONGEST = (1 << 24) + 1
"""Bytes of the longest line of a journal."""


class RunSocket:
    """Requests to the run that listens on `path`."""

    def __init__(self, path: str) -> None:
        self.path = path
        self._reader: Optional[asyncio.StreamReader] = None
        self._writer: Optional[asyncio.StreamWriter] = None
        self._turn = asyncio.Lock()

    async def request(self, name: str, **members: Any) -> Dict[str, Any]:
        """The reply to a request. Raises `RequestRefused` with the run's reason, or `RunGone`: of an input it is then
        unknown whether the run has taken it; the journal shows it."""
        async with self._turn:
            if self._writer is None or self._reader is None:
                self._reader, self._writer = await self._connect()
            try:
                await _send(self._writer, {"request": name, **members})
                line = await self._reader.readline()
            except asyncio.CancelledError:  # the reply would be taken for that of the next request
                await self.close()
                raise
            except OSError as error:
                await self.close()
                raise RunGone(f"{self.path}: {error}") from error
            if not line.endswith(b"\n"):
                await self.close()
                raise RunGone(f"{self.path}: the run closed the connection before it replied to '{name}'")
        return _reply(line)

    async def follow(self) -> AsyncIterator[Dict[str, Any]]:
        """The lines of the journal, from the first to the last one, as they are written."""
        reader, writer = await self._connect()
        try:
            await _send(writer, {"request": "follow"})
            line = await reader.readline()
            if line:
                _reply(line)
            while True:
                line = await reader.readline()
                if not line.endswith(b"\n"):
                    return
                yield json.loads(line)
        except OSError:
            return
        finally:
            writer.close()

    async def close(self) -> None:
        """Closes the connection of requests."""
        if self._writer is not None:
            self._writer.close()
        self._reader = self._writer = None

    async def _connect(self) -> "tuple[asyncio.StreamReader, asyncio.StreamWriter]":
        try:
            return await asyncio.open_unix_connection(self.path, limit=LONGEST)
        except OSError as error:
            raise RunGone(f"{self.path}: the run does not listen: {error.strerror or error}") from error


async def _send(writer: asyncio.StreamWriter, request: Dict[str, Any]) -> None:
    writer.write(json.dumps(request, allow_nan=False).encode() + b"\n")
    await writer.drain()


def _reply(line: bytes) -> Dict[str, Any]:
    reply: Dict[str, Any] = json.loads(line)
    error = reply.get("error")
    if error is None:
        return reply
    kind = RunEnded if error["code"] == "ended" else RequestRefused
    raise kind(error["code"], error["message"])
