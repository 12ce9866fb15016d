"""people.yaml: people, and the instructions that programs may give. docs/people.md describes it."""

from __future__ import annotations

import os
import ssl
import unicodedata
from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence, Tuple

import dolphin
from dolphin import templates
from dolphin.document import Place, Reader, Value, near, parse, text_of

PORT = 8470
ACCEPT, SEEN, DECLINED = 60.0, 30.0, 60.0
LONGEST = 604_800.0
"""Seconds that a wait may have at most: a week."""
LONGEST_TEXT = 2_000
"""Characters of an instruction at most."""
KINDS = ("number", "text", "choice", "position", "photo")


@dataclass(frozen=True)
class Listen:
    """The address of the server."""

    address: str
    port: int
    name: Optional[str]
    """The name or address under which phones reach it."""
    pair: Optional[Tuple[str, str]]
    """The files of a certificate and its key, for HTTPS."""

    def tls(self) -> Optional[ssl.SSLContext]:
        """The context of a server with the certificate. Raises `OSError`, `ssl.SSLError` or `ValueError`."""
        return None if self.pair is None else tls(*self.pair)


@dataclass(frozen=True)
class Answer:
    """The value that a person gives with the report that an instruction is done, and the input that it becomes."""

    kind: str
    """One of `KINDS`."""
    input: str
    unit: Optional[str] = None
    least: Optional[float] = None
    most: Optional[float] = None
    choices: Tuple[str, ...] = ()


@dataclass(frozen=True)
class Rule:
    """An instruction. Its name may have parameters, which the text uses: `launch_${boat}`."""

    name: str
    text: str
    answer: Optional[Answer]
    within: Optional[float]
    """Seconds, from acceptance on, after which it has failed."""
    acknowledge: bool
    """A person who has accepted it and is to stop has to report that the work rests."""


@dataclass(frozen=True)
class Entry:
    """A person."""

    name: str
    skills: Tuple[str, ...]
    position: Optional[dolphin.Position]
    locate: bool
    """The phone's position is used."""


@dataclass(frozen=True)
class Configuration:
    listen: Listen
    people: Tuple[Entry, ...]
    rules: Tuple[Rule, ...]
    others: bool
    """Names of plans without a rule are shown as they are."""
    accept: float
    """Seconds within which an instruction has to be accepted."""
    seen: float
    """Seconds without a word from a page after which its person has no link."""
    declined: float
    """Seconds for which a person is not ready after declining."""
    photos: str
    """The folder for photos."""

    def rule(self, name: str) -> Optional[Tuple[Rule, str]]:
        """The instruction that a plan's name stands for, and its text.

        Names without parameters go before those with them, and all before those that are shown as they are."""
        found = templates.choose(((rule.name, rule) for rule in self.rules), name)
        if found is not None:
            rule, parameters = found
            return rule, str(templates.substitute(rule.text, parameters))
        return (Rule(name, name, None, None, True), name) if self.others else None


def read(path: str) -> Configuration:
    """The configuration of a file. Raises `Faulty`, with all faults."""
    return of_text(text_of(path), path)


def of_text(text: str, path: str) -> Configuration:
    """The configuration of a text; names of files are relative to the folder of `path`. Raises `Faulty`."""
    reader = Reader(path)
    found = _Reading(reader, os.path.dirname(path)).configuration(parse(text, path))
    reader.finish()
    return found


MEMBERS = ("listen", "people", "instructions", "others", "accept", "seen", "declined", "photos")
LISTEN = ("address", "port", "name", "certificate", "key")
PERSON = ("skills", "position", "locate")
OF_NUMBERS = ("unit", "from", "to")
RULE = ("text", "within", "acknowledge", "answer", "input", "choices", *OF_NUMBERS)


