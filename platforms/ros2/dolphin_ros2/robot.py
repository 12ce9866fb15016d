"""A robot: a vehicle of Dolphin whose plans are goals of actions, and calls of services."""

from __future__ import annotations

import asyncio
import importlib
import math
import sys
import time
import uuid
from typing import (
    AbstractSet, Any, Awaitable, Callable, Dict, FrozenSet, Iterator, List, Mapping, Optional, Protocol, Sequence, Set,
    Tuple,
)

import dolphin

from . import goals, interfaces, messages
from .configuration import Configuration, PlanRule, RobotEntry, Topic
from .document import near
from .messages import Unfit

LOOK = 0.25
"""Seconds between two looks at topics."""
SETTLE = 1.0
"""Seconds from the first message of a robot until it has a link: its goals are discovered meanwhile."""
PRESENT = 3.0
"""Seconds within which an action or service is to be discovered before it counts as missing."""
ASK_AGAIN = (2.0, 60.0)
"""Seconds until a result is asked for the second time, and from then on. Each request stays with the server until the
goal is over, so they are few."""
MOST_ASKED = 3
"""Requests for one result that are waited for at once at most."""
ASK_AT_MOST = 0.5
"""Seconds between two requests for a result at least."""
CANCEL_WAIT = 2.0
"""Seconds that a reply to a cancellation is waited for."""
CERTAIN = 2
"""A server that does not know a goal is asked this often before the goal counts as not running."""


class Action(Protocol):
    """The client of an action of a robot: `ros.Action`, or that of a test."""

    def is_there(self) -> bool: ...

    def servers(self) -> FrozenSet[Any]:
        """The identities of its servers. One that is started again has another identity."""

    def statuses(self) -> Mapping[uuid.UUID, int]:
        """The goals of all clients that the server knows, as it reported them last."""

    def feedback(self, goal: uuid.UUID) -> Any:
        """The latest feedback on a goal that was not seen yet, or `None`."""

    async def send(self, goal: uuid.UUID, message: Any) -> bool:
        """Sends a goal. Whether it is accepted."""

    async def result(self, goal: uuid.UUID) -> Tuple[int, Any]:
        """The status and the result of a goal once it is over; status UNKNOWN if the server does not know the goal."""

    async def cancel(self, goal: uuid.UUID) -> int:
        """Asks for the cancellation of a goal. The return code."""


class Service(Protocol):
    """The client of a service of a robot."""

    def is_there(self) -> bool: ...

    async def call(self, message: Any) -> Any: ...


class Links(Protocol):
    """The connection to ROS: `ros.Links`, or that of a test."""

    def action(self, name: str, class_: Any) -> Action: ...

    def service(self, name: str, class_: Any) -> Service: ...

    def topic(self, name: str, class_: Any) -> Callable[[], Any]:
        """A function that gives the latest message if it was not seen yet, or else `None`."""


