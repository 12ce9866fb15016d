"""A configuration: the robots, their topics, and the actions and services that are their plans. `configuration_file`
reads it from robots.yaml."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional, Tuple, Union

import dolphin
from dolphin import templates
from dolphin.document import Place, Value

from .geo import Origin
from .messages import Path

SILENCE = 3.0
"""Seconds without a message after which a robot has no link."""
ANSWER = 10.0
"""Seconds within which an action server is to answer."""


@dataclass(frozen=True)
class Type:
    """The type of an interface: `nav_msgs/msg/Odometry`."""

    package: str
    folder: str
    name: str
    place: Place = dataclasses.field(compare=False)

    def __str__(self) -> str:
        return f"{self.package}/{self.folder}/{self.name}"


@dataclass(frozen=True)
class Topic:
    """A topic, relative to the namespace of its robot unless it begins with a slash; and a field of its messages."""

    name: str
    type: Type
    path: Optional[Path] = None
    place: Place = dataclasses.field(default=Place(1, 1), compare=False)


@dataclass(frozen=True)
class Ready:
    """The robot takes plans while a field has this value; `otherwise` is the reason why it does not."""

    topic: Topic
    value: Any
    otherwise: str


@dataclass(frozen=True)
class Lifecycle:
    """The robot takes plans while this managed node is active."""

    node: str
    """Its name, relative to the robot's namespace."""
    type: Type
    """The service that reports its state."""


@dataclass(frozen=True)
class Rule:
    """How a result is judged: by a field that has one of the values `done`, or else the plan has failed. `words` are
    reasons by value, `message` is the field that has the reason."""

    field: Optional[Path] = None
    done: Tuple[Any, ...] = ()
    message: Optional[Path] = None
    words: Mapping[str, str] = dataclasses.field(default_factory=dict)
    place: Place = dataclasses.field(default=Place(1, 1), compare=False)


@dataclass(frozen=True)
class Progress:
    """The share of a plan that is done: the value of a field of its feedback, or the length of its list, divided by
    `of`. `remaining` is a field with seconds, or a duration."""

    field: Optional[Path] = None
    of: Any = 1
    remaining: Optional[Path] = None
    place: Place = dataclasses.field(default=Place(1, 1), compare=False)


@dataclass(frozen=True)
class PlanRule:
    """A plan by name: an action, or a service. The name may have parameters: `deliver_${bay}`."""

    name: str
    is_service: bool
    interface: str
    """The name of the action or service, relative to the robot's namespace."""
    type: Type
    template: Value
    """The goal or the request."""
    result: Rule
    progress: Optional[Progress]
    place: Place = dataclasses.field(compare=False)
    point: Optional[Value] = None
    """Of the maneuver `path`: a point of it, an item of `${points}`."""

    def match(self, name: str) -> Optional[Dict[str, str]]:
        """The parameters of a plan's name; `None` if it is another plan."""
        return templates.match(self.name, name)

    def values(self, parameters: Mapping[str, Any]) -> Dict[str, Any]:
        """The fields of the goal or the request."""
        found: Dict[str, Any] = templates.substitute(self.template.plain(), parameters)
        return found


@dataclass(frozen=True)
class Kind:
    """A kind of robots: all that they have in common."""

    name: str
    type: str
    payload: Tuple[str, ...]
    position: Union[Topic, dolphin.Position]
    battery: Optional[Topic]
    readings: Mapping[str, Topic]
    ready: Union[Ready, Lifecycle, None]
    silence: float
    plans: Tuple[PlanRule, ...]
    maneuvers: Mapping[str, PlanRule]
    """The actions for the maneuvers of plans that programs describe: `goTo`, `path`, `wait`."""

    def plan(self, name: str) -> Optional[Tuple[PlanRule, Dict[str, str]]]:
        """The plan of this name with its parameters: names without parameters go before those with them."""
        return templates.choose(((plan.name, plan) for plan in self.plans), name)


@dataclass(frozen=True)
class RobotEntry:
    """A robot: its name in programs, and its namespace in ROS."""

    name: str
    namespace: str
    kind: Kind
    payload: Tuple[str, ...]

    def resolve(self, name: str) -> str:
        """The full name of a topic, action or service."""
        return name if name.startswith("/") else f"{self.namespace.rstrip('/')}/{name}"


@dataclass(frozen=True)
class Configuration:
    path: str
    robots: Tuple[RobotEntry, ...]
    kinds: Tuple[Kind, ...]
    inputs: Mapping[str, Topic]
    outputs: Mapping[str, str]
    """The topics for news of a run, by `messages`, `posts` and `states`."""
    domain: Optional[int]
    origin: Optional[Origin]
    answer: float
