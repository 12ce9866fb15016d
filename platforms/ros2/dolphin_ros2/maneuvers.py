"""Plans that programs describe, `imcPlan { ... }`: from their maneuvers to goals of the actions that the configuration
names for `goTo`, `path` and `wait`."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

from dolphin import templates

from .configuration import PlanRule
from .geo import Origin

POINT = ("latitude", "longitude", "height", "x", "y", "z", "yaw", "qz", "qw", "speed")
"""The parameters of a place. `yaw` is the direction of the way to it in the map, `qz` and `qw` are its quaternion."""
PARAMETERS = {"goTo": POINT, "path": ("points", "speed"), "wait": (*POINT, "seconds")}
OF_MAP = frozenset({"x", "y", "yaw", "qz", "qw"})
"""The parameters that need the map's origin."""


class Step(NamedTuple):
    """A goal of a plan: the rule of its action, and the parameters of its template."""

    rule: PlanRule
    parameters: Mapping[str, Any]


class Place(NamedTuple):
    latitude: float
    longitude: float
    height: float
    z: float
    speed: float


class Misfit(Exception):
    """The reason why a maneuver cannot be carried out, as a text for people."""


def compile_plan(
    body: Mapping[str, Any], robot: str, rules: Mapping[str, PlanRule], origin: Optional[Origin],
    start: Optional[Tuple[float, float]] = None,
) -> Tuple[List[Step], List[str]]:
    """The goals of a plan, one after another, for a robot at `start`; and the reasons why it cannot be carried out, in
    which case the goals are of no use."""
    allowed = body.get("vehicles") or []
    if allowed and robot not in allowed:
        return [], [f"only {', '.join(allowed)} may run it"]
    compiler, problems = _Compiler(rules, origin, start), []
    for maneuver in body["maneuvers"]:
        try:
            compiler.add(maneuver)
        except Misfit as misfit:
            problems.append(f"maneuver {maneuver['id']}: {misfit}")
    return compiler.steps, problems


def sample(rule: PlanRule) -> Dict[str, Any]:
    """Parameters of the types that those of a maneuver have."""
    numbers: Dict[str, Any] = {**dict.fromkeys(POINT, 0.5), "seconds": 30}
    point = None if rule.point is None else templates.substitute(rule.point.plain(), numbers)
    return {**numbers, "points": [point]}


class _Compiler:
    def __init__(
        self, rules: Mapping[str, PlanRule], origin: Optional[Origin], start: Optional[Tuple[float, float]]
    ) -> None:
        self.rules, self.origin = rules, origin
        self.steps: List[Step] = []
        self._at = None if origin is None or start is None else origin.metres(*start)
        self._yaw = 0.0

    def add(self, maneuver: Mapping[str, Any]) -> None:
        """Adds the goals of a maneuver. Raises `Misfit`."""
        kind = maneuver["maneuver"]
        if kind not in ("goTo", "launch", "followPath", "loiter", "skeeping"):
            raise Misfit(f"its robots have no {kind}")
        for device in maneuver["payload"]:
            raise Misfit(f"its robots have no way to switch on '{device['name']}'")
        places = self._places(maneuver)
        used = self._used()
        if "speed" in used and maneuver["speedUnit"] != "m/s":
            raise Misfit("its robots take a speed in metres a second")
        if maneuver["z"] and maneuver["zUnit"] != "unspecified" and "z" not in used:
            raise Misfit(f"its robots take no {maneuver['zUnit']} of {maneuver['z']:g} m: give z 0")
        if kind in ("loiter", "skeeping"):
            if "wait" not in self.rules:
                raise Misfit(f"its robots have no {kind}, as the configuration has no maneuver 'wait'")
            if maneuver["duration"] == 0:
                raise Misfit(f"a {kind} needs a duration")
        self._move(places)
        if kind in ("loiter", "skeeping"):
            parameters = {**self._parameters(places[-1], self._yaw), "seconds": maneuver["duration"]}
            self.steps.append(Step(self.rules["wait"], parameters))

    def _places(self, maneuver: Mapping[str, Any]) -> List[Place]:
        own = Place(*(float(maneuver[name]) for name in ("latitude", "longitude", "height", "z", "speed")))
        if maneuver["maneuver"] != "followPath":
            return [own]
        north_up = Origin(own.latitude, own.longitude)
        places = []
        for north, east, down in maneuver["points"]:
            latitude, longitude = north_up.locate(east, north)
            places.append(own._replace(
                latitude=latitude, longitude=longitude, height=own.height - down,
                z=own.z + down if maneuver["zUnit"] == "depth" else own.z - down))
        return places

    def _used(self) -> "set[str]":
        """The parameters that some template uses."""
        used = [rule.template for rule in self.rules.values()]
        used += [rule.point for rule in self.rules.values() if rule.point is not None]
        return {name for template in used for name in templates.parameters_of(template.plain())}

    def _move(self, places: Sequence[Place]) -> None:
        """Adds goals of `path` for several places, of `goTo` for one; or of the one that there is."""
        parameters = [self._arrive(place) for place in places]
        if "path" in self.rules and (len(places) > 1 or "goTo" not in self.rules):
            rule = self.rules["path"]
            assert rule.point is not None
            points = [templates.substitute(rule.point.plain(), point) for point in parameters]
            self.steps.append(Step(rule, {"points": points, "speed": places[0].speed}))
        else:
            self.steps += [Step(self.rules["goTo"], point) for point in parameters]

    def _arrive(self, place: Place) -> Dict[str, Any]:
        """The parameters of a place, whose yaw is the direction from the place before."""
        if self.origin is not None:
            x, y = self.origin.metres(place.latitude, place.longitude)
            if self._at is not None and math.hypot(x - self._at[0], y - self._at[1]) > 0.01:
                self._yaw = math.atan2(y - self._at[1], x - self._at[0])
            self._at = x, y
        return self._parameters(place, self._yaw)

    def _parameters(self, place: Place, yaw: float) -> Dict[str, Any]:
        found: Dict[str, Any] = place._asdict()
        if self.origin is not None:
            x, y = self.origin.metres(place.latitude, place.longitude)
            found.update(x=round(x, 4), y=round(y, 4), yaw=yaw, qz=math.sin(yaw / 2), qw=math.cos(yaw / 2))
        return found
