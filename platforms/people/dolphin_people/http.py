"""A server of HTTP/1.1 on asyncio; h11 knows the protocol. The servers of PyPI that need no compiler put no limit on
the time that the head of a request may take, so one stranger could occupy them; this one limits times, sizes, and the
connections of each address."""

from __future__ import annotations

import asyncio
import collections
import ssl
from dataclasses import dataclass, field
from typing import Awaitable, Callable, Counter, Mapping, Optional, Tuple, TypeVar
from urllib.parse import parse_qsl, urlsplit

import h11
from dolphin.waiting import within

T = TypeVar("T")
HEAD, BODY, REPLY = 75.0, 60.0, 30.0
"""Seconds for the head of a request, which includes the wait for it; for its body; for the client to take a reply."""
CONNECTIONS, OF_ONE_ADDRESS = 512, 64


class TooLarge(Exception):
    """The body of a request is longer than was asked for."""


class _Over(Exception):
    """The connection has ended, or is to end."""


@dataclass
class Request:
    method: str
    path: str
    query: Mapping[str, str]
    headers: Mapping[str, str]
    """By name in small letters."""
    body: Callable[[int], Awaitable[bytes]]
    """The body, of at most so many bytes. Raises `TooLarge`."""


@dataclass
class Response:
    status: int
    body: bytes
    type: str
    headers: Mapping[str, str] = field(default_factory=dict)


Handle = Callable[[Request], Awaitable[Response]]


class Server:
    """Replies to requests by `handle`."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        self._server: Optional[asyncio.AbstractServer] = None
        self._open: Counter[str] = collections.Counter()

    async def open(self, address: str, port: int, context: Optional[ssl.SSLContext] = None) -> int:
        """Listens; the port. Raises `OSError`."""
        self._server = await asyncio.start_server(self._serve, address, port, ssl=context)
        return int(self._server.sockets[0].getsockname()[1])

    def close(self) -> None:
        if self._server is not None:
            self._server.close()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        address = str((writer.get_extra_info("peername") or ("",))[0])
        self._open[address] += 1
        try:
            if self._open[address] <= OF_ONE_ADDRESS and sum(self._open.values()) <= CONNECTIONS:
                await _Connection(reader, writer, self._handle).serve()
        except (_Over, OSError, asyncio.CancelledError):
            pass
        finally:
            self._open[address] -= 1
            if not self._open[address]:
                del self._open[address]
            writer.transport.abort()


class _Connection:
    """One connection, to its end."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, handle: Handle) -> None:
        self._reader, self._writer, self._handle = reader, writer, handle
        self._http = h11.Connection(h11.SERVER, max_incomplete_event_size=16_384)

    async def serve(self) -> None:
        while True:
            try:
                event = await self._within(self._event(), HEAD)
                if not isinstance(event, h11.Request):
                    return
                await self._reply(await self._handle(self._request(event)))
            except h11.RemoteProtocolError as error:
                await self._refuse(error.error_status_hint, "this is no request of HTTP/1.1")
            except TooLarge:
                await self._refuse(413, "this is too large")
            if self._http.our_state is not h11.DONE or self._http.their_state is not h11.DONE:
                return  # after an error, or with a body that was not read
            self._http.start_next_cycle()

    def _request(self, event: h11.Request) -> Request:
        target = urlsplit(event.target.decode("latin-1"))
        headers = {name.decode("latin-1"): value.decode("latin-1") for name, value in event.headers}
        query = dict(parse_qsl(target.query, max_num_fields=20)) if target.query else {}
        return Request(event.method.decode("latin-1"), target.path, query, headers, self._body)

    async def _body(self, most: int) -> bytes:
        return await self._within(self._read(most), BODY)

    async def _read(self, most: int) -> bytes:
        if self._http.they_are_waiting_for_100_continue:
            self._writer.write(self._http.send(h11.InformationalResponse(status_code=100, headers=[])) or b"")
        data = bytearray()
        while True:
            event = await self._event()
            if isinstance(event, h11.EndOfMessage):
                return bytes(data)
            if not isinstance(event, h11.Data):
                raise _Over()
            data += event.data
            if len(data) > most:
                raise TooLarge()

    async def _event(self) -> object:
        while True:
            event = self._http.next_event()
            if event is not h11.NEED_DATA:
                return event
            self._http.receive_data(await self._reader.read(65_536))

    async def _reply(self, response: Response) -> None:
        headers: "list[Tuple[str, str]]" = [
            ("Content-Type", response.type), ("Content-Length", str(len(response.body))), *response.headers.items()]
        if self._http.their_state is h11.SEND_BODY:
            self._http.next_event()  # the end of the request, if it has no body
        if self._http.their_state is not h11.DONE:
            headers.append(("Connection", "close"))
        for event in (h11.Response(status_code=response.status, headers=headers), h11.Data(data=response.body),
                      h11.EndOfMessage()):
            self._writer.write(self._http.send(event) or b"")
        await self._within(self._writer.drain(), REPLY)

    async def _refuse(self, status: int, why: str) -> None:
        if self._http.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            await self._reply(Response(status, why.encode() + b"\n", "text/plain; charset=utf-8", {}))

    @staticmethod
    async def _within(work: Awaitable[T], seconds: float) -> T:
        """The result of the work. Raises `_Over` if it takes longer."""

        async def boxed() -> Tuple[T]:
            return (await work,)

        found = await within(boxed(), seconds)
        if found is None:
            raise _Over()
        return found[0]
