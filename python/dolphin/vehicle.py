"""A vehicle of an adapter: derive a class from `Vehicle` that starts, finishes and stops plans."""

from __future__ import annotations

import json
import math
import numbers
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence

if TYPE_CHECKING:
    from .adapter import Adapter


class VehicleEvent(Exception):
    """An outcome of a plan, raised by a vehicle. `why` is a few words in the vehicle's own terms, no full stop."""

    def __init__(self, why: str = "") -> None:
        super().__init__(why)
        self.why = why


class Failed(VehicleEvent):
    """The plan does not run and will not: refused, failed, replaced, taken over by a pilot. The vehicle is quiet."""


class Unknown(VehicleEvent):
    """It is uncertain whether the plan runs, ran, or will. Dolphin then orders a stop."""


class Absent(VehicleEvent):
    """Of `Vehicle.resume` only: the plan never reached the vehicle, and will not. Dolphin orders it again."""


class Done(VehicleEvent):
    """Of `Vehicle.resume` only: the plan has run to its end."""


class Stopped(VehicleEvent):
    """Of `Vehicle.resume` only: the plan was stopped, does not run, and will not."""


@dataclass
class Plan:
    """A plan that a vehicle is to run. Without a `language` the vehicle knows it by its `name`; `body` is that of its
    language (docs/platform.md). `notes` are those of this request before the adapter's death, the latest first; `doubt`
    is not `None` if Dolphin's journal may have lost the order, or some of them."""

    name: str
    language: Optional[str] = None
    body: Mapping[str, Any] = field(default_factory=dict)
    request: str = ""
    timeout: float = 60.0
    notes: List[Mapping[str, Any]] = field(default_factory=list)
    doubt: Optional[str] = None
    _adapter: Optional["Adapter"] = field(default=None, repr=False, compare=False)

    def progress(self, share: Optional[float] = None, remaining: Optional[float] = None) -> None:
        """Reports how far the plan is, from 0 to 1, and how many seconds remain. For displays."""
        if self._adapter is not None:
            self._adapter.report_progress(self, share, remaining)

    async def note(self, note: Mapping[str, Any]) -> None:
        """Has Dolphin keep a note on this plan, and waits until the disk has it. `Vehicle.resume` gets it back."""
        if self._adapter is not None:
            await self._adapter.keep_note(self, note)


_RANGES = {"latitude": (-90.0, 90.0), "longitude": (-180.0, 180.0), "battery": (0.0, 1.0)}
_NUMBERS = frozenset({"latitude", "longitude", "height", "depth", "altitude", "battery", "speed"})
_URGENT = frozenset({"type", "payload", "link", "unready"})
_MEMBERS = _URGENT | _NUMBERS | {"readings"}


def finite(value: Any) -> Any:
    """A number of any library as one of Python, `None` if it is not finite. Other values stay."""
    if isinstance(value, (bool, int)) or not isinstance(value, numbers.Real):
        return value
    number = float(value)
    return number if math.isfinite(number) else None


def _clean(name: str, value: Any) -> Any:
    """The value of a member as the protocol has it. An error in the caller's code is raised there."""
    if name not in _MEMBERS:
        raise TypeError(f"a vehicle has no member {name!r}")
    if name == "readings":
        return {str(key): finite(reading) for key, reading in value.items()}
    value = finite(value)
    if name in _NUMBERS and value is not None:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise TypeError(f"{name} is {value!r}, not a number")
        least, most = _RANGES.get(name, (-math.inf, math.inf))
        if not least <= value <= most:
            raise ValueError(f"{name} is {value}, not from {least:g} to {most:g}")
    return value


