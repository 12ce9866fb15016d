"""Types of ROS by name, and whether a configuration fits them. The classes come from the packages that are there: those
of the user's workspace, if it is sourced."""

from __future__ import annotations

import importlib
from typing import Any, Callable

import dolphin
from dolphin.document import Reader, near

from . import maneuvers, messages
from .configuration import Configuration, Kind, Lifecycle, PlanRule, Topic, Type
from .messages import Path, Unfit

Load = Callable[[str], Any]
"""Gives a module by its name, as `importlib.import_module` does."""


def find(package: str, folder: str, name: str, load: Load = importlib.import_module) -> Any:
    """The class of an interface. Raises `Unfit`."""
    try:
        module = load(f"{package}.{folder}")
    except ImportError as error:
        raise Unfit(f"there is no package {package} with a folder {folder}: source the workspace that has it ({error})"
                    ) from None
    found = getattr(module, name, None)
    if found is None:
        names = [each for each in dir(module) if each[:1].isupper() and "_" not in each]
        raise Unfit(f"{package} has no {folder} '{name}'{near(name, names)}")
    return found


def message(name: str, load: Load = importlib.import_module) -> Any:
    """The class of a message by the name that fields have for it: `geometry_msgs/Pose`."""
    package, _, rest = name.partition("/")
    return find(package, "msg", rest.rpartition("/")[2], load)


def of(type_: Type, load: Load = importlib.import_module) -> Any:
    """The class of a type. Raises `Unfit`."""
    return find(type_.package, type_.folder, type_.name, load)


def check(configuration: Configuration, load: Load = importlib.import_module) -> None:
    """Raises `Faulty` if types are not there, or do not have the fields that the configuration names."""
    reader = Reader(configuration.path)
    check_ = _Check(reader, load)
    for kind in configuration.kinds:
        check_.kind(kind)
    for topic in configuration.inputs.values():
        check_.topic(topic)
    reader.finish()


class _Check:
    def __init__(self, reader: Reader, load: Load) -> None:
        self.reader, self.load = reader, load

    def _find(self, name: str) -> Any:
        return message(name, self.load)

    def _of(self, type_: Type) -> Any:
        try:
            return of(type_, self.load)
        except Unfit as unfit:
            self.reader.fault(type_.place, str(unfit))
            return None

    def kind(self, kind: Kind) -> None:
        if not isinstance(kind.position, dolphin.Position):
            self.topic(kind.position)
        if kind.battery is not None:
            self.topic(kind.battery)
        for topic in kind.readings.values():
            self.topic(topic)
        if isinstance(kind.ready, Lifecycle):
            self._of(kind.ready.type)
        elif kind.ready is not None:
            self.topic(kind.ready.topic)
        for plan in (*kind.plans, *kind.maneuvers.values()):
            self.plan(plan)
        for rule in kind.maneuvers.values():
            self.maneuver(rule)

    def maneuver(self, rule: PlanRule) -> None:
        """A goal with values of its own shows whether parameters fit their fields, which have known types here."""
        try:
            class_ = of(rule.type, self.load)
            messages.build(class_.Goal, rule.values(maneuvers.sample(rule)), self._find)
        except Unfit as unfit:
            if not self.reader.faults:
                self.reader.fault(rule.template.place, str(unfit))

    def topic(self, topic: Topic) -> None:
        class_ = self._of(topic.type)
        if class_ is not None:
            self._path(topic.path, class_, topic.place)

    def _path(self, path: Any, class_: Any, place: Any) -> None:
        why = None if path is None else Path.check(path, class_, self._find)
        if why is not None:
            self.reader.fault(place, why)

    def plan(self, plan: PlanRule) -> None:
        class_ = self._of(plan.type)
        if class_ is None:
            return
        order, result = (class_.Request, class_.Response) if plan.is_service else (class_.Goal, class_.Result)
        messages.check_template(self.reader, plan.template, order, self._find)
        self._path(plan.result.field, result, plan.result.place)
        self._path(plan.result.message, result, plan.result.place)
        if plan.progress is not None:
            self._path(plan.progress.field, class_.Feedback, plan.progress.place)
            self._path(plan.progress.remaining, class_.Feedback, plan.progress.place)