class Goal:
    """A goal of a request, from the order on."""

    def __init__(self, rule: PlanRule, parameters: Mapping[str, str], action: Action, id_: uuid.UUID) -> None:
        self.rule, self.parameters, self.action, self.id = rule, parameters, action, id_
        self.reply: "Optional[asyncio.Future[bool]]" = None
        """The server's answer to the goal: accepted or rejected. `None` if an adapter before this one sent it."""
        self.sent_to: FrozenSet[Any] = frozenset()
        self._asked: "Dict[asyncio.Future[Tuple[int, Any]], FrozenSet[Any]]" = {}
        self._times: List[float] = []

    def send(self, message: Any) -> "asyncio.Future[bool]":
        self.sent_to = self.action.servers()
        self.reply = asyncio.ensure_future(self.action.send(self.id, message))
        return self.reply

    def is_owed(self) -> bool:
        """Whether a server that got the goal has not answered yet, so that it may still accept it."""
        if self.reply is None or self.reply.done():
            return False
        return not self.sent_to or bool(self.sent_to & self.action.servers())

    async def end(self, seconds: float) -> Optional[Tuple[int, Any]]:
        """The status and the result if the goal is over within these seconds; status UNKNOWN if its server does not
        know it; `None` if it still runs, or if the server is silent."""
        if self.action.is_there():
            self._ask()
        if not self._asked:
            await asyncio.sleep(seconds)
            return None
        done, _ = await asyncio.wait(set(self._asked), timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        answers = []
        for future in done:
            del self._asked[future]
            answers.append(future.result())
        over = [answer for answer in answers if answer[0] in goals.OVER]
        unknown = [answer for answer in answers if answer[0] == goals.UNKNOWN]
        found = over or unknown
        return found[0] if found else None

    def _ask(self) -> None:
        """Asks for the result if that is not asked yet, if a new server is there, and now and then once more."""
        servers, since = self.action.servers(), time.monotonic() - (self._times[-1] if self._times else -math.inf)
        if since < ASK_AT_MOST:
            return
        known = frozenset().union(*self._asked.values()) if self._asked else frozenset()
        again = ASK_AGAIN[0] if len(self._times) == 1 else ASK_AGAIN[1]
        if self._asked and servers <= known and since < again:
            return
        if len(self._asked) == MOST_ASKED:
            oldest = next(iter(self._asked))
            oldest.cancel()
            del self._asked[oldest]
        self._asked[asyncio.ensure_future(self.action.result(self.id))] = servers
        self._times.append(time.monotonic())

    def forget(self) -> None:
        for asked in self._asked:
            asked.cancel()
        if self.reply is not None:
            self.reply.cancel()
        self._asked.clear()


class Robot(dolphin.Vehicle):
    """A robot of the configuration. Without links, as for `dolphin check`, it only judges plans."""

    def __init__(self, entry: RobotEntry, configuration: Configuration, links: Optional[Links] = None,
                 load: Optional[interfaces.Load] = None, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__(entry.name, type=entry.kind.type, payload=entry.payload, link=False)
        self.entry, self.kind, self.configuration, self._clock = entry, entry.kind, configuration, clock
        self._load = load or importlib.import_module
        self._goals: Dict[str, Goal] = {}
        self._started: Set[str] = set()
        """The requests that this adapter was ordered to start: without a goal or a call nothing was sent for them."""
        self._calls: "Dict[str, asyncio.Future[Any]]" = {}
        self._actions: Dict[str, Action] = {}
        self._by_interface: Dict[str, Action] = {}
        self._services: Dict[str, Service] = {}
        self._topics: "List[Tuple[Callable[[], Any], Callable[[Any], None]]]" = []
        self._heard, self._since = -math.inf, math.inf
        self._own: Set[uuid.UUID] = set()
        """All goals of requests, of those that are over too: a status may be old."""
        self._at_first: Set[uuid.UUID] = set()
        """The goals that ran when this adapter began, if the run had begun before: they may be those of requests."""
        self._not_ready: Optional[str] = None
        self._complaints: Set[str] = set()
        if links is not None:
            self._connect(links)

    def _connect(self, links: Links) -> None:
        for rule in self.kind.plans:
            name, class_ = self.entry.resolve(rule.interface), interfaces.of(rule.type, self._load)
            if rule.is_service:
                self._services[rule.name] = links.service(name, class_)
            else:
                self._actions[rule.name] = self._by_interface[rule.interface] = links.action(name, class_)
        position = self.kind.position
        if isinstance(position, dolphin.Position):
            self.report(latitude=position.latitude, longitude=position.longitude, height=position.height)
        else:
            self._listen(links, position, self._locate)
        if self.kind.battery is not None:
            self._listen(links, self.kind.battery, self._charge)
        for name, topic in self.kind.readings.items():
            self._listen(links, topic, lambda message, name=name, topic=topic: self._read(name, topic, message))
        if self.kind.ready is not None:
            self._not_ready = self.kind.ready.otherwise
            self._listen(links, self.kind.ready.topic, self._judge_readiness)

    def _listen(self, links: Links, topic: Topic, hear: Callable[[Any], None]) -> None:
        name = self.entry.resolve(topic.name)
        self._topics.append((links.topic(name, interfaces.of(topic.type, self._load)), hear))

    # Telemetry.

    async def run(self) -> None:
        while True:
            self.look()
            await asyncio.sleep(LOOK)

    def look(self) -> None:
        """Reports what the topics have, the link, and whether the robot can be given a plan."""
        for latest, hear in self._topics:
            message = latest()
            if message is not None:
                self._heard = self._clock()
                try:
                    hear(message)
                except (TypeError, ValueError, AttributeError) as error:
                    self._complain(f"a message is of no use: {' '.join(str(error).split())}")
        if self._topics:
            is_heard = self._clock() - self._heard <= self.kind.silence
        else:
            is_heard = (any(action.is_there() for action in self._by_interface.values())
                        or any(service.is_there() for service in self._services.values()))
        if not is_heard:
            self._since = math.inf
        elif self._since == math.inf:
            self._since = self._clock()
        if is_heard and not self._is_settled() and self._adapter is not None and self._adapter.resumes:
            self._at_first.update(id_ for id_, _ in self._running())
        self.report(link=is_heard and self._is_settled(), unready=self._foreign(self._at_first) or self._not_ready)

    def _is_settled(self) -> bool:
        """Whether the robot has been heard for long enough to know its goals."""
        return self._clock() >= self._since + SETTLE

    def _running(self) -> Iterator[Tuple[uuid.UUID, str]]:
        """The goals that run, of any client, with the names of their actions."""
        for interface, action in self._by_interface.items():
            for id_, status in action.statuses().items():
                if status in goals.ACTIVE:
                    yield id_, interface

    def _foreign(self, but: AbstractSet[uuid.UUID] = frozenset()) -> Optional[str]:
        """The reason why the robot is not ready if it runs a goal of another client."""
        for id_, interface in self._running():
            if id_ not in self._own and id_ not in but:
                return f"runs a goal of another client on its action {interface}"
        return None

    def _locate(self, message: Any) -> None:
        if hasattr(message, "pose"):
            origin, point = self.configuration.origin, message.pose.pose.position
            speed = message.twist.twist.linear
            if origin is not None and math.isfinite(point.x) and math.isfinite(point.y):
                latitude, longitude = origin.locate(point.x, point.y)
                self.report(latitude=latitude, longitude=longitude, height=origin.height + point.z,
                            speed=math.hypot(speed.x, speed.y))
        elif message.status.status >= 0:  # there is a fix
            self.report(latitude=message.latitude, longitude=message.longitude, height=message.altitude)

    def _charge(self, message: Any) -> None:
        topic = self.kind.battery
        assert topic is not None
        self.report(battery=message.percentage if topic.path is None else topic.path.read(message))

    def _read(self, name: str, topic: Topic, message: Any) -> None:
        assert topic.path is not None
        value = topic.path.read(message)
        if isinstance(value, bool) or not isinstance(value, (int, float, type(None))):
            raise TypeError(f"{topic.path.text} of {topic.name} is {value!r}, not a number")
        self.report(readings={name: value})

    def _judge_readiness(self, message: Any) -> None:
        ready = self.kind.ready
        assert ready is not None and ready.topic.path is not None
        self._not_ready = None if ready.topic.path.read(message) == ready.value else ready.otherwise

    def _complain(self, why: str) -> None:
        """Writes it to standard error, once."""
        if why not in self._complaints and len(self._complaints) < 100:
            self._complaints.add(why)
            print(f"{self.name}: {why}", file=sys.stderr)

    # Plans.

    async def problems(self, plan: dolphin.Plan) -> Sequence[str]:
        found = self.kind.plan(plan.name)
        if found is None:
            names = [rule.name for rule in self.kind.plans]
            return [f"undefined plan '{plan.name}'{near(plan.name, names)}"]
        try:
            self._message(*found)
        except Unfit as unfit:
            return [f"plan '{plan.name}': {unfit}"]
        return []

    def _message(self, rule: PlanRule, parameters: Mapping[str, str]) -> Any:
        """The goal or the request of a plan. Raises `Unfit`."""
        class_ = interfaces.of(rule.type, self._load)
        kind = class_.Request if rule.is_service else class_.Goal
        return messages.build(kind, rule.values(parameters), lambda name: interfaces.message(name, self._load))

    def _found(self, plan: dolphin.Plan) -> Tuple[PlanRule, Dict[str, str]]:
        found = self.kind.plan(plan.name)
        if found is None:
            raise dolphin.Unknown(f"its configuration has no plan '{plan.name}' any more")
        return found

    async def start(self, plan: dolphin.Plan) -> None:
        self._started.add(plan.request)
        rule, parameters = self._found(plan)
        message = self._message(rule, parameters)
        if rule.is_service:
            service = self._services[rule.name]
            await self._present(service, f"has no service {self.entry.resolve(rule.interface)}")
            self._calls[plan.request] = asyncio.ensure_future(service.call(message))
            return
        action = self._actions[rule.name]
        await self._present(action, f"has no action {self.entry.resolve(rule.interface)}")
        while not self._is_settled() and self._since < math.inf:
            await asyncio.sleep(LOOK)
        foreign = self._foreign()
        if foreign is not None:
            raise dolphin.Failed(foreign)
        goal = self._goal(plan, rule, parameters)
        goal.send(message)
        if not await self._is_accepted(goal):
            self._forget(plan)
            raise dolphin.Failed(f"its action {rule.interface} rejects the goal")

    async def _present(self, interface: Any, otherwise: str) -> None:
        """Returns once the interface is there. Nothing was sent: it fails otherwise."""
        end = time.monotonic() + PRESENT
        while not interface.is_there():
            if time.monotonic() > end:
                raise dolphin.Failed(otherwise)
            await asyncio.sleep(LOOK / 5)

    async def _is_accepted(self, goal: Goal) -> bool:
        """Whether the server accepts the goal: by its answer, or if that is lost by the statuses that it reports."""
        assert goal.reply is not None
        end = time.monotonic() + self.configuration.answer
        while time.monotonic() < end:
            await asyncio.wait({goal.reply}, timeout=LOOK)
            if goal.reply.done():
                return goal.reply.result()
            if goal.id in goal.action.statuses():
                return True
        raise dolphin.Unknown(
            f"its action {goal.rule.interface} has not answered the goal for {self.configuration.answer:g} seconds")

    async def finish(self, plan: dolphin.Plan) -> None:
        rule, _ = self._found(plan)
        if rule.is_service:
            await self._reply(rule, plan)
            return
        goal = self._goals[plan.request]
        end = None
        while end is None:
            end = await goal.end(LOOK)
            self._report_progress(plan, goal)
        if end[0] != goals.UNKNOWN:
            self._forget(plan)
        goals.judge(rule, *end)

    def _report_progress(self, plan: dolphin.Plan, goal: Goal) -> None:
        feedback = goal.action.feedback(goal.id)
        if feedback is not None:
            share, remaining = goals.share(goal.rule, goal.parameters, feedback), goals.remaining(goal.rule, feedback)
            if share is not None or remaining is not None:
                plan.progress(share, remaining)

    async def _reply(self, rule: PlanRule, plan: dolphin.Plan) -> None:
        call, service, missing = self._calls[plan.request], self._services[rule.name], 0.0
        while not call.done():
            await asyncio.wait({call}, timeout=LOOK)
            missing = 0.0 if service.is_there() else missing + LOOK
            if missing > PRESENT and not call.done():
                raise dolphin.Unknown(f"its service {rule.interface} went away before it replied")
        self._forget(plan)
        goals.judge_reply(rule, call.result())

    def _forget(self, plan: dolphin.Plan) -> None:
        goal = self._goals.pop(plan.request, None)
        if goal is not None:
            goal.forget()
        self._calls.pop(plan.request, None)

    async def stop(self, plan: dolphin.Plan) -> None:
        rule, parameters = self._found(plan)
        if plan.request in self._started and plan.request not in self._goals and plan.request not in self._calls:
            return  # the stop came before anything was sent
        if rule.is_service:
            await self._stop_call(rule, plan)
        else:
            goal = self._goals.get(plan.request) or self._goal(plan, rule, parameters)
            await self._stop_goal(goal)
        self._forget(plan)

    async def _stop_call(self, rule: PlanRule, plan: dolphin.Plan) -> None:
        call = self._calls.get(plan.request)
        if call is None:
            raise dolphin.Unknown(f"the reply of its service {rule.interface} went to an adapter that has ended")
        await asyncio.wait({call}, timeout=LOOK)
        if not call.done():
            raise dolphin.Unknown(f"its service {rule.interface} has not replied, and a call cannot be cancelled")

    async def _stop_goal(self, goal: Goal) -> None:
        """Returns once the goal is over, or its server has answered twice that it does not know it."""
        unknown, again = 0, -math.inf
        while True:
            if goal.action.is_there() and time.monotonic() >= again:
                code = await _within(goal.action.cancel(goal.id), CANCEL_WAIT)
                again = time.monotonic() + CANCEL_WAIT
                if code == goals.ERROR_REJECTED:
                    raise dolphin.Unknown(f"its action {goal.rule.interface} rejects the cancellation")
                if code == goals.ERROR_UNKNOWN_GOAL_ID and not goal.is_owed():
                    unknown += 1
                elif code is not None:
                    unknown = 0
            end = await goal.end(LOOK)
            if end is not None and end[0] in goals.OVER or unknown >= CERTAIN:
                return

    def _goal(self, plan: dolphin.Plan, rule: PlanRule, parameters: Mapping[str, str]) -> Goal:
        """The goal of a request; this adapter or one before it sends it."""
        goal = Goal(rule, parameters, self._actions[rule.name], goals.goal_id(self.name, plan.request))
        self._goals[plan.request] = goal
        self._own.add(goal.id)
        return goal

    async def resume(self, plan: dolphin.Plan) -> None:
        rule, parameters = self._found(plan)
        if rule.is_service:
            raise dolphin.Unknown(f"the reply of its service {rule.interface} went to an adapter that has ended")
        goal, waited = self._goal(plan, rule, parameters), 0.0
        while waited < self.configuration.answer:
            if goal.action.statuses().get(goal.id) in goals.ACTIVE:
                return
            end = await goal.end(LOOK)
            if end is not None and end[0] in goals.OVER:
                self._forget(plan)
                goals.judge(rule, *end)
                raise dolphin.Done()
            if end is not None:
                raise dolphin.Unknown(
                    f"its action {rule.interface} does not know the goal: it never had it, or it was started again, or "
                    "the goal has been over for long")
            waited += LOOK if self._since < math.inf or goal.action.is_there() else 0.0
        raise dolphin.Unknown(f"its action {rule.interface} does not answer")


async def _within(work: Awaitable[Any], seconds: float) -> Any:
    """The result of the work, or `None` after these seconds."""
    try:
        return await asyncio.wait_for(work, seconds)
    except asyncio.TimeoutError:
        return None
