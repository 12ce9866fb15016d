"""Adapters and suppliers that this very process serves to a run, by way of a bridge."""

from __future__ import annotations

import asyncio
import os
import shlex
import sys
from typing import Awaitable, Callable, List, Optional

from . import bridge
from .channel import LONGEST, Channel, StreamChannel

Converse = Callable[[Channel], Awaitable[object]]


class Hosted:
    """A conversation that takes place in this process, while Dolphin starts `command` as its child for it."""

    def __init__(self, converse: Converse, path: str) -> None:
        self._converse = converse
        self._path = path
        self._server: Optional[asyncio.AbstractServer] = None
        self._conversations: "List[asyncio.Task[object]]" = []

    @property
    def command(self) -> str:
        """The command line for `--platform` or `--supplier`."""
        script = os.path.abspath(bridge.__file__)
        return " ".join(shlex.quote(word) for word in (sys.executable, "-S", "-E", script, self._path))

    async def open(self) -> None:
        self._server = await asyncio.start_unix_server(self._serve, self._path, limit=LONGEST)

    async def close(self) -> None:
        """Ends the conversations that go on."""
        if self._server is not None:
            self._server.close()
        for conversation in self._conversations:
            conversation.cancel()
        if self._conversations:
            await asyncio.wait(self._conversations)

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._conversations.append(task)
        try:
            await self._converse(StreamChannel(reader, writer))
        except asyncio.CancelledError:
            pass
        finally:
            writer.close()
