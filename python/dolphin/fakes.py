"""Fakes: vehicles that Python functions play, for tests of missions."""

from __future__ import annotations

import asyncio
import inspect
from typing import Any, Awaitable, Callable, Iterable, List, Optional, Sequence, Tuple, Union

from .adapter import Adapter
from .vehicle import Plan, Vehicle

Outcome = Union[float, int, None]
Deed = Callable[["Fake", Plan], Union[Outcome, Awaitable[Outcome]]]
"""The function of a fake, called for each plan: returns the seconds that the plan takes, or `None` for none; raises
`dolphin.Failed` or `dolphin.Unknown`. It may be a coroutine, which then takes its own time."""


def at_once(vehicle: "Fake", plan: Plan) -> Outcome:
    """Every plan is done at once."""
    return None


class Fake(Vehicle):
    """A vehicle that takes every plan; a function decides how long it takes, and how it ends."""

    languages = ("imcPlan", "mission")

    def __init__(
        self, name: str, does: Deed = at_once, *, type: str = "UUV", refuses: Sequence[str] = (),
        latitude: float = 41.185, longitude: float = -8.706, battery: float = 1.0, **members: Any,
    ) -> None:
        super().__init__(
            name, type=type, latitude=latitude, longitude=longitude, battery=battery, **members
        )
        self.does = does
        self.refuses = tuple(refuses)
        """Names of plans that it refuses."""
        self.started: List[str] = []
        """The names of the plans that it was given, in order."""
        self.stopped: List[str] = []
        """The names of the plans that were stopped."""

    async def problems(self, plan: Plan) -> Sequence[str]:
        return [f"undefined plan '{plan.name}'"] if plan.name in self.refuses else []

    async def start(self, plan: Plan) -> None:
        self.started.append(plan.name)

    async def finish(self, plan: Plan) -> None:
        seconds = self.does(self, plan)
        if inspect.isawaitable(seconds):
            seconds = await seconds
        if isinstance(seconds, (int, float)):
            await asyncio.sleep(seconds)

    async def stop(self, plan: Plan) -> None:
        self.stopped.append(plan.name)


class Fakes(Adapter):
    """A fleet of fakes: `dolphin.run("mission.dol", fleet=dolphin.Fakes(...))`. Its vehicles are commanded by the
    runtime that commands real ones, in real time."""

    def __init__(self, *vehicles: Fake, name: str = "fakes") -> None:
        super().__init__(name, vehicles, announce=0.5, patience=5.0)

    @classmethod
    def of(cls, does: Deed = at_once, **counts: int) -> "Fakes":
        """A fleet by types: `Fakes.of(does, UUV=3, UAV=1)` has `uuv-1` to `uuv-3` and `uav-1`.

        >>> sorted(Fakes.of(UUV=2, UAV=1).vehicles)
        ['uav-1', 'uuv-1', 'uuv-2']
        """
        names: Iterable[Tuple[str, int]] = ((kind, n) for kind, most in counts.items() for n in range(1, most + 1))
        return cls(*(Fake(f"{kind.lower()}-{n}", does, type=kind) for kind, n in names))

    def __getitem__(self, name: str) -> Fake:
        vehicle = self.vehicles[name]
        assert isinstance(vehicle, Fake)
        return vehicle


def never(vehicle: Optional[Fake] = None, plan: Optional[Plan] = None) -> "asyncio.Future[None]":
    """A plan that does not end."""
    return asyncio.get_running_loop().create_future()
