"""The page, and the requests that it sends: docs/people.md, "The interface of the page"."""

from __future__ import annotations

import hmac
import json
import os
import re
import secrets
import time
from typing import Any, Callable, Dict, Mapping, Optional

import dolphin

from .configuration import position_of
from .http import Request, Response
from .person import Gone, Person, Refused

LARGEST, LARGEST_PHOTO = 16_384, 16 << 20
"""Bytes of a request, and of a photo, at most."""
STARTING = 10.0
"""Seconds in which an adapter that was started again may yet get to know the instructions of before."""
_FILES = {"/": ("index.html", "text/html"), "/page.js": ("page.js", "text/javascript"),
          "/page.css": ("page.css", "text/css")}
_PHOTOS = {"image/jpeg": ("jpg", rb"\xff\xd8\xff"), "image/png": ("png", rb"\x89PNG\r\n\x1a\n"),
           "image/webp": ("webp", rb"RIFF....WEBP"), "image/heic": ("heic", rb"....ftyp(?:heic|heix|mif1|msf1)")}
_POLICY = ("default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' blob: data:; "
           "base-uri 'none'; form-action 'none'; frame-ancestors 'none'")
_HEADERS = {"Content-Security-Policy": _POLICY, "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
            "Cache-Control": "no-store"}


def token_of(secret: bytes, name: str) -> str:
    """The token of a person, in links: it follows from the secret, so a link stays good when the adapter is started
    again."""
    return hmac.new(secret, name.encode(), "sha256").hexdigest()[:32]


def secret_of(path: str) -> bytes:
    """The secret of a configuration: in the file `path`, which is made at the first time, for its owner alone. Raises
    `OSError` or `ValueError`."""
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        pass
    else:
        with open(descriptor, "w", encoding="ascii") as file:
            file.write(secrets.token_hex(32) + "\n")
    with open(path, encoding="ascii", errors="replace") as file:
        text = file.read().strip()
    if not re.fullmatch(r"[0-9a-f]{64}", text):
        raise ValueError(f"{path}: is not a secret of dolphin-people: remove it, and all links become new")
    return bytes.fromhex(text)


class Site:
    """Replies for the people of an adapter."""

    def __init__(self, people: Mapping[str, Person], photos: str, is_restarted: Callable[[], bool],
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._people, self._photos, self._clock = people, photos, clock
        self._began, self._is_restarted = clock(), is_restarted
        self._folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page")

    async def reply(self, request: Request) -> Response:
        """The reply to a request. Nothing of a request without a token is read but its head."""
        if request.path in _FILES and request.method in ("GET", "HEAD"):
            return self._file(*_FILES[request.path])
        person = self._person(request.headers.get("authorization", ""))
        if person is None:
            return _error(401, "the link is not known: ask for a new one")
        ways = {("GET", "/state"): self._state, ("POST", "/act"): self._act, ("POST", "/duty"): self._duty,
                ("POST", "/position"): self._position, ("POST", "/photo"): self._photo}
        way = ways.get((request.method, request.path))
        if way is None:
            return _error(404, "there is nothing here")
        person.was_seen()
        try:
            return _json(200, await way(person, request))
        except Refused as refused:
            return _error(400, str(refused))
        except Gone as gone:
            if self._is_restarted() and self._clock() < self._began + STARTING:
                return _error(503, "not ready yet")
            return _error(409, str(gone))
        except dolphin.Failed as failed:
            return _error(503, failed.why)

    def _file(self, name: str, type_: str) -> Response:
        with open(os.path.join(self._folder, name), "rb") as file:
            return Response(200, file.read(), f"{type_}; charset=utf-8", _HEADERS)

    def _person(self, authorization: str) -> Optional[Person]:
        token = authorization[7:] if authorization[:7].lower() == "bearer " else ""
        found = [person for known, person in self._people.items()
                 if hmac.compare_digest(known.encode(), token.encode(errors="replace"))]
        return found[0] if found else None

    async def _state(self, person: Person, request: Request) -> Mapping[str, Any]:
        return await person.state(request.query.get("after"))

    async def _act(self, person: Person, request: Request) -> Mapping[str, Any]:
        members = await _members(request)
        why = members.get("why", "")
        if not all(isinstance(each, str) for each in (members.get("request"), members.get("act"), why)):
            raise Refused("'request', 'act' and 'why' are texts")
        await person.decide(members["request"], members["act"], members.get("value"), why)
        return {"ok": True}

    async def _duty(self, person: Person, request: Request) -> Mapping[str, Any]:
        duty = (await _members(request)).get("duty")
        if not isinstance(duty, bool):
            raise Refused("'duty' is true or false")
        person.set_duty(duty)
        return {"ok": True}

    async def _position(self, person: Person, request: Request) -> Mapping[str, Any]:
        position = position_of(await _members(request))
        if position is None:
            raise Refused("this is not a position in degrees")
        if not person.entry.locate:
            raise Refused("the position of this phone is not used")
        person.place(position)
        return {"ok": True}

    async def _photo(self, person: Person, request: Request) -> Mapping[str, Any]:
        open_ = person.wants_photo
        if open_ is None:
            raise Gone("no photo is wanted now")
        if len(open_.photos) >= 20:
            raise Refused("there are 20 photos already")
        body = await request.body(LARGEST_PHOTO)
        ending, head = _PHOTOS.get(request.headers.get("content-type", ""), ("", rb"(?!)"))
        if not re.match(head, body, re.DOTALL):
            raise Refused("this is no photo in JPEG, PNG, WebP or HEIC")
        try:
            name = self._keep(person.name, ending, body)
        except OSError as error:
            raise Refused(f"the photo cannot be kept: {error.strerror}") from error
        open_.photos.append(name)
        return {"photo": name}

    def _keep(self, person: str, ending: str, body: bytes) -> str:
        """Writes a photo to the disk; its name."""
        os.makedirs(self._photos, exist_ok=True)
        tame = re.sub(r"\W", "_", person)
        name = f"{tame}-{time.strftime('%Y%m%d-%H%M%S')}-{secrets.token_hex(3)}.{ending}"
        path = os.path.join(self._photos, name)
        try:
            with open(path, "xb") as file:
                file.write(body)
                file.flush()
                os.fsync(file.fileno())
        except OSError:
            if os.path.exists(path):
                os.remove(path)
            raise
        return name


async def _members(request: Request) -> Dict[str, Any]:
    """The object of JSON in a request. Raises `Refused`."""
    try:
        found = json.loads(await request.body(LARGEST), parse_constant=_no_constant)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise Refused("this is not an object of JSON")
    return found


def _no_constant(name: str) -> None:
    raise ValueError(name)


def _json(status: int, value: Mapping[str, Any]) -> Response:
    return Response(status, json.dumps(value).encode() + b"\n", "application/json", _HEADERS)


def _error(status: int, why: str) -> Response:
    return _json(status, {"error": why})
