"""Missions as tests, for pytest, unittest, or plain calls."""

from __future__ import annotations

import functools
import inspect
import os
from typing import Any, Callable, Dict, Optional, Sequence, TypeVar, Union

from .analysis import Exploration, explore
from .command import Faults, PathLike
from .timing import Timing, time

Test = TypeVar("Test", bound=Callable[..., Any])


def assert_holds(exploration: Exploration, properties: Optional[Sequence[str]] = None) -> None:
    """Fails with the violated properties and their runs, unless all hold; or those named. Inconclusive fails too."""
    if properties is not None:
        bad = [exploration[name] for name in properties if not exploration[name].holds]
    elif exploration.holds:
        return
    else:
        bad = [verdict for verdict in exploration.verdicts if not verdict.holds]
    if bad:
        raise AssertionError("\n".join(str(verdict) for verdict in bad))


def assert_in_time(timing: Timing) -> None:
    """Fails unless all runs end before the deadline, and each `within` is met."""
    if timing.in_time != "holds":
        ends = ", ".join(f"{name} between {w.earliest} s and {w.latest} s" for name, w in timing.ends.items())
        raise AssertionError(f"in time: {timing.in_time}: {ends or 'no run ends'}")


def mission(
    program: PathLike, *, faults: Optional[Faults] = None, properties: Optional[Sequence[str]] = None,
    deadline: Union[float, str, None] = None, **options: Any,
) -> Callable[[Test], Test]:
    """Decorates a test: before its body every run of the program is explored, with these faults, and the test fails
    with the run that violates a property. With a `deadline` all runs end by then, too. Paths are relative to the test's
    file. `options` are those of `explore`. A body with the parameter `exploration`, or `timing`, gets the
    result:

        @dolphin.mission("survey.dol", faults="all")
        def test_survey(exploration):
            assert exploration["no leftover tuples"].holds
    """

    def decorate(test: Test) -> Test:
        folder = os.path.dirname(os.path.abspath(inspect.getfile(test)))
        path = os.path.join(folder, os.fspath(program))
        if options.get("fleet") is not None:
            options["fleet"] = os.path.join(folder, os.fspath(options["fleet"]))
        signature = inspect.signature(test)
        wanted = {name for name in ("exploration", "timing") if name in signature.parameters}
        world = {name: options[name] for name in ("fleet", "set", "answers") if name in options}

        @functools.wraps(test)
        def wrapper(*arguments: Any, **more: Any) -> Any:
            exploration = explore(path, faults=faults, **options)
            assert_holds(exploration, properties)
            results: Dict[str, Any] = {"exploration": exploration}
            if deadline is not None or "timing" in wanted:
                timing = results["timing"] = time(path, faults=faults, deadline=deadline, **world)
                if deadline is not None:
                    assert_in_time(timing)
            return test(*arguments, **{name: results[name] for name in wanted}, **more)

        kept = [parameter for name, parameter in signature.parameters.items() if name not in wanted]
        wrapper.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]
        return wrapper  # type: ignore[return-value]

    return decorate
