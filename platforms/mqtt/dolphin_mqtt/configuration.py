"""sensors.yaml: the broker, and the topics whose messages are inputs. docs/mqtt.md describes it."""

from __future__ import annotations

import os
import ssl
from dataclasses import dataclass
from typing import Mapping, Optional, Tuple, Union

from dolphin.document import Faulty, Reader, Value, parse, steps_of, text_of

QOS = 1
LONGEST_WAIT = 604_800.0
"""Seconds that `every` and `silence` may have at most: a week."""


@dataclass(frozen=True)
class Broker:
    """The broker, and how to log in."""

    host: str
    port: int
    tls: bool
    cafile: Optional[str]
    """The certificates that sign the broker's own; those of the system if there is no such file."""
    username: Optional[str]
    password: Optional[str]

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


@dataclass(frozen=True)
class Input:
    """A topic whose messages are posted under `key`."""

    key: str
    topic: str
    field: Tuple[Union[str, int], ...]
    """The path to the value in a message of JSON; without steps it is the whole message."""
    field_text: str
    is_text: bool
    """The message is a text as it is, not JSON."""
    change: bool
    """Values that equal the last one are left out."""
    every: float
    """Seconds between two posts at least."""
    silence: Optional[float]
    """Seconds without a value after which the sensor is silent."""
    silent: Optional[str]
    """The key under which silence is posted."""
    qos: int
    retained: bool
    """Retained messages are posted, too."""


@dataclass(frozen=True)
class Configuration:
    broker: Broker
    inputs: Tuple[Input, ...]

    def keys(self) -> Tuple[str, ...]:
        """The keys that the program has to declare, each once."""
        found = [key for each in self.inputs for key in (each.key, each.silent) if key is not None]
        return tuple(dict.fromkeys(found))

    def topics(self) -> Mapping[str, int]:
        """The topics to subscribe to, each with the greatest quality of service that an input asks for."""
        found: "dict[str, int]" = {}
        for each in self.inputs:
            found[each.topic] = max(each.qos, found.get(each.topic, 0))
        return found


def read(path: str) -> Configuration:
    """The configuration of a file. Raises `Faulty`, with all faults."""
    return of_text(text_of(path), path)


def of_text(text: str, path: str) -> Configuration:
    """The configuration of a text; names of files are relative to the folder of `path`. Raises `Faulty`."""
    reader = Reader(path)
    found = _Reading(reader, os.path.dirname(path)).configuration(parse(text, path))
    reader.finish()
    return found


BROKER = ("host", "port", "tls", "cafile", "username", "password_file")
INPUT = ("topic", "field", "text", "change", "every", "silence", "silent", "qos", "retained")


