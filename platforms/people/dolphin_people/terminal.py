"""A person at a terminal: the same requests as those of the page, by the standard library."""

from __future__ import annotations

import json
import ssl
import sys
import threading
import time
import urllib.error
import urllib.request
from typing import Any, Dict, List, Mapping, Optional, Tuple
from urllib.parse import quote, urlsplit

HELP = """accept             take the instruction
decline [reason]   do not take it
done [answer]      report that it is done; a position is two numbers: done 41.185 -8.706
cannot reason      report that it cannot be done
stopped            report that the work rests
break, back        be off duty, and on duty again
quit               leave; without a page or a terminal the link is lost"""


class Refusal(Exception):
    """A reply that is an error, with its status."""

    def __init__(self, status: int, why: str) -> None:
        super().__init__(why)
        self.status = status


class Connection:
    """Requests to the server of a link."""

    def __init__(self, link: str, cafile: Optional[str]) -> None:
        parts = urlsplit(link)
        if parts.scheme not in ("http", "https") or not parts.netloc or not parts.fragment:
            raise ValueError(f"'{link}' is not a link, such as http://127.0.0.1:8470/#TOKEN")
        self._base, self._token = f"{parts.scheme}://{parts.netloc}", parts.fragment
        handlers: List[urllib.request.BaseHandler] = [urllib.request.ProxyHandler({})]
        if parts.scheme == "https":
            handlers.append(urllib.request.HTTPSHandler(context=ssl.create_default_context(cafile=cafile)))
        self._opener = urllib.request.build_opener(*handlers)

    def get(self, path: str) -> Mapping[str, Any]:
        return self._send(urllib.request.Request(self._base + path))

    def post(self, path: str, members: Mapping[str, Any]) -> Mapping[str, Any]:
        return self._send(urllib.request.Request(self._base + path, json.dumps(members).encode(), method="POST"))

    def _send(self, request: urllib.request.Request) -> Mapping[str, Any]:
        """The reply. Raises `Refusal`, or `OSError` without one."""
        request.add_header("Authorization", f"Bearer {self._token}")
        try:
            with self._opener.open(request, timeout=20) as reply:
                found: Mapping[str, Any] = json.loads(reply.read())
                return found
        except urllib.error.HTTPError as error:
            try:
                why = str(json.loads(error.read())["error"])
            except (ValueError, KeyError, TypeError):
                why = str(error)
            raise Refusal(error.code, why) from None


class Terminal:
    """The conversation: one thread follows the state, this one reads lines."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._state: Dict[str, Any] = {}
        self._shown: Tuple[Any, ...] = ()
        self._notices = 0
        self.status: Optional[int] = None
        """The status to end with, if the link is not known."""

    def follow(self) -> None:
        """Prints changes, for as long as the process lives."""
        is_connected = True
        while self.status is None:
            try:
                after = f"?after={quote(self._state['version'])}" if self._state and is_connected else ""
                self._state = dict(self._connection.get(f"/state{after}"))
                is_connected = True
                self._show()
            except Refusal as refusal:
                if refusal.status == 401:
                    print(f"dolphin-people: {refusal}", file=sys.stderr, flush=True)
                    self.status = 2
                time.sleep(1)
            except (OSError, ValueError):
                if is_connected:
                    print(f"no connection since {time.strftime('%H:%M:%S')}", flush=True)
                    self._shown = ()
                is_connected = False
                time.sleep(1)

    def _show(self) -> None:
        open_ = self._state["instruction"]
        shown = (self._state["duty"], None if open_ is None else (open_["request"], open_["state"]))
        for notice in self._state["notices"]:
            if notice["number"] > self._notices:
                self._notices = notice["number"]
                print(f"* {notice['text']}", flush=True)
        if shown == self._shown:
            return
        self._shown = shown
        print(self._line(open_), flush=True)

    def _line(self, open_: Optional[Mapping[str, Any]]) -> str:
        if open_ is None:
            return "nothing to do now" if self._state["duty"] else "you have a break; 'back' ends it"
        left = "" if open_["remaining"] is None else f" ({open_['remaining']:.0f} s left)"
        if open_["state"] == "offered":
            return f"NEW: {open_['text']}{left}\n  accept, or decline [reason]"
        if open_["state"] == "accepted":
            return f"YOURS: {open_['text']}{left}\n  done{_wanted(open_['answer'])}, or cannot reason"
        return f"STOP, this is no longer wanted: {open_['text']}\n  stopped, once the work rests"

    def obey(self, line: str) -> None:
        """Carries out a line, and prints the refusal if there is one."""
        word, _, rest = line.strip().partition(" ")
        if not word or word == "help":
            print(HELP, flush=True)
            return
        try:
            if word in ("break", "back"):
                self._connection.post("/duty", {"duty": word == "back"})
                return
            open_ = self._state.get("instruction")
            if word not in ("accept", "decline", "done", "cannot", "stopped"):
                print(f"'{word}' is no command; 'help' lists them", flush=True)
            elif open_ is None:
                print("there is no instruction", flush=True)
            else:
                self._decide(open_, word, rest.strip())
        except Refusal as refusal:
            print(str(refusal), flush=True)
        except (OSError, ValueError) as error:
            print(f"not sent: {error}", flush=True)

    def _decide(self, open_: Mapping[str, Any], act: str, rest: str) -> None:
        members: Dict[str, Any] = {"request": open_["request"], "act": act}
        if act == "done":
            if open_["answer"] is not None or rest:
                members["value"] = value_of((open_["answer"] or {"kind": "text"})["kind"], rest)
        elif rest:
            members["why"] = rest
        self._connection.post("/act", members)


def _wanted(answer: Optional[Mapping[str, Any]]) -> str:
    if answer is None:
        return ""
    if answer["kind"] == "choice":
        return f" {'|'.join(answer['choices'])}"
    unit = f" in {answer['unit']}" if answer.get("unit") else ""
    return " LATITUDE LONGITUDE" if answer["kind"] == "position" else f" {answer['kind'].upper()}{unit}"


def value_of(kind: str, text: str) -> Any:
    """The value of an answer that was typed. What is not right is refused by the server.

    >>> value_of("position", "41.185 -8.706"), value_of("number", "12"), value_of("choice", "red")
    ({'latitude': 41.185, 'longitude': -8.706}, 12, 'red')
    """
    if kind == "position":
        words = text.replace(",", " ").split()
        return {"latitude": number_of(words[0]), "longitude": number_of(words[1])} if len(words) == 2 else text
    return number_of(text) if kind == "number" else text


def number_of(text: str) -> Any:
    for type_ in (int, float):
        try:
            return type_(text)
        except ValueError:
            pass
    return text


def take_part(link: str, cafile: Optional[str]) -> int:
    """Takes part until the input ends or has `quit`; the exit status."""
    try:
        terminal = Terminal(Connection(link, cafile))
    except (OSError, ValueError) as error:
        print(f"dolphin-people: {error}", file=sys.stderr)
        return 2
    threading.Thread(target=terminal.follow, daemon=True).start()
    try:
        for line in sys.stdin:
            if line.strip() == "quit" or terminal.status is not None:
                break
            terminal.obey(line)
    except KeyboardInterrupt:
        return 130
    return terminal.status or 0
