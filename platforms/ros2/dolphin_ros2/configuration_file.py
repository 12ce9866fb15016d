"""robots.yaml: docs/ros2.md describes it. Reading needs no ROS: it judges all but types. `interfaces.check` judges
these, with the packages that are there."""

from __future__ import annotations

import re
from typing import Collection, Dict, Mapping, Optional, Sequence, Tuple, Union

import dolphin
from dolphin import templates
from dolphin.document import Fault, Faulty, Place, Reader, Value, near, parse, text_of

from . import maneuvers
from .configuration import (
    ANSWER, SILENCE, Configuration, Kind, Lifecycle, PlanRule, Progress, Ready, RobotEntry, Rule, Topic, Type,
)
from .geo import Origin
from .messages import Path, Unfit


def read(path: str) -> Configuration:
    """The configuration of a file. Raises `Faulty`, with all faults."""
    return of_text(text_of(path), path)


def of_text(text: str, path: str) -> Configuration:
    """The configuration of a text. Raises `Faulty`."""
    reader = Reader(path)
    configuration = _Reading(reader).configuration(parse(text, path))
    reader.finish()
    return configuration


_NAME = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*")
_INTERFACE = re.compile(r"([A-Za-z]\w*)/(?:(msg|srv|action)/)?([A-Za-z]\w*)")
_FOLDERS = {"msg": "sensor_msgs/msg/NavSatFix", "srv": "std_srvs/srv/Trigger", "action": "nav2_msgs/action/Spin"}

POSITIONS = (
    "sensor_msgs/msg/NavSatFix", "nav_msgs/msg/Odometry", "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
)
OUTPUTS = ("messages", "posts", "states")
BATTERY = "sensor_msgs/msg/BatteryState"


