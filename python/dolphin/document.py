"""YAML whose every value knows its line and column, and readers that report all that is wrong with it: for the
configurations of adapters. It needs PyYAML, so `import dolphin` does not load it."""

from __future__ import annotations

import difflib
import math
import re
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Tuple, Union

import yaml

MOST_VALUES = 100_000
"""Aliases can make a short text a large document: it is refused from this number of values on."""


class Place(NamedTuple):
    line: int
    column: int


class Fault(NamedTuple):
    """A fault at a place of a file, with the remedy."""

    place: Place
    what: str


class Faulty(Exception):
    """A document that cannot be used; `why` lists its faults."""

    def __init__(self, path: str, faults: Iterable[Fault]) -> None:
        self.lines = [f"{path}:{fault.place.line}:{fault.place.column}: {fault.what}" for fault in sorted(set(faults))]
        more = "" if len(self.lines) == 1 else f" (and {len(self.lines) - 1} more: --check lists them)"
        self.why = self.lines[0] + more
        super().__init__("\n".join(self.lines))


@dataclass(frozen=True)
class Value:
    """A value at a place: a scalar of Python, a tuple of values, or a dictionary of them."""

    place: Place
    data: Any
    keys: Dict[str, Place] = field(default_factory=dict, compare=False)
    """Of a dictionary: the places of its keys."""

    def plain(self) -> Any:
        """The value without its places."""
        if isinstance(self.data, dict):
            return {key: value.plain() for key, value in self.data.items()}
        if isinstance(self.data, tuple):
            return [value.plain() for value in self.data]
        return self.data


def place_of(mark: Any) -> Place:
    return Place(mark.line + 1, mark.column + 1)


def parse(text: str, path: str) -> Value:
    """The document of a text. Raises `Faulty`."""
    try:
        loader = yaml.SafeLoader(text)
        node = loader.get_single_node()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = Place(1, 1) if mark is None else place_of(mark)
        raise Faulty(path, [Fault(place, f"is not YAML: {error.problem or error.context}")]) from None
    except yaml.YAMLError as error:
        raise Faulty(path, [Fault(Place(1, 1), f"is not YAML: {' '.join(str(error).split())}")]) from None
    except RecursionError:
        raise Faulty(path, [Fault(Place(1, 1), "its values are nested too deeply")]) from None
    if node is None:
        return Value(Place(1, 1), {})
    return _Conversion(loader, path).value(node)


class _Conversion:
    """From nodes of PyYAML to values."""

    def __init__(self, loader: yaml.SafeLoader, path: str) -> None:
        self._loader, self._path = loader, path
        self._above: List[int] = []
        self._number = 0

    def _fail(self, node: yaml.Node, what: str) -> None:
        raise Faulty(self._path, [Fault(place_of(node.start_mark), what)])

    def value(self, node: yaml.Node) -> Value:
        self._number += 1
        if id(node) in self._above:
            self._fail(node, "this value contains itself")
        if self._number > MOST_VALUES:
            self._fail(node, f"the document has more than {MOST_VALUES} values")
        if len(self._above) > 100:
            self._fail(node, "values are nested too deeply: at most 100 levels")
        self._above.append(id(node))
        try:
            return self._inside(node)
        finally:
            self._above.pop()

    def _inside(self, node: yaml.Node) -> Value:
        place = place_of(node.start_mark)
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, place)
        if isinstance(node, yaml.SequenceNode):
            return Value(place, tuple(self.value(item) for item in node.value))
        try:
            scalar = self._loader.construct_object(node)
        except (yaml.YAMLError, ValueError) as error:
            self._fail(node, f"is not a value: {getattr(error, 'problem', None) or error}")
        if scalar is not None and not isinstance(scalar, (bool, int, float, str)):
            scalar = node.value  # a date: its text
        return Value(place, scalar)

    def _mapping(self, node: yaml.MappingNode, place: Place) -> Value:
        own: Dict[str, Place] = {}
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                self._fail(key, "keys are texts")
            if key.value in own and key.tag != "tag:yaml.org,2002:merge":
                self._fail(key, f"'{key.value}' is given twice; the first time in line {own[key.value].line}")
            own[key.value] = place_of(key.start_mark)
        try:
            self._loader.flatten_mapping(node)  # `<<: *base`: merged members come first, so that own ones win
        except yaml.MarkedYAMLError as error:
            self._fail(node, f"is not YAML: {error.problem or error.context}")
        data, keys = {}, {}
        for key, item in node.value:
            if not isinstance(key, yaml.ScalarNode):
                self._fail(key, "keys are texts")
            data[key.value], keys[key.value] = self.value(item), place_of(key.start_mark)
        return Value(place, data, keys)


