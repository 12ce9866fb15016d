"""Errors and warnings about a text, as the command prints them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import List, Optional

_PLACE = r"(?P<file>[^\n]+?):(?:(?P<line>\d+):(?P<column>\d+):)?"
_HEAD = re.compile(rf"^{_PLACE} (?P<severity>error|warning): (?P<message>.*)$")


@dataclass(frozen=True)
class Diagnostic:
    """An error or a warning, and where. `line` and `column` count from 1; `None` if it is about the whole file."""

    file: str
    line: Optional[int]
    column: Optional[int]
    severity: str
    message: str
    hint: Optional[str] = None
    details: str = ""

    @property
    def is_error(self) -> bool:
        return self.severity == "error"

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}:{self.column}"
        hint = f" ({self.hint})" if self.hint else ""
        return f"{place}: {self.severity}: {self.message}{hint}"


def parse(text: str) -> List[Diagnostic]:
    """The diagnostics in the output of a command, in their order. Other lines are skipped.

    >>> found = parse("m.dol:1:5: error: unknown name 'x'\\n  1 | y = x\\n    |     ^\\n    hint: did you mean y?\\n")
    >>> found[0].line, found[0].message, found[0].hint
    (1, "unknown name 'x'", 'did you mean y?')
    """
    found: List[Diagnostic] = []
    details: List[str] = []

    def close() -> None:
        if found and details:
            last = found.pop()
            hints = [line.strip()[len("hint: "):] for line in details if line.strip().startswith("hint: ")]
            found.append(
                Diagnostic(
                    last.file, last.line, last.column, last.severity, last.message,
                    hints[0] if hints else None, "\n".join(details),
                )
            )
        details.clear()

    in_one = False
    for line in text.splitlines():
        head = _HEAD.match(line)
        if head:
            close()
            number, column = head["line"], head["column"]
            found.append(
                Diagnostic(
                    head["file"], int(number) if number else None, int(column) if column else None,
                    head["severity"], head["message"],
                )
            )
            in_one = True
        elif in_one and line.startswith(" "):
            details.append(line)
        else:
            close()
            in_one = False
    close()
    return found