class _Reading:
    """From a document to a configuration. Each function reports faults, and gives a value to go on with."""

    def __init__(self, reader: Reader, folder: str) -> None:
        self.reader, self.folder = reader, folder

    def configuration(self, document: Value) -> Configuration:
        known = ("broker", "inputs")
        members = self.reader.members(document, "the configuration", known, needed=known)
        broker = self.broker(members.get("broker") or Value(document.place, {"host": Value(document.place, "none")}))
        entries = self.reader.entries(members.get("inputs"), "'inputs'")
        if "inputs" in members and isinstance(members["inputs"].data, dict) and not entries:
            self.reader.fault(members["inputs"].place, "there is no input")
        return Configuration(broker, tuple(self.input(key, value) for key, value in entries.items()))

    def broker(self, value: Value) -> Broker:
        members = self.reader.members(value, "'broker'", BROKER, needed=("host",))
        cafile = self.cafile(members.get("cafile"))
        tls = self.reader.truth(members.get("tls"), "'tls'", "cafile" in members)
        if "cafile" in members and not tls:
            self.reader.fault(members["cafile"].place, "'cafile' is for TLS, and 'tls' is false")
        username = self.reader.text(members.get("username"), "'username'") or None
        if "password_file" in members and "username" not in members:
            self.reader.fault(members["password_file"].place, "a password needs the member 'username'")
        host = self.reader.text(members.get("host"), "'host'", "none")
        if any(c.isspace() or c in "/\0" for c in host):
            self.reader.fault(members["host"].place, f"'{host}' is not a host, such as localhost or 192.168.1.7")
        return Broker(
            host=host, port=self.whole(members.get("port"), "'port'", 8883 if tls else 1883, 1, 65535), tls=tls,
            cafile=cafile, username=username, password=self.password(members.get("password_file")),
        )

    def cafile(self, value: Optional[Value]) -> Optional[str]:
        if value is None:
            return None
        path = os.path.join(self.folder, self.reader.text(value, "'cafile'"))
        try:
            ssl.create_default_context(cafile=path)
        except (OSError, ValueError) as error:
            why = "has no certificate" if isinstance(error, (ssl.SSLError, ValueError)) else error.strerror
            self.reader.fault(value.place, f"{path}: {why}")
        return path

    def password(self, value: Optional[Value]) -> Optional[str]:
        """The first line of the file."""
        if value is None:
            return None
        path = os.path.join(self.folder, self.reader.text(value, "'password_file'"))
        try:
            lines = text_of(path).splitlines()
        except Faulty as faulty:
            self.reader.fault(value.place, faulty.lines[0].replace(":1:1:", ":", 1))
            return None
        if not lines or not lines[0]:
            self.reader.fault(value.place, f"{path}: its first line has no password")
            return None
        return lines[0]

    def input(self, key: str, value: Value) -> Input:
        members = self.reader.members(value, f"the input '{key}'", INPUT, needed=("topic",))
        field = members.get("field")
        is_text = self.reader.truth(members.get("text"), "'text'")
        if is_text and field is not None:
            self.reader.fault(field.place, "a text has no fields: 'text' and 'field' exclude each other")
        silence = members.get("silence")
        if "silent" in members and silence is None:
            self.reader.fault(members["silent"].place, "'silent' needs 'silence', the seconds after which it is posted")
        return Input(
            key=key, topic=self.topic(members.get("topic")), field=self.field(field),
            field_text=self.reader.text(field, "'field'"), is_text=is_text,
            change=self.reader.truth(members.get("change"), "'change'"),
            every=self.reader.number(members.get("every"), "'every'", 0.0, 0.0, LONGEST_WAIT),
            silence=None if silence is None else self.reader.number(silence, "'silence'", 1.0, 0.1, LONGEST_WAIT),
            silent=self.reader.text(members.get("silent"), "'silent'") or None,
            qos=self.whole(members.get("qos"), "'qos'", QOS, 0, 2),
            retained=self.reader.truth(members.get("retained"), "'retained'"),
        )

    def topic(self, value: Optional[Value]) -> str:
        topic = self.reader.text(value, "'topic'")
        if value is None or not topic:
            return topic
        if "+" in topic or "#" in topic or topic.startswith("$share/"):
            self.reader.fault(value.place, f"'{topic}' stands for several topics: an input has one, without + and #")
        elif "\0" in topic or len(topic.encode(errors="replace")) > 65535:
            self.reader.fault(value.place, "'topic' is not a topic of MQTT, such as hall/climate")
        return topic

    def field(self, value: Optional[Value]) -> Tuple[Union[str, int], ...]:
        text = self.reader.text(value, "'field'")
        if value is None or not text:
            return ()
        steps = steps_of(text, r"[^.\[\]]+")
        if steps is None:
            self.reader.fault(value.place, f"'{text}' is not a field, such as climate.temperature or cells[2]")
        return steps or ()

    def whole(self, value: Optional[Value], what: str, default: int, least: int, most: int) -> int:
        number = self.reader.number(value, what, default, least, most)
        if value is not None and number != int(number):
            self.reader.fault(value.place, f"{what} is a whole number; this is {number}")
        return int(number)
