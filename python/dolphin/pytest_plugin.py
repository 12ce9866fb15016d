"""The plug-in for pytest, which finds it by itself once the package is installed.

- `pytest --dolphin` collects programs, `*.dol`, as tests: `check`, which fails with its errors, and `explore`, which
  fails with the runs that violate a property. `--dolphin-faults all` explores with faults.
- The fixture `fly` runs a program on fakes: `journal = fly("mission.dol", dolphin.Fakes.of(UUV=3))`, its path relative
  to the test's file.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Callable, Iterator, Optional

import pytest

from . import analysis, missions, runs
from .command import PathLike
from .errors import DolphinError
from .fakes import Fakes
from .journal import Journal


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("dolphin", "missions of Dolphin")
    group.addoption("--dolphin", action="store_true", help="Collect programs, *.dol, as tests.")
    group.addoption("--dolphin-faults", metavar="FAULTS", help="Explore programs with these faults, such as all.")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Optional[pytest.Collector]:
    if file_path.suffix == ".dol" and parent.config.getoption("--dolphin"):
        program: pytest.Collector = Program.from_parent(parent, path=file_path)
        return program
    return None


class Program(pytest.File):
    """A program, with its two tests."""

    def collect(self) -> Iterator[pytest.Item]:
        yield Checked.from_parent(self, name="check")
        yield Explored.from_parent(self, name="explore")


class _Test(pytest.Item):
    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, (AssertionError, DolphinError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self) -> Any:
        return self.path, None, f"{self.path.name}: {self.name}"


class Checked(_Test):
    """The program has no errors that show without running it."""

    def runtest(self) -> None:
        found = analysis.check(self.path)
        if not found.ok:
            raise AssertionError(found.text)


class Explored(_Test):
    """Every property of `dolphin explore` holds."""

    def runtest(self) -> None:
        faults = self.config.getoption("--dolphin-faults")
        missions.assert_holds(analysis.explore(self.path, faults=faults))


@pytest.fixture
def fly(request: pytest.FixtureRequest) -> Callable[..., Journal]:
    """Runs a program to its end, on fakes or a simulated fleet, and gives the journal. Options as of `dolphin.run`."""

    def go(program: PathLike, fleet: Optional[Fakes] = None, **options: Any) -> Journal:
        path = os.path.join(str(request.path.parent), os.fspath(program))
        return runs.execute(path, fleet=fleet, **options)

    return go
