"""The errors of the package. All are `DolphinError`; those of the command carry its own text."""

from __future__ import annotations

from typing import Any, Mapping, Sequence, Tuple

from .diagnostics import Diagnostic


class DolphinError(Exception):
    """An error of Dolphin, of a program, or of a run."""


class CommandNotFound(DolphinError):
    """There is no `dolphin` to call."""


class CommandError(DolphinError):
    """The command ended with a status that is an error. `str` of it is the command's own text."""

    def __init__(self, arguments: Sequence[str], status: int, text: str) -> None:
        super().__init__(text.strip() or f"{' '.join(arguments)} ended with status {status}")
        self.arguments: Tuple[str, ...] = tuple(arguments)
        self.status = status
        self.text = text


class ProgramError(CommandError):
    """The program, its fleet or an option is not right (status 2). Nothing was started."""

    def __init__(
        self, arguments: Sequence[str], status: int, text: str, diagnostics: Sequence[Diagnostic]
    ) -> None:
        super().__init__(arguments, status, text)
        self.diagnostics = tuple(diagnostics)


class PlatformError(CommandError):
    """The platform, the network or the output failed, not the program (status 3)."""


class CommandFault(CommandError):
    """A fault of Dolphin itself (status 125), or an end by a signal."""


class RunFailed(DolphinError):
    """A run ended otherwise than by completing: `ending` is `halted`, `failed`, `interrupted` or `stuck`."""

    def __init__(self, ending: str, message: str, text: str = "") -> None:
        super().__init__(text.strip() or f"the run ended as {ending}" + (f": {message}" if message else ""))
        self.ending = ending
        self.message = message


class RunGone(DolphinError):
    """The run cannot be reached: its process died, its socket vanished, or it never had a socket."""


class RequestRefused(DolphinError):
    """The run refuses a request. `code` does not change between versions (docs/socket.md)."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


class RunEnded(RequestRefused):
    """The run has ended, and takes no request any more."""


class JournalError(DolphinError):
    """A file is not a journal, or damaged."""


class ConsoleRefused(RequestRefused):
    """A console refuses a request. `reply` has all of its members, such as the `diagnostics` of a program."""

    def __init__(self, code: str, message: str, status: int, reply: Mapping[str, Any]) -> None:
        super().__init__(code, message)
        self.status = status
        self.reply = reply