class _Reading:
    """From a document to a configuration. Each function reports faults, and gives a value to go on with."""

    def __init__(self, reader: Reader, folder: str) -> None:
        self.reader, self.folder = reader, folder

    def configuration(self, document: Value) -> Configuration:
        members = self.reader.members(document, "the configuration", MEMBERS, needed=("people",))
        people = self.people(members.get("people"))
        entries = self.reader.entries(members.get("instructions"), "'instructions'")
        keys = {} if members.get("instructions") is None else members["instructions"].keys
        rules = tuple(self.rule(name, value, keys[name]) for name, value in entries.items())
        photos = self.reader.text(members.get("photos"), "'photos'", "photos")
        return Configuration(
            listen=self.listen(members.get("listen")), people=people, rules=rules,
            others=self.reader.truth(members.get("others"), "'others'", not rules),
            accept=self.seconds(members, "accept", ACCEPT), seen=self.seconds(members, "seen", SEEN),
            declined=self.seconds(members, "declined", DECLINED, least=0.0),
            photos=os.path.join(self.folder, photos),
        )

    def seconds(self, members: Mapping[str, Value], name: str, default: float, least: float = 1.0) -> float:
        return self.reader.number(members.get(name), f"'{name}'", default, least, LONGEST)

    # The server.

    def listen(self, value: Optional[Value]) -> Listen:
        members = {} if value is None else self.reader.members(value, "'listen'", LISTEN)
        port = self.reader.number(members.get("port"), "'port'", PORT, 1, 65535)
        if "port" in members and port != int(port):
            self.reader.fault(members["port"].place, f"'port' is a whole number; this is {port}")
        for one, other in (("certificate", "key"), ("key", "certificate")):
            if one in members and other not in members:
                self.reader.fault(members[one].place, f"'{one}' needs the member '{other}'")
        certificate, key = (self.path(members.get(name), f"'{name}'") for name in ("certificate", "key"))
        found = Listen(
            address=self.host(members.get("address"), "'address'") or "127.0.0.1", port=int(port),
            name=self.host(members.get("name"), "'name'"),
            pair=None if certificate is None or key is None else (certificate, key))
        self.load(found, members.get("certificate"))
        return found

    def host(self, value: Optional[Value], what: str) -> Optional[str]:
        host = self.reader.text(value, what)
        if value is not None and any(c.isspace() or c in "/\0#?@" for c in host):
            self.reader.fault(value.place, f"{what} is a name or an address, such as ship.local or 192.168.1.7")
        return host or None

    def path(self, value: Optional[Value], what: str) -> Optional[str]:
        return None if value is None else os.path.join(self.folder, self.reader.text(value, what))

    def load(self, found: Listen, value: Optional[Value]) -> None:
        """Reports a certificate that cannot be used."""
        if found.pair is None or value is None:
            return
        certificate, key = found.pair
        try:
            found.tls()
        except ssl.SSLError:
            self.reader.fault(value.place, f"{certificate} and {key} are not a certificate and its key, both in PEM")
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or str(error)
            self.reader.fault(value.place, f"{certificate}, {key}: {why}")

    # People.

    def people(self, value: Optional[Value]) -> Tuple[Entry, ...]:
        entries = self.reader.entries(value, "'people'")
        if value is not None and isinstance(value.data, dict) and not entries:
            self.reader.fault(value.place, "there are no people")
        return tuple(self.person(name, item, value.keys[name]) for name, item in entries.items()) if value else ()

    def person(self, name: str, value: Value, place: Place) -> Entry:
        if not is_plain(name, 64):
            self.reader.fault(place, "a name has 1 to 64 characters, and no control characters")
        members = self.reader.members(value, f"the person '{name}'", PERSON)
        locate = self.reader.truth(members.get("locate"), "'locate'")
        if "position" not in members and not locate:
            self.reader.fault(value.place, f"the person '{name}' needs the member 'position', or 'locate: true'")
        skills = self.reader.listed(members.get("skills"), "'skills'", lambda item: self.reader.text(item, "a skill"))
        return Entry(name, skills, self.position(members.get("position")), locate)

    def position(self, value: Optional[Value]) -> Optional[dolphin.Position]:
        if value is None:
            return None
        needed = ("latitude", "longitude")
        members = self.reader.members(value, "'position'", (*needed, "height"), needed=needed)
        return dolphin.Position(
            self.reader.number(members.get("latitude"), "'latitude'", 0.0, -90, 90),
            self.reader.number(members.get("longitude"), "'longitude'", 0.0, -180, 180),
            self.reader.number(members.get("height"), "'height'", 0.0, -20_000, 1_000_000))

    # Instructions.

    def rule(self, name: str, value: Value, place: Place) -> Rule:
        templates.check_name(self.reader, name, place)
        members = self.reader.members(value, f"the instruction '{name}'", RULE, needed=("text",))
        text = self.reader.text(members.get("text"), "'text'")
        if "text" in members:
            templates.check_template(self.reader, name, members["text"], "instruction")
            if len(text) > LONGEST_TEXT:
                self.reader.fault(members["text"].place, f"'text' has {len(text)} characters: at most {LONGEST_TEXT}")
        return Rule(
            name=name, text=text, answer=self.answer(members, value.place),
            within=self.seconds(members, "within", 0.0) if "within" in members else None,
            acknowledge=self.reader.truth(members.get("acknowledge"), "'acknowledge'", True))

    def answer(self, members: Mapping[str, Value], place: Place) -> Optional[Answer]:
        kind = self.reader.text(members.get("answer"), "'answer'")
        of_kinds = {"number": OF_NUMBERS, "choice": ("choices",)}
        for name in ("input", "choices", *OF_NUMBERS):
            if name in members and (not kind or (name != "input" and name not in of_kinds.get(kind, ()))):
                wanted = "answer" if name == "input" else next(
                    f"answer: {each}" for each, names in of_kinds.items() if name in names)
                self.reader.fault(members[name].place, f"'{name}' needs '{wanted}'")
        if not kind:
            return None
        if kind not in KINDS:
            what = f"an answer of the kind '{kind}' does not exist{near(kind, KINDS)}"
            self.reader.fault(members["answer"].place, what)
        if "input" not in members:
            self.reader.fault(place, "'answer' needs the member 'input', under which the program gets it")
        choices = self.reader.listed(
            members.get("choices"), "'choices'", lambda item: self.reader.text(item, "a choice"))
        if kind == "choice" and len(set(choices)) < 2:
            self.reader.fault(members.get("choices", members["answer"]).place, "'choices' lists at least two texts")
        least, most = (self.limit(members.get(name), f"'{name}'") for name in ("from", "to"))
        if least is not None and most is not None and least > most:
            self.reader.fault(members["to"].place, f"'to' is less than 'from', {least:g}")
        return Answer(
            kind=kind, input=self.reader.text(members.get("input"), "'input'"),
            unit=self.reader.text(members.get("unit"), "'unit'") or None, least=least, most=most, choices=choices)

    def limit(self, value: Optional[Value], what: str) -> Optional[float]:
        return None if value is None else self.reader.number(value, what)


