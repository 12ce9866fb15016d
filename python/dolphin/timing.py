"""How long a program takes: `dolphin time`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

from . import command
from .analysis import answer, limits
from .command import Faults, PathLike


@dataclass(frozen=True)
class Window:
    """The times at which something may happen, in seconds since the start. `latest` is `None` if it has no bound."""

    earliest: float
    latest: Optional[float]


@dataclass(frozen=True)
class TaskTimes:
    """When a task on a vehicle may start and end. `slack` is how much longer it may take without delaying the latest
    end, or `any`; `None` if it was not asked for."""

    task: str
    vehicle: str
    at: Optional[str]
    starts: Optional[Window]
    ends: Optional[Window]
    slack: Union[float, str, None] = None


@dataclass(frozen=True)
class Battery:
    """The least charge of a vehicle at any time in any run, from 0 to 1."""

    vehicle: str
    verdict: str
    least: float


@dataclass(frozen=True)
class Within:
    """A `within` of the program, and when it may be missed; `None` if it is always met."""

    at: Optional[str]
    missed: Optional[Window]


@dataclass(frozen=True)
class Timing:
    """The result of `dolphin time`. Times are exact: some run has each of them."""

    verdict: str
    in_time: str
    """Whether all runs end before the deadline, and each `within` is met: `holds`, `violated` or `inconclusive`."""
    ends: Mapping[str, Window]
    """For each ending (`completed`, `halted`, ...) when it may come."""
    tasks: Tuple[TaskTimes, ...]
    within: Tuple[Within, ...]
    batteries: Tuple[Battery, ...]
    unknown: Tuple[str, ...]
    """Everything whose duration is unknown."""
    bound: Optional[str]
    """The bound that was met, if one was: times are then of the runs until there."""
    states: int
    status: int
    """The command's: 0, all is well; 1, a run violates a demand; 3, inconclusive."""
    raw: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def holds(self) -> bool:
        return self.status == 0

    @property
    def completed(self) -> Optional[Window]:
        """When runs complete; `None` if none does."""
        return self.ends.get("completed")

    def task(self, name: str) -> TaskTimes:
        """The times of the first task of this name."""
        for task in self.tasks:
            if task.task == name:
                return task
        raise KeyError(name)


def time(
    program: PathLike, *, fleet: Optional[PathLike] = None, faults: Optional[Faults] = None,
    set: Optional[Mapping[str, Any]] = None, answers: Sequence[str] = (),
    deadline: Union[float, str, None] = None, slack: bool = False, max_states: Optional[int] = None,
    max_depth: Optional[int] = None, max_memory: Optional[str] = None, timeout: Optional[float] = None,
    options: Sequence[str] = (),
) -> Timing:
    """`dolphin time PROG`. `deadline` is a number of seconds, or a time as programs write it, such as `"40.min"`."""
    arguments = ["time", "--json", *command.of_world(program, fleet=fleet, set=set, answers=answers, faults=faults)]
    arguments += limits(
        {"deadline": deadline, "max-states": max_states, "max-depth": max_depth, "max-memory": max_memory,
         "timeout": timeout}
    )
    if slack:
        arguments.append("--slack")
    output = command.call([*arguments, *options])
    result = answer(output, "tasks")
    return Timing(
        verdict=result["verdict"], in_time=result["inTime"],
        ends={ending: _window(window) for ending, window in result["ends"].items()},
        tasks=tuple(_task(task) for task in result["tasks"]),
        within=tuple(Within(each["at"], _optional(each["missed"])) for each in result["within"]),
        batteries=tuple(Battery(each["vehicle"], each["verdict"], each["least"]) for each in result["batteries"]),
        unknown=tuple(result["unknown"]), bound=result.get("bound"), states=result["states"], status=output.status,
        raw=result,
    )


def _window(json: Mapping[str, Any]) -> Window:
    return Window(json["earliest"], json["latest"])


def _optional(json: Optional[Mapping[str, Any]]) -> Optional[Window]:
    return None if json is None else _window(json)


def _task(json: Mapping[str, Any]) -> TaskTimes:
    return TaskTimes(
        json["task"], json["vehicle"], json["at"], _optional(json.get("starts")), _optional(json.get("ends")),
        json.get("slack"),
    )
