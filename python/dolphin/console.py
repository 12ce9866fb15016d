"""A client of `dolphin console`, by its interface for programs (docs/api.md).

    console = dolphin.Console("http://127.0.0.1:8642")
    number = console.start("abort.dol", speed=60)
    for event in console.events():
        if event.kind == "log":
            print(event.data["text"])
"""

from __future__ import annotations

import hashlib
import hmac
import http.client
import json
import secrets
import ssl
from dataclasses import dataclass
from typing import Any, Dict, Iterator, Mapping, Optional, Sequence
from urllib.parse import parse_qs, quote, urlencode, urlsplit

from .command import setting
from .errors import ConsoleRefused, DolphinError
from .values import to_json

PATIENCE = 30.0
"""Seconds that a reply may take, and that a stream of events may be silent: it beats each second."""


@dataclass(frozen=True)
class ConsoleEvent:
    """An event of the server: `journal`, `log`, `status`, `waiting` ... `id` is its identity, if it has one."""

    kind: str
    data: Any
    id: Optional[str] = None


class Console:
    """The console at `link`, as it prints it: with the token behind `?token=`, and behind `#sha256=` the fingerprint of
    its certificate, which is then checked before anything is sent."""

    def __init__(self, link: str = "http://127.0.0.1:8642", *, token: Optional[str] = None) -> None:
        parts = urlsplit(link)
        if parts.scheme not in ("http", "https") or parts.hostname is None:
            raise ValueError(f"{link} is not a link of a console")
        self._secure = parts.scheme == "https"
        self._host, self._port = parts.hostname, parts.port or (443 if self._secure else 80)
        self._token = token or next(iter(parse_qs(parts.query).get("token", [])), None)
        name, _, digest = parts.fragment.partition("=")
        self._digest = digest.replace(":", "").lower() if name == "sha256" else None
        self.client = secrets.token_hex(16)
        """The key of this client, by which it holds the helm."""

    # Runs.

    def start(
        self, program: str, *, fleet: Optional[str] = None, speed: Optional[float] = None, seed: Optional[int] = None,
        answers: Sequence[str] = (), set: Optional[Mapping[str, Any]] = None, people: bool = False,
    ) -> Any:
        """Starts a run of a program of the console's folder; the run's number. With `people`, its questions are for
        people although the fleet has answers."""
        body = {
            "program": program, "fleet": fleet, "speed": speed, "seed": seed, "answers": list(answers) or None,
            "set": {name: setting(value) for name, value in set.items()} if set else None, "people": people or None,
        }
        return self.post("run", {name: value for name, value in body.items() if value is not None})["run"]

    def status(self) -> Any:
        """The run, its open questions, its outlook, and the client that has the helm."""
        return self.get("status")

    def answer(self, question: int, text: str) -> None:
        """Answers an open question by its number; `text` is an expression."""
        self.post("run/answer", {"question": question, "text": text})

    def post_input(self, key: str, value: Any) -> None:
        """Posts an input, or answers the question of a task that has the prompt `key`."""
        self.post("run/post", {"key": key, "value": to_json(value)})

    def stop(self, all: bool = True) -> None:
        """Stops the run: all of it, or with `all=False` the program alone, which then executes its `onInterrupt`."""
        self.post("run/stop", {"all": all})

    def events(self, last: Optional[str] = None) -> Iterator[ConsoleEvent]:
        """The events of the server, without end; of a run those after the one whose identity is `last`."""
        query = {"client": self.client, **({} if last is None else {"last": last})}
        connection = self._connection()
        try:
            reply = self._ask(connection, "GET", "events?" + urlencode(query), None)
            kind, identity, data = "message", None, []
            while True:
                line = reply.readline()
                if not line:
                    raise DolphinError("the console closed the stream of events")
                name, _, text = line.decode().rstrip("\r\n").partition(":")
                text = text[1:] if text.startswith(" ") else text
                if name == "event":
                    kind = text
                elif name == "id":
                    identity = text
                elif name == "data":
                    data.append(text)
                elif not line.strip() and data:
                    yield ConsoleEvent(kind, json.loads("\n".join(data)), identity)
                    kind, identity, data = "message", None, []
        except OSError as error:
            raise self._unreachable(error) from error
        finally:
            connection.close()

    # Any request.

    def get(self, path: str, /, **query: Any) -> Any:
        """The reply to `GET /api/PATH`: `console.get("file", path="mission.dol")`."""
        return self._request("GET", path + ("?" + urlencode(query, quote_via=quote) if query else ""), None)

    def post(self, path: str, body: Mapping[str, Any]) -> Any:
        """The reply to `POST /api/PATH`."""
        return self._request("POST", path, body)

    def put(self, path: str, body: Mapping[str, Any]) -> Any:
        """The reply to `PUT /api/PATH`."""
        return self._request("PUT", path, body)

    def delete(self, path: str) -> Any:
        """The reply to `DELETE /api/PATH`."""
        return self._request("DELETE", path, {})

    def _request(self, verb: str, path: str, body: Optional[Mapping[str, Any]]) -> Any:
        connection = self._connection()
        try:
            text = self._ask(connection, verb, path, body).read()
        except (OSError, http.client.HTTPException) as error:
            raise self._unreachable(error) from error
        finally:
            connection.close()
        return json.loads(text) if text else None

    def _ask(
        self, connection: http.client.HTTPConnection, verb: str, path: str, body: Optional[Mapping[str, Any]]
    ) -> http.client.HTTPResponse:
        headers = {"Content-Type": "application/json", "X-Dolphin-Client": self.client}
        if self._token is not None:
            headers["Authorization"] = f"Bearer {self._token}"
        data = None if body is None else json.dumps(body, allow_nan=False).encode()
        connection.request(verb, "/api/" + path, data, headers)
        reply = connection.getresponse()
        if reply.status >= 400:
            raise _refusal(reply.status, reply.read())
        return reply

    def _connection(self) -> http.client.HTTPConnection:
        if not self._secure:
            return http.client.HTTPConnection(self._host, self._port, timeout=PATIENCE)
        if self._digest is None:
            return http.client.HTTPSConnection(self._host, self._port, timeout=PATIENCE)
        return _Pinned(self._host, self._port, self._digest)

    def _unreachable(self, error: Exception) -> DolphinError:
        return DolphinError(f"the console at {self._host}:{self._port} cannot be reached: {error}")


class _Pinned(http.client.HTTPSConnection):
    """A connection to the server whose certificate has this SHA-256 digest, whoever signed it."""

    def __init__(self, host: str, port: int, digest: str) -> None:
        context = ssl.create_default_context()
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        super().__init__(host, port, timeout=PATIENCE, context=context)
        self._expected = digest

    def connect(self) -> None:
        super().connect()
        assert isinstance(self.sock, ssl.SSLSocket)
        certificate = self.sock.getpeercert(binary_form=True) or b""
        if not hmac.compare_digest(hashlib.sha256(certificate).hexdigest(), self._expected):
            self.close()
            raise ssl.SSLError("its certificate is another one than the link names")


def _refusal(status: int, text: bytes) -> ConsoleRefused:
    try:
        reply: Dict[str, Any] = json.loads(text)
        error = reply["error"]
        return ConsoleRefused(error["code"], error["message"], status, reply)
    except (ValueError, KeyError, TypeError):
        return ConsoleRefused("no-reply", f"the console replied with status {status}", status, {})
