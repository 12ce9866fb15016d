"""The command `dolphin`: where it is, calling it, and its exit statuses as exceptions."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from typing import Any, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from . import diagnostics
from .errors import CommandError, CommandFault, CommandNotFound, PlatformError, ProgramError

PathLike = Union[str, "os.PathLike[str]"]
Faults = Union[str, Iterable[str], Mapping[str, int]]

INTERRUPTED = 130


BUNDLED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "_command", "bin", "dolphin")
"""The command of a wheel that carries it (scripts/wheel)."""


def find() -> str:
    """The path of the command: that of the environment variable `DOLPHIN`, or else that which the package carries, or
    else that of `dolphin` on the path."""
    named = os.environ.get("DOLPHIN")
    if not named and os.access(BUNDLED, os.X_OK):
        return BUNDLED
    found = shutil.which(named or "dolphin")
    if found is None:
        raise CommandNotFound(
            f"DOLPHIN names {named}, which cannot be executed" if named
            else "there is no command 'dolphin' on the path: install Dolphin, or name it in the variable DOLPHIN"
        )
    return found


def main() -> int:
    """The command `dolphin` of a wheel that carries it: this process becomes the command."""
    os.execv(BUNDLED, ["dolphin", *sys.argv[1:]])


@dataclass(frozen=True)
class Output:
    """The result of a call of the command."""

    arguments: Tuple[str, ...]
    status: int
    stdout: str
    stderr: str

    def error(self) -> CommandError:
        """The exception for this status, with the command's own text."""
        return error_of(self.arguments, self.status, self.stderr or self.stdout)


def error_of(arguments: Sequence[str], status: int, text: str) -> CommandError:
    """The exception for an exit status (docs/command.md); negative statuses are signals."""
    if status == 2:
        return ProgramError(arguments, status, text, diagnostics.parse(text))
    if status == 3:
        return PlatformError(arguments, status, text)
    if status == 125 or status < 0:
        return CommandFault(arguments, status, text)
    return CommandError(arguments, status, text)


def environment() -> Mapping[str, str]:
    """The environment of the command: this process's, without colours."""
    return {**os.environ, "NO_COLOR": "1"}


def call(arguments: Sequence[str], *, input: Optional[str] = None) -> Output:
    """Calls the command and waits for its end. Ctrl-C ends the command, and is raised."""
    done = subprocess.run(
        [find(), *arguments], input="" if input is None else input, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        encoding="utf-8", errors="replace", env=environment(),
    )
    return Output(("dolphin", *arguments), done.returncode, done.stdout, done.stderr)


def setting(value: Any) -> str:
    """The text of a parameter's value, for `--set`."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    return str(value)


def of_world(
    program: PathLike, *, fleet: Optional[PathLike] = None, set: Optional[Mapping[str, Any]] = None,
    answers: Sequence[str] = (), faults: Optional[Faults] = None,
) -> List[str]:
    """The arguments for a program and the world that it runs in, the program first.

    >>> of_world("m.dol", set={"n": 3}, faults={"fail": 1})
    ['m.dol', '--set=n=3', '--faults=fail=1']
    """
    arguments = [os.fspath(program)]
    if fleet is not None:
        arguments.append(f"--fleet={os.fspath(fleet)}")
    for name, value in (set or {}).items():
        arguments.append(f"--set={name}={setting(value)}")
    arguments += [f"--answer={answer}" for answer in answers]
    if faults is not None:
        arguments.append(f"--faults={_faults(faults)}")
    return arguments


def _faults(faults: Faults) -> str:
    if isinstance(faults, str):
        return faults
    if isinstance(faults, Mapping):
        return ",".join(f"{name}={most}" for name, most in faults.items())
    return ",".join(faults)