class _Reading:
    """From a document to a configuration. Each function reports faults, and gives a value to go on with."""

    def __init__(self, reader: Reader) -> None:
        self.reader = reader

    def configuration(self, document: Value) -> Configuration:
        members = self.reader.members(
            document, "the configuration", ("robots", "kinds", "inputs", "outputs", "domain", "origin", "answer"),
            needed=("robots", "kinds"),
        )
        origin = self.origin(members.get("origin"))
        kinds = {
            name: self.kind(name, value, origin)
            for name, value in self.reader.entries(members.get("kinds"), "'kinds'").items()
        }
        robots = [
            self.robot(name, value, kinds)
            for name, value in self.reader.entries(members.get("robots"), "'robots'").items()
        ]
        if "robots" in members and isinstance(members["robots"].data, dict) and not robots:
            self.reader.fault(members["robots"].place, "there is no robot")
        self.distinct(members.get("robots"), [robot for robot in robots if robot is not None])
        inputs = {
            key: self.topic(value, f"the input '{key}'", with_field=True)
            for key, value in self.reader.entries(members.get("inputs"), "'inputs'").items()
        }
        return Configuration(
            path=self.reader.path, robots=tuple(robot for robot in robots if robot is not None),
            kinds=tuple(kinds.values()), inputs={key: topic for key, topic in inputs.items() if topic is not None},
            outputs=self.outputs(members.get("outputs")), domain=self.domain(members.get("domain")), origin=origin,
            answer=self.reader.number(members.get("answer"), "'answer'", ANSWER, 0.1, 600),
        )

    def outputs(self, value: Optional[Value]) -> Dict[str, str]:
        if value is None:
            return {}
        members = self.reader.members(value, "'outputs'", OUTPUTS)
        return {key: name for key, name in ((key, self.name(item, "a topic", f"dolphin/{key}"))
                                            for key, item in members.items()) if name}

    def domain(self, value: Optional[Value]) -> Optional[int]:
        if value is None:
            return None
        number = self.reader.number(value, "'domain'", 0, 0, 232)
        if number != int(number):
            self.reader.fault(value.place, f"'domain' is a whole number; this is {number}")
        return int(number)

    def origin(self, value: Optional[Value]) -> Optional[Origin]:
        if value is None:
            return None
        known = ("latitude", "longitude", "height", "heading")
        members = self.reader.members(value, "'origin'", known, needed=known[:2])
        return Origin(
            self.reader.number(members.get("latitude"), "'latitude'", 0, -89.9, 89.9),
            self.reader.number(members.get("longitude"), "'longitude'", 0, -180, 180),
            self.reader.number(members.get("height"), "'height'"),
            self.reader.number(members.get("heading"), "'heading'", 90, -360, 360),
        )

    def robot(self, name: str, value: Value, kinds: Mapping[str, Kind]) -> Optional[RobotEntry]:
        known = ("kind", "namespace", "payload")
        members = self.reader.members(value, f"the robot '{name}'", known, needed=known[:2])
        named = self.reader.text(members.get("kind"), "'kind'")
        namespace = self.reader.text(members.get("namespace"), "'namespace'", "/")
        if namespace != "/" and not (namespace.startswith("/") and _NAME.fullmatch(namespace)):
            self.reader.fault(
                members["namespace"].place, f"'{namespace}' is not a namespace of ROS, such as /{_tame(name)}"
            )
        if named and named not in kinds:
            self.reader.fault(members["kind"].place, f"unknown kind '{named}'{near(named, kinds)}")
        kind = kinds.get(named)
        if kind is None:
            return None
        payload = self.payload(members["payload"]) if "payload" in members else kind.payload
        return RobotEntry(name, namespace, kind, payload)

    def distinct(self, value: Optional[Value], robots: Sequence[RobotEntry]) -> None:
        """Two robots of one namespace would be one robot with two names, which could get two plans at once."""
        seen: Dict[str, str] = {}
        for robot in robots:
            assert value is not None
            namespace = robot.namespace.rstrip("/")
            if namespace in seen:
                self.reader.fault(
                    value.keys[robot.name],
                    f"'{robot.name}' and '{seen[namespace]}' have one namespace, {robot.namespace}: give each its own",
                )
            seen.setdefault(namespace, robot.name)

    def payload(self, value: Optional[Value]) -> Tuple[str, ...]:
        return self.reader.listed(value, "'payload'", lambda item: self.reader.text(item, "a device"))

    def kind(self, name: str, value: Value, origin: Optional[Origin]) -> Kind:
        what = f"the kind '{name}'"
        known = ("type", "payload", "position", "battery", "readings", "ready", "silence", "plans", "maneuvers")
        members = self.reader.members(value, what, known, needed=("type", "position", "plans"))
        readings = {
            key: self.topic(item, f"the reading '{key}'", with_field=True)
            for key, item in self.reader.entries(members.get("readings"), "'readings'").items()
        }
        plans = [
            self.plan(key, item, members["plans"].keys[key])
            for key, item in self.reader.entries(members.get("plans"), "'plans'").items()
        ]
        maneuvers = self.maneuvers(members.get("maneuvers"), origin)
        self.one_type_each([plan for plan in [*plans, *maneuvers.values()] if plan is not None])
        return Kind(
            name=name, type=self.reader.text(members.get("type"), "'type'"),
            payload=self.payload(members.get("payload")), position=self.position(members.get("position"), origin),
            battery=self.battery(members.get("battery")),
            readings={key: topic for key, topic in readings.items() if topic is not None},
            ready=self.ready(members.get("ready")),
            silence=self.reader.number(members.get("silence"), "'silence'", SILENCE, 0.5, 3600),
            plans=tuple(plan for plan in plans if plan is not None), maneuvers=maneuvers,
        )

    def one_type_each(self, plans: Sequence[PlanRule]) -> None:
        seen: Dict[Tuple[bool, str], Type] = {}
        for plan in plans:
            before = seen.setdefault((plan.is_service, plan.interface), plan.type)
            if before != plan.type:
                what = "service" if plan.is_service else "action"
                self.reader.fault(
                    plan.type.place, f"the {what} {plan.interface} is of type {before} in line {before.place.line}")

    def position(self, value: Optional[Value], origin: Optional[Origin]) -> Union[Topic, dolphin.Position]:
        nowhere = dolphin.Position(0.0, 0.0)
        if value is None:
            return nowhere
        if isinstance(value.data, dict) and "topic" not in value.data:
            members = self.reader.members(
                value, "'position' without a topic", ("latitude", "longitude", "height"), ("latitude", "longitude"))
            return dolphin.Position(
                self.reader.number(members.get("latitude"), "'latitude'", 0, -90, 90),
                self.reader.number(members.get("longitude"), "'longitude'", 0, -180, 180),
                self.reader.number(members.get("height"), "'height'"),
            )
        topic = self.topic(value, "'position'")
        if topic is None:
            return nowhere
        if str(topic.type) not in POSITIONS:
            types = f"{', '.join(POSITIONS[:-1])} or {POSITIONS[-1]}"
            self.reader.fault(topic.type.place, f"a position is of type {types}; this is {topic.type}")
        elif str(topic.type) != POSITIONS[0] and origin is None:
            what = f"{'an' if topic.type.name[0] in 'AEIOU' else 'a'} {topic.type.name}"
            self.reader.fault(
                topic.type.place,
                f"{what} is in metres from the origin of its map: the configuration needs 'origin', with its "
                "'latitude' and 'longitude'",
            )
        return topic

    def battery(self, value: Optional[Value]) -> Optional[Topic]:
        if value is None:
            return None
        topic = self.topic(value, "'battery'", default=BATTERY)
        if topic is not None and str(topic.type) != BATTERY and topic.path is None:
            self.reader.fault(topic.type.place, f"a battery is of type {BATTERY}, or gives a 'field' from 0 to 1")
        return topic

    def ready(self, value: Optional[Value]) -> Union[Ready, Lifecycle, None]:
        if value is None:
            return None
        if isinstance(value.data, dict) and "lifecycle" in value.data:
            node = self.reader.members(value, "'ready' by a lifecycle", ("lifecycle",)).get("lifecycle")
            name = self.name(node, "a node", "bt_navigator")
            return Lifecycle(name, Type("lifecycle_msgs", "srv", "GetState", value.place)) if name else None
        members = self.reader.members(
            value, "'ready'", ("topic", "type", "field", "is", "otherwise"), needed=("topic", "type", "field", "is"))
        own = {key: item for key, item in members.items() if key in ("topic", "type", "field")}
        topic = self.topic(Value(value.place, own), "'ready'", with_field=True) if len(own) == 3 else None
        if topic is None or "is" not in members:
            return None
        otherwise = self.reader.text(members.get("otherwise"), "'otherwise'", f"is not ready ({topic.name})")
        return Ready(topic, members["is"].plain(), otherwise)

    def topic(
        self, value: Value, what: str, with_field: bool = False, default: Optional[str] = None
    ) -> Optional[Topic]:
        needed = ["topic", *([] if default else ["type"]), *(["field"] if with_field else [])]
        members = self.reader.members(value, what, ("topic", "type", "field"), needed=needed)
        name = self.name(members.get("topic"), "a topic", "odom")
        type_ = self.type(members.get("type") or (Value(value.place, default) if default else None), "msg")
        path = self.path(members.get("field"))
        if not name or type_ is None or (with_field and path is None):
            return None
        return Topic(name, type_, path, members["field"].place if "field" in members else value.place)

    def name(self, value: Optional[Value], what: str, example: str) -> str:
        name = self.reader.text(value, what)
        if value is not None and name and not _NAME.fullmatch(name):
            self.reader.fault(value.place, f"'{name}' is not the name of {what}, such as {example} or /{example}")
        return name

    def type(self, value: Optional[Value], folder: str) -> Optional[Type]:
        text = self.reader.text(value, "'type'")
        if value is None or not text:
            return None
        match = _INTERFACE.fullmatch(text)
        if match is None or match.group(2) not in (None, folder):
            self.reader.fault(value.place, f"'{text}' is not a type such as {_FOLDERS[folder]}")
            return None
        return Type(match.group(1), folder, match.group(3), value.place)

    def path(self, value: Optional[Value]) -> Optional[Path]:
        text = self.reader.text(value, "'field'")
        if value is None or not text:
            return None
        try:
            return Path.parse(text)
        except Unfit as unfit:
            self.reader.fault(value.place, str(unfit))
            return None

    # Plans.

    def plan(self, name: str, value: Value, place: Place) -> Optional[PlanRule]:
        what = f"the plan '{name}'"
        templates.check_name(self.reader, name, place)
        is_service = isinstance(value.data, dict) and "service" in value.data
        if isinstance(value.data, dict) and is_service == ("action" in value.data):
            both = "cannot have both" if is_service else "needs one of"
            self.reader.fault(place, f"{what} {both} the members 'action' and 'service'")
            return None
        known = ("service", "type", "request", "result") if is_service else (
            "action", "type", "goal", "result", "progress")
        members = self.reader.members(value, what, known, needed=known[:1] if is_service else known[:2])
        interface = self.name(members.get(known[0]), f"{'a service' if is_service else 'an action'}", "dock")
        trigger = Value(value.place, "std_srvs/srv/Trigger") if is_service else None
        type_ = self.type(members.get("type") or trigger, "srv" if is_service else "action")
        template = members.get("request" if is_service else "goal") or Value(value.place, {})
        templates.check_template(self.reader, name, template)
        progress = self.progress(members.get("progress"), name)
        result = self.rule(members.get("result"))
        if not interface or type_ is None:
            return None
        return PlanRule(name, is_service, interface, type_, template, result, progress, place)

    def maneuvers(self, value: Optional[Value], origin: Optional[Origin]) -> Dict[str, PlanRule]:
        found = {}
        members = {} if value is None else self.reader.members(value, "'maneuvers'", tuple(maneuvers.PARAMETERS))
        for name, item in members.items():
            rule = self.maneuver(name, item, origin)
            if rule is not None:
                found[name] = rule
        if value is not None and members and not {"goTo", "path"} & set(members):
            self.reader.fault(value.place, "'maneuvers' needs the member 'goTo', 'path', or both")
        return found

    def maneuver(self, name: str, value: Value, origin: Optional[Origin]) -> Optional[PlanRule]:
        what, point = f"the maneuver '{name}'", ("point",) if name == "path" else ()
        known = ("action", "type", "goal", "result", "progress")
        members = self.reader.members(value, what, (*known, *point), needed=(*known[:3], *point))
        interface = self.name(members.get("action"), "an action", "navigate_to_pose")
        type_ = self.type(members.get("type"), "action")
        template, has = members.get("goal") or Value(value.place, {}), maneuvers.PARAMETERS[name]
        own = templates.parameters_of(template.plain())
        self.known_parameters(template, has, what)
        if name == "path" and "goal" in members and "points" not in own:
            self.reader.fault(template.place, "the goal of 'path' has a field with the value ${points}")
        if "point" in members:
            self.known_parameters(members["point"], maneuvers.POINT, "a point")
            own |= templates.parameters_of(members["point"].plain())
        if own & maneuvers.OF_MAP and origin is None:
            self.reader.fault(value.place, f"{what} is in metres of a map: the configuration needs 'origin'")
        progress, result = self.progress(members.get("progress"), name), self.rule(members.get("result"))
        if not interface or type_ is None:
            return None
        return PlanRule(
            name, False, interface, type_, template, result, progress, value.place, members.get("point"))

    def known_parameters(self, template: Value, known: Collection[str], what: str) -> None:
        """Reports parameters that are not those of a maneuver."""
        inside = template.data.values() if isinstance(template.data, dict) else (
            template.data if isinstance(template.data, tuple) else ())
        for item in inside:
            self.known_parameters(item, known, what)
        for parameter in sorted(templates.parameters_of(template.data) - set(known)) if not inside else ():
            self.reader.fault(template.place, f"{what} has no parameter '{parameter}'{near(parameter, known)}")

    def progress(self, value: Optional[Value], name: str) -> Optional[Progress]:
        if value is None:
            return None
        members = self.reader.members(value, "'progress'", ("field", "of", "remaining"))
        of = members.get("of")
        if of is not None and isinstance(of.data, str):
            templates.check_template(self.reader, name, of)
        else:
            self.reader.number(of, "'of'", 1, 0.001)
        if not {"field", "remaining"} & set(members) and isinstance(value.data, dict):
            self.reader.fault(value.place, "'progress' needs the member 'field', 'remaining', or both")
        return Progress(
            self.path(members.get("field")), 1 if of is None else of.plain(), self.path(members.get("remaining")),
            value.place,
        )

    def rule(self, value: Optional[Value]) -> Rule:
        if value is None:
            return Rule()
        members = self.reader.members(value, "'result'", ("field", "done", "message", "words"))
        if ("field" in members) != ("done" in members):
            self.reader.fault(value.place, "'result' has 'field' and 'done', the values of the field that mean success")
        words = self.reader.entries(members.get("words"), "'words'")
        return Rule(
            self.path(members.get("field")),
            self.reader.listed(members.get("done"), "'done'", lambda item: item.plain()),
            self.path(members.get("message")),
            {key: self.reader.text(item, "a reason") for key, item in words.items()}, value.place,
        )


def _tame(name: str) -> str:
    """A name of ROS that resembles another name."""
    tame = re.sub(r"\W", "_", name)
    return tame if re.match(r"[A-Za-z_]", tame) else f"robot_{tame}"