def text_of(path: str) -> str:
    """The text of a file. Raises `Faulty`."""
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "is not a text in UTF-8"
        raise Faulty(path, [Fault(Place(1, 1), f"cannot be read: {why}")]) from None


def steps_of(path: str, key: str) -> Optional[Tuple[Union[str, int], ...]]:
    """The steps of the path to a field, whose keys match the regular expression `key`; `None` if it is not a path.

    >>> steps_of("cells[2].voltage", r"\w+")
    ('cells', 2, 'voltage')
    """
    steps: List[Union[str, int]] = []
    for part in path.split("."):
        match = re.fullmatch(rf"({key})((?:\[\d+\])*)", part)
        if match is None:
            return None
        steps.append(match.group(1))
        steps.extend(int(number) for number in re.findall(r"\[(\d+)\]", match.group(2)))
    return tuple(steps)


def near(name: str, names: Iterable[str]) -> str:
    """A hint: the name that was probably meant, or all of them."""
    known = sorted(names)
    close = difflib.get_close_matches(name, known, 1)
    if close:
        return f"; did you mean '{close[0]}'?"
    return f"; known are {', '.join(known)}" if known else ""


class Reader:
    """Reads members of dictionaries, and collects the faults instead of stopping at the first."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.faults: List[Fault] = []

    def fault(self, place: Place, what: str) -> None:
        self.faults.append(Fault(place, what))

    def finish(self) -> None:
        """Raises `Faulty` if there are faults."""
        if self.faults:
            raise Faulty(self.path, self.faults)

    def members(self, value: Value, what: str, known: Iterable[str], needed: Iterable[str] = ()) -> Dict[str, Value]:
        """The members of a dictionary that are known. Members whose value is null count as absent."""
        known = tuple(known)
        if not isinstance(value.data, dict):
            self.fault(value.place, f"{what} has the members {', '.join(known)}; this is {kind_of(value)}")
            return {}
        for key, place in value.keys.items():
            if key not in known:
                self.fault(place, f"unknown member '{key}' of {what}{near(key, known)}")
        found = {key: item for key, item in value.data.items() if key in known and item.data is not None}
        for key in needed:
            if key not in found:
                self.fault(value.place, f"{what} needs the member '{key}'")
        return found

    def entries(self, value: Optional[Value], what: str) -> Dict[str, Value]:
        """The entries of a dictionary with names of the user's own."""
        if value is None:
            return {}
        if not isinstance(value.data, dict):
            self.fault(value.place, f"{what} is a list of names, each with its members; this is {kind_of(value)}")
            return {}
        return value.data

    def text(self, value: Optional[Value], what: str, default: str = "") -> str:
        if value is None:
            return default
        if not isinstance(value.data, str) or not value.data:
            self.fault(value.place, f"{what} is a text; this is {kind_of(value)}")
            return default
        return value.data

    def number(
        self, value: Optional[Value], what: str, default: float = 0.0, least: float = -math.inf, most: float = math.inf
    ) -> float:
        if value is None:
            return default
        data = value.data
        if isinstance(data, bool) or not isinstance(data, (int, float)) or not math.isfinite(data):
            self.fault(value.place, f"{what} is a number; this is {kind_of(value)}")
            return default
        if not least <= data <= most:
            limits = f"of at least {least:g}" if most == math.inf else f"from {least:g} to {most:g}"
            self.fault(value.place, f"{what} is a number {limits}; this is {data}")
            return default
        return float(data)

    def truth(self, value: Optional[Value], what: str, default: bool = False) -> bool:
        if value is None:
            return default
        if not isinstance(value.data, bool):
            self.fault(value.place, f"{what} is true or false; this is {kind_of(value)}")
            return default
        return value.data

    def listed(self, value: Optional[Value], what: str, read: Callable[[Value], Any]) -> Tuple[Any, ...]:
        if value is None:
            return ()
        if not isinstance(value.data, tuple):
            self.fault(value.place, f"{what} is a list, such as [a, b]; this is {kind_of(value)}")
            return ()
        return tuple(read(item) for item in value.data)


def kind_of(value: Value) -> str:
    """A value in a few words, for faults."""
    data = value.data
    if data is None:
        return "nothing"
    if isinstance(data, dict):
        return "a list of members"
    if isinstance(data, tuple):
        return "a list"
    if isinstance(data, bool):
        return f"the truth {str(data).lower()}"
    return f"the text {data[:60]!r}" if isinstance(data, str) else f"the number {data}"
