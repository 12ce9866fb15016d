"""Messages of ROS: fields by their path, and messages from templates. A message is anything that lists its fields by
`get_fields_and_field_types`, as the classes of rosidl do; nothing here needs ROS."""

from __future__ import annotations

import math
import re
from typing import Any, Callable, Dict, Mapping, NamedTuple, Optional, Tuple, Union

from dolphin.document import Reader, Value, kind_of, near, steps_of
from dolphin.templates import parameters_of

_BITS = {f"{sign}int{bits}": (sign, bits) for sign in ("", "u") for bits in (8, 16, 32, 64)}
_TEXTS = ("string", "wstring")
_FLOATS = ("float", "double", "long double")
_LIST = re.compile(r"^(?:sequence<(?P<of>.*?)(?:, (?P<most>\d+))?>|(?P<array>.*)\[(?P<size>\d+)\])$")
_BOUND = re.compile(r"^(w?string)<(\d+)>$")

Find = Callable[[str], Any]
"""Finds the class of a message by its name, such as `geometry_msgs/Pose`."""


class Unfit(Exception):
    """A value that a field cannot have; a text for people."""


class Path(NamedTuple):
    """The path to a field: `pose.position.x`, `cells[2].voltage`."""

    text: str
    steps: Tuple[Union[str, int], ...]

    @staticmethod
    def parse(text: str) -> "Path":
        """The path of a text. Raises `Unfit`.

        >>> Path.parse("cells[2].voltage").steps
        ('cells', 2, 'voltage')
        """
        steps = steps_of(text, r"[A-Za-z_]\w*")
        if steps is None:
            raise Unfit(f"'{text}' is not a field, such as pose.position.x or cells[2]")
        return Path(text, steps)

    def read(self, message: Any) -> Any:
        """The field of a message, as a value of Python; `None` if a list is too short for it. Durations and times are
        seconds, bytes numbers."""
        for step in self.steps:
            if isinstance(step, int):
                if step >= len(message):
                    return None
                message = message[step]
            else:
                message = getattr(message, step)
        return python_of(message)

    def check(self, kind: Any, find: Find) -> Optional[str]:
        """The reason why messages of this class do not have the field."""
        name, fields = "", fields_of(kind)
        field = ""
        for step in self.steps:
            if isinstance(step, str):
                if fields is None:
                    return f"'{self.text}': {field} has no fields"
                if step not in fields:
                    return f"'{self.text}': {name or kind.__name__} has no field '{step}'{near(step, fields)}"
                field = fields[step]
            else:
                inside = item_of(field)
                if inside is None:
                    return f"'{self.text}': {field} is not a list"
                field = inside
            name, fields = field, fields_of(find(field)) if "/" in field and item_of(field) is None else None
        return None


def python_of(value: Any) -> Any:
    """A value of a field as a number, a text, a truth or a list of Python; a message stays what it is."""
    fields = fields_of(value)
    if fields is not None:
        if set(fields) == {"sec", "nanosec"}:
            return value.sec + value.nanosec / 1e9
        return value
    if isinstance(value, (bytes, bytearray)) and len(value) == 1:
        return value[0]
    item = getattr(value, "tolist", None)
    return item() if item is not None else value


def fields_of(kind: Any) -> Optional[Dict[str, str]]:
    """The fields of a message, or of its class, with their types; `None` if it is not one."""
    listed = getattr(kind, "get_fields_and_field_types", None)
    return None if listed is None else listed()


def item_of(field: str) -> Optional[str]:
    """The type of the items of a list; `None` if the type is not a list."""
    match = _LIST.match(field)
    return None if match is None else match.group("of") or match.group("array")