def is_plain(text: str, most: int) -> bool:
    """Whether a text has 1 to `most` characters, and none of control."""
    return 0 < len(text) <= most and not any(unicodedata.category(c)[0] == "C" for c in text)


def tls(certificate: str, key: str) -> ssl.SSLContext:
    """The context of a server with this certificate. Raises `OSError`, `ssl.SSLError` or `ValueError`."""
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.load_cert_chain(certificate, key, password=_no_password)
    return context


def _no_password() -> str:
    raise ValueError("the key is encrypted: store it without a password, readable by its owner alone")


def problem_of(answer: Optional[Answer], value: Any, photos: Sequence[str]) -> Optional[str]:
    """The reason why a value does not answer, in words for the person; `None` if it does. `photos` lists the names of
    those that the person has sent.

    >>> problem_of(Answer("number", "depth", least=0, most=50), 60, ())
    'give a number from 0 to 50'
    """
    if answer is None:
        return None if value is None else "this instruction takes no answer"
    return _PROBLEMS[answer.kind](answer, value, photos)


def _of_number(answer: Answer, value: Any, _photos: Sequence[str]) -> Optional[str]:
    limits = "".join(f" {word} {x:.17g}" for word, x in (("from", answer.least), ("to", answer.most)) if x is not None)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= 1e15
    if is_number and (answer.least is None or value >= answer.least) and (answer.most is None or value <= answer.most):
        return None
    return f"give a number{limits}"


def _of_text(_answer: Answer, value: Any, _photos: Sequence[str]) -> Optional[str]:
    is_right = isinstance(value, str) and value.strip() and len(value) <= LONGEST_TEXT
    return None if is_right else f"give a text of 1 to {LONGEST_TEXT} characters"


def _of_choice(answer: Answer, value: Any, _photos: Sequence[str]) -> Optional[str]:
    return None if value in answer.choices else f"choose one of {', '.join(answer.choices)}"


def _of_position(_answer: Answer, value: Any, _photos: Sequence[str]) -> Optional[str]:
    return None if position_of(value) is not None else "give a latitude from -90 to 90 and a longitude from -180 to 180"


def _of_photo(_answer: Answer, value: Any, photos: Sequence[str]) -> Optional[str]:
    return None if value in photos else "take a photo first"


_PROBLEMS = {"number": _of_number, "text": _of_text, "choice": _of_choice, "position": _of_position, "photo": _of_photo}


def position_of(value: Any) -> Optional[dolphin.Position]:
    """The position of an object of JSON with `latitude`, `longitude`, and perhaps `height`; `None` if it is not one."""
    needed = {"latitude", "longitude"}
    if not isinstance(value, dict) or not needed <= set(value) <= {*needed, "height"}:
        return None
    numbers = [value["latitude"], value["longitude"], 0.0 if value.get("height") is None else value["height"]]
    limits = ((-90, 90), (-180, 180), (-20_000, 1_000_000))
    for number, (least, most) in zip(numbers, limits):
        if isinstance(number, bool) or not isinstance(number, (int, float)) or not least <= number <= most:
            return None
    return dolphin.Position(*(float(number) for number in numbers))