class Vehicle:
    """A vehicle, and how it is commanded. Methods are coroutines on one event loop, and must not block it: use
    `asyncio.to_thread` for calls that wait.

    `Adapter` calls `start`, then `finish`; to stop, it cancels whichever of the two runs, then calls `stop`."""

    type: str = ""
    """`UUV`, `UAV`, `USV`, `UGV`, `ROV`, or another word of your users."""
    payload: Sequence[str] = ()
    """The devices that it carries."""
    languages: Sequence[str] = ()
    """The languages of inline plans that it takes, such as `imcPlan` and `mission`; plans by name it always takes."""

    def __init__(self, name: str, *, link: bool = True, **members: Any) -> None:
        self.name = name
        self.held = False
        """Whether the program holds the vehicle now."""
        self.known: Dict[str, Any] = {}
        """All that was reported of the vehicle, by member."""
        self._unsent: Dict[str, Any] = {}
        self._adapter: Optional["Adapter"] = None
        self.report(type=members.pop("type", self.type), payload=list(members.pop("payload", self.payload)), link=link)
        self.report(**members)

    # To be defined by derived classes.

    async def problems(self, plan: Plan) -> Sequence[str]:
        """The reasons why the vehicle cannot run the plan, each in a few words. Moves nothing. Here: none."""
        return ()

    async def start(self, plan: Plan) -> None:
        """Gives the vehicle the plan; returns once it has accepted it, or runs it. Raises `Failed` if it refuses."""
        raise NotImplementedError

    async def finish(self, plan: Plan) -> None:
        """Returns when the plan has run to its end. Raises `Failed` if it fails, `Unknown` if that is uncertain."""
        raise NotImplementedError

    async def stop(self, plan: Plan) -> None:
        """Stops the plan; returns once no part of it runs and none will. Called again each second if it raises.
        Raises `Failed` if another hand has the vehicle, which is then left alone."""
        raise NotImplementedError

    async def resume(self, plan: Plan) -> None:
        """The adapter died after it had commanded this plan, or was about to. Finds out from the vehicle: returns if
        the plan runs, and `finish` is called then; raises `Done`, `Stopped` or `Failed` if it has ended, `Absent` if
        it never began, and `Unknown`, as it does here, if that is uncertain."""
        raise Unknown("the adapter was started again, and the vehicle cannot be asked")

    async def run(self) -> None:
        """Listens to the vehicle for as long as the adapter lives, and calls `report`. Here: nothing."""

    def hold(self, held: bool) -> None:
        """The program holds the vehicle from now on, or does not any more. Here: nothing beside `held`."""

    # For derived classes to call.

    def report(self, **members: Any) -> None:
        """Reports news of the vehicle: `latitude` and `longitude`, `height`, `depth`, `altitude`, `battery`
        (0 to 1), `speed`, `readings`, `link`, `unready`, `type`, `payload`. `None` and NaN are *not known*; a position
        that is not known leaves the last one. Link, readiness, type, payload and the first position are sent at once,
        the rest at the pace that Dolphin asks for. May be called from any thread.

        >>> boat = Vehicle("boat-1", type="USV", latitude=41.18, longitude=-8.7)
        >>> boat.report(battery=0.8, readings={"Temperature": 14.2})
        >>> boat.known["battery"], boat.known["link"]
        (0.8, True)
        """
        clean = {name: _clean(name, value) for name, value in members.items()}
        if clean.get("latitude", 0) is None or clean.get("longitude", 0) is None:  # as receivers without a fix have it
            clean.pop("latitude", None)
            clean.pop("longitude", None)
        json.dumps(clean, allow_nan=False)
        adapter = self._adapter
        if adapter is not None and not adapter.is_of_this_thread():
            adapter.call_soon(lambda: self._take(clean))
        else:
            self._take(clean)

    @property
    def unready(self) -> Optional[str]:
        """The reported reason why the vehicle cannot be given a plan."""
        why: Optional[str] = self.known.get("unready")
        return why

    # For the adapter.

    def _take(self, members: Mapping[str, Any]) -> None:
        is_first_place = "latitude" in members and "latitude" not in self.known
        changed = {}
        for name, value in members.items():
            if name == "readings":
                before = self.known.setdefault("readings", {})
                news = {key: x for key, x in value.items() if before.get(key, before) != x}
                before.update(news)
                if news:
                    changed["readings"] = {**self._unsent.get("readings", {}), **news}
            elif name not in self.known or self.known[name] != value:
                self.known[name] = value
                changed[name] = value
        self._unsent.update(changed)
        if self._adapter is not None and (is_first_place or not _URGENT.isdisjoint(changed)):
            self._adapter.flush(self)

    def _news(self) -> Dict[str, Any]:
        """The news that was not sent yet: from now on it counts as sent. Latitude and longitude go together."""
        news, self._unsent = self._unsent, {}
        if "latitude" in news or "longitude" in news:
            news.update({name: self.known[name] for name in ("latitude", "longitude") if name in self.known})
        return news

    def _forget_sent(self) -> None:
        """All that is known is to be sent again."""
        self._unsent = dict(self.known)