def build(kind: Any, values: Mapping[str, Any], find: Find) -> Any:
    """The message of a class with these fields; the others have their default values. Raises `Unfit`."""
    message, fields = kind(), fields_of(kind) or {}
    for name, value in values.items():
        if name not in fields:
            raise Unfit(f"{kind.__name__} has no field '{name}'{near(name, fields)}")
        try:
            setattr(message, name, convert(value, fields[name], find))
        except Unfit as unfit:
            raise Unfit(f"{name}: {unfit}") from None
        except (AssertionError, TypeError, ValueError) as error:
            raise Unfit(f"{name}: {' '.join(str(error).split())[:200]}") from None
    return message


def convert(value: Any, field: str, find: Find) -> Any:
    """The value as a field of this type has it: texts become numbers and truths where the field is one. Raises
    `Unfit`."""
    item = item_of(field)
    if item is not None:
        return _items(value, field, item, find)
    if "/" in field:
        if not isinstance(value, Mapping):
            raise Unfit(f"{value!r} is not a list of fields of {field}")
        return build(find(field), value, find)
    if isinstance(value, (Mapping, list)):
        raise Unfit(f"{value!r} is not a {field}")
    return _scalar(value, field)


def _items(value: Any, field: str, item: str, find: Find) -> Any:
    match = _LIST.match(field)
    assert match is not None
    if not isinstance(value, list):
        raise Unfit(f"{value!r} is not a list")
    size, most = match.group("size"), match.group("most")
    if size is not None and len(value) != int(size):
        raise Unfit(f"has {len(value)} items, and needs {size}")
    if most is not None and len(value) > int(most):
        raise Unfit(f"has {len(value)} items, and takes {most} at most")
    return [convert(each, item, find) for each in value]


def _scalar(value: Any, field: str) -> Any:
    bound = _BOUND.match(field)
    if field in _TEXTS or bound:
        text = ("true" if value else "false") if isinstance(value, bool) else str(value)
        if bound and len(text) > int(bound.group(2)):
            raise Unfit(f"{text!r} is longer than {bound.group(2)}")
        return text
    if field == "boolean":
        truth = {"true": True, "false": False}.get(value.lower()) if isinstance(value, str) else value
        if not isinstance(truth, bool):
            raise Unfit(f"{value!r} is not true or false")
        return truth
    if field in _FLOATS:
        return _float(value)
    number = _integer(value, *_BITS.get(field, ("u", 8)))
    return bytes([number]) if field in ("octet", "byte") else number


def _float(value: Any) -> float:
    try:
        if isinstance(value, bool) or value is None:
            raise ValueError
        number = float(value)
    except ValueError:
        raise Unfit(f"{value!r} is not a number") from None
    if isinstance(value, str) and not math.isfinite(number):
        raise Unfit(f"{value!r} is not a finite number")
    return number


def _integer(value: Any, sign: str, bits: int) -> int:
    try:
        if isinstance(value, bool) or value is None or isinstance(value, float) and value != int(value):
            raise ValueError
        number = int(value)
    except (ValueError, OverflowError):
        raise Unfit(f"{value!r} is not a whole number") from None
    least, most = (0, 2**bits - 1) if sign == "u" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    if not least <= number <= most:
        raise Unfit(f"{number} is not from {least} to {most}")
    return number


def check_template(reader: Reader, template: Value, kind: Any, find: Find) -> None:
    """Reports the fields of a template that messages of this class do not have, or whose values do not fit. Values with
    parameters are judged once these are known."""
    if not isinstance(template.data, dict):
        reader.fault(template.place, f"is a list of fields of {kind.__name__}; this is {kind_of(template)}")
        return
    fields = fields_of(kind) or {}
    for name, value in template.data.items():
        if name not in fields:
            reader.fault(template.keys[name], f"{kind.__name__} has no field '{name}'{near(name, fields)}")
        elif "/" in fields[name] and item_of(fields[name]) is None and isinstance(value.data, dict):
            check_template(reader, value, find(fields[name]), find)
        elif not parameters_of(value.plain()):
            try:
                build(kind, {name: value.plain()}, find)
            except Unfit as unfit:
                reader.fault(value.place, str(unfit))
