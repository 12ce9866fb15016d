"""Lines of JSON to and from Dolphin: on the standard streams of this process, or on a stream of asyncio."""

from __future__ import annotations

import asyncio
import json
import os
import queue
import sys
import threading
from typing import Any, Dict, Mapping, Optional

LONGEST = 1 << 20
"""Bytes of the longest line of the protocols of platforms and suppliers."""

Message = Dict[str, Any]


def encode(message: Mapping[str, Any]) -> bytes:
    """A message as a line. Numbers that JSON does not have are an error, and so are lines that are too long."""
    line = json.dumps(message, allow_nan=False, separators=(",", ":")).encode() + b"\n"
    if len(line) > LONGEST:
        raise ValueError(f"a message of {len(line)} bytes is longer than {LONGEST}")
    return line


def decode(line: bytes) -> Optional[Message]:
    """The message of a line; `None` if the line is not an object of JSON, which is reported on standard error."""
    try:
        message = json.loads(line)
    except ValueError:
        message = None
    if not isinstance(message, dict):
        print(f"ignored: {line[:200]!r} is not an object of JSON", file=sys.stderr)
        return None
    return message


class Channel:
    """Messages in both directions. `receive` and `drain` are coroutines; `send` never blocks."""

    async def receive(self) -> Optional[Message]:
        """The next message; `None` once the other side has ended."""
        while True:
            line = await self._line()
            if line is None:
                return None
            message = decode(line)
            if message is not None:
                return message

    def send(self, message: Mapping[str, Any]) -> None:
        self._write(encode(message))

    async def drain(self) -> None:
        """Returns when all that was sent has left this process."""

    async def _line(self) -> Optional[bytes]:
        raise NotImplementedError

    def _write(self, line: bytes) -> None:
        raise NotImplementedError


class StandardStreams(Channel):
    """The standard streams of this process, by two threads. From now on `print` writes to standard error, so that it
    does not get between the lines."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._incoming: "asyncio.Queue[Optional[bytes]]" = asyncio.Queue()
        self._outgoing: "queue.SimpleQueue[object]" = queue.SimpleQueue()
        self._output = os.dup(1)
        os.dup2(2, 1)
        sys.stdout.flush()
        for work in (self._read, self._write_all):
            threading.Thread(target=work, daemon=True).start()

    async def _line(self) -> Optional[bytes]:
        return await self._incoming.get()

    def _write(self, line: bytes) -> None:
        self._outgoing.put(line)

    async def drain(self) -> None:
        written = threading.Event()
        self._outgoing.put(written)
        await self._loop.run_in_executor(None, written.wait, 5.0)

    def _hand_over(self, line: Optional[bytes]) -> None:
        try:
            self._loop.call_soon_threadsafe(self._incoming.put_nowait, line)
        except RuntimeError:  # the loop is closed: this process is about to end
            pass

    def _read(self) -> None:
        with open(0, "rb", closefd=False) as lines:
            for line in lines:
                if line.endswith(b"\n"):  # a torn line is of a process that died in the middle of it
                    self._hand_over(line)
        self._hand_over(None)

    def _write_all(self) -> None:
        is_open = True
        while True:
            item = self._outgoing.get()
            if isinstance(item, threading.Event):
                item.set()
            elif is_open and isinstance(item, bytes):
                is_open = self._write_one(item)

    def _write_one(self, line: bytes) -> bool:
        rest = memoryview(line)
        try:
            while rest:
                rest = rest[os.write(self._output, rest):]
            return True
        except OSError:  # the reader has gone: as the end of the input
            self._hand_over(None)
            return False


class StreamChannel(Channel):
    """A stream of asyncio."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader, self._writer = reader, writer

    async def _line(self) -> Optional[bytes]:
        try:
            line = await self._reader.readline()
        except (ConnectionError, ValueError):
            return None
        return line if line.endswith(b"\n") else None

    def _write(self, line: bytes) -> None:
        if not self._writer.is_closing():
            self._writer.write(line)

    async def drain(self) -> None:
        try:
            await self._writer.drain()
        except ConnectionError:
            pass
