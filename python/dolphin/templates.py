"""Names with parameters, such as `drive_${bay}`, and templates that use the values: for the plans that a configuration
lists. It needs `document`, so `import dolphin` does not load it."""

from __future__ import annotations

import re
from typing import Any, Dict, Iterable, Mapping, Optional, Tuple, TypeVar

from .document import Place, Reader, Value

PARAMETER = re.compile(r"\$\{([A-Za-z_]\w*)\}")

Entry = TypeVar("Entry")


def match(pattern: str, name: str) -> Optional[Dict[str, str]]:
    """The values of the parameters of `pattern` that make it `name`; `None` if no values do.

    >>> match("drive_${bay}", "drive_3"), match("drive_${bay}", "load")
    ({'bay': '3'}, None)
    """
    parts, end = [], 0
    for found in PARAMETER.finditer(pattern):
        parts.append(re.escape(pattern[end:found.start()]) + f"(?P<{found.group(1)}>.+?)")
        end = found.end()
    whole = re.compile("".join(parts) + re.escape(pattern[end:]), re.DOTALL).fullmatch(name)
    return None if whole is None else whole.groupdict()


def choose(entries: Iterable[Tuple[str, Entry]], name: str) -> Optional[Tuple[Entry, Dict[str, str]]]:
    """The entry that is called `name`, with its parameters: names without parameters go before those with them."""
    for pattern, entry in sorted(entries, key=lambda each: bool(PARAMETER.search(each[0]))):
        parameters = match(pattern, name)
        if parameters is not None:
            return entry, parameters
    return None


def parameters_of(template: Any) -> "set[str]":
    """The parameters of a template of plain values."""
    if isinstance(template, str):
        return set(PARAMETER.findall(template))
    inside = template.values() if isinstance(template, Mapping) else template if isinstance(template, list) else ()
    return {name for item in inside for name in parameters_of(item)}


def substitute(template: Any, parameters: Mapping[str, Any]) -> Any:
    """A template with its parameters' values. A text that is just a parameter becomes its value.

    >>> substitute({"bay": "${bay}", "label": "bay ${bay}"}, {"bay": "3"})
    {'bay': '3', 'label': 'bay 3'}
    >>> substitute({"x": "${x}"}, {"x": 0.5})
    {'x': 0.5}
    """
    if isinstance(template, str):
        whole = PARAMETER.fullmatch(template)
        if whole is not None:
            return parameters[whole.group(1)]
        return PARAMETER.sub(lambda found: str(parameters[found.group(1)]), template)
    if isinstance(template, Mapping):
        return {key: substitute(item, parameters) for key, item in template.items()}
    if isinstance(template, list):
        return [substitute(item, parameters) for item in template]
    return template


def check_name(reader: Reader, name: str, place: Place) -> None:
    """Reports a name whose parameters are not right."""
    found = PARAMETER.findall(name)
    if len(set(found)) < len(found):
        reader.fault(place, f"the name '{name}' has a parameter twice")
    elif re.search(r"\}\$\{", name):
        reader.fault(place, f"two parameters of '{name}' have nothing between them: separate them, as by '_'")
    elif "${" in PARAMETER.sub("", name):
        reader.fault(place, f"a parameter of '{name}' is not written as ${{bay}}")


def check_template(reader: Reader, name: str, template: Value, what: str = "plan") -> None:
    """Reports parameters of a template that the name of its plan does not have."""
    if isinstance(template.data, dict):
        for item in template.data.values():
            check_template(reader, name, item, what)
    elif isinstance(template.data, tuple):
        for item in template.data:
            check_template(reader, name, item, what)
    else:
        for parameter in sorted(parameters_of(template.data) - parameters_of(name)):
            reader.fault(
                template.place,
                f"the {what}'s name '{name}' has no parameter '{parameter}': call it '{name}_${{{parameter}}}'")
