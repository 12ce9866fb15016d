"""A robot: a vehicle of Dolphin whose plans are goals of actions, and calls of services."""

from __future__ import annotations

import asyncio
import importlib
import math
import sys
import time
import uuid
from typing import (
    AbstractSet, Any, Callable, Dict, FrozenSet, Iterator, List, Mapping, Optional, Protocol, Sequence, Set,
    Tuple,
)

import dolphin
from dolphin.document import near
from dolphin.waiting import within

from . import goals, interfaces, maneuvers, messages
from .configuration import Configuration, Lifecycle, PlanRule, Ready, RobotEntry, Topic
from .maneuvers import Step
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
STATE = (1.0, 2.0)
"""Seconds between two questions for the state of a node, and until a question without an answer is given up."""
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
    """A goal of a request, from the order on. `number` is its place among those of the plan, from 0 on."""

    def __init__(self, step: Step, number: int, action: Action, id_: uuid.UUID) -> None:
        self.rule, self.parameters = step
        self.number, self.action, self.id = number, action, id_
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
        self.languages = ("imcPlan",) if entry.kind.maneuvers else ()
        self._steps: Dict[str, List[Step]] = {}
        """The goals of requests, in their order; one of a plan by name."""
        self._doubtful: Set[str] = set()
        """Requests any of whose goals may run."""
        self._goals: Dict[str, Goal] = {}
        """The goals that run."""
        self._started: Set[str] = set()
        """The requests that this adapter was ordered to start: without a goal or a call nothing was sent for them."""
        self._calls: "Dict[str, asyncio.Future[Any]]" = {}
        self._actions: Dict[str, Action] = {}
        self._services: Dict[str, Service] = {}
        self._topics: "List[Tuple[Callable[[], Any], Callable[[Any], None]]]" = []
        self._heard, self._since = -math.inf, math.inf
        self._own: Set[uuid.UUID] = set()
        """All goals of requests, of those that are over too: a status may be old."""
        self._at_first: Set[uuid.UUID] = set()
        """The goals that ran when this adapter began, if the run had begun before: they may be those of requests."""
        self._not_ready: Optional[str] = None
        self._node: Optional[Service] = None
        self._complaints: Set[str] = set()
        if links is not None:
            self._connect(links)

    def _connect(self, links: Links) -> None:
        for rule in (*self.kind.plans, *self.kind.maneuvers.values()):
            name, class_ = self.entry.resolve(rule.interface), interfaces.of(rule.type, self._load)
            if rule.is_service:
                self._services[rule.name] = links.service(name, class_)
            else:
                self._actions[rule.interface] = links.action(name, class_)
        position = self.kind.position
        if isinstance(position, dolphin.Position):
            self.report(latitude=position.latitude, longitude=position.longitude, height=position.height)
        else:
            self._listen(links, position, self._locate)
        if self.kind.battery is not None:
            self._listen(links, self.kind.battery, self._charge)
        for name, topic in self.kind.readings.items():
            self._listen(links, topic, lambda message, name=name, topic=topic: self._read(name, topic, message))
        if isinstance(self.kind.ready, Lifecycle):
            node = self.entry.resolve(self.kind.ready.node)
            self._node = links.service(f"{node}/get_state", interfaces.of(self.kind.ready.type, self._load))
            self._not_ready = f"its node {node} does not answer"
        elif self.kind.ready is not None:
            self._not_ready = self.kind.ready.otherwise
            self._listen(links, self.kind.ready.topic, self._judge_readiness)

    def _listen(self, links: Links, topic: Topic, hear: Callable[[Any], None]) -> None:
        name = self.entry.resolve(topic.name)
        self._topics.append((links.topic(name, interfaces.of(topic.type, self._load)), hear))

    # Telemetry.

    async def run(self) -> None:
        asking = None if self._node is None else asyncio.ensure_future(self._ask_state(self._node))
        try:
            while True:
                self.look()
                await asyncio.sleep(LOOK)
        finally:
            if asking is not None:
                asking.cancel()

    async def _ask_state(self, service: Service) -> None:
        """Keeps the reason why the robot is not ready up to date by the state of its node."""
        assert isinstance(self.kind.ready, Lifecycle)
        node = self.entry.resolve(self.kind.ready.node)
        request = interfaces.of(self.kind.ready.type, self._load).Request
        while True:
            answer = await within(service.call(request()), STATE[1]) if service.is_there() else None
            label = None if answer is None else str(answer.current_state.label)
            self._not_ready = {None: f"its node {node} does not answer", "active": None}.get(
                label, f"its node {node} is {label}")
            await asyncio.sleep(STATE[0])

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
            is_heard = (any(action.is_there() for action in self._actions.values())
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
        for interface, action in self._actions.items():
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
            origin, point = self.configuration.origin, getattr(message.pose, "pose", message.pose).position
            if origin is not None and math.isfinite(point.x) and math.isfinite(point.y):
                latitude, longitude = origin.locate(point.x, point.y)
                self.report(latitude=latitude, longitude=longitude, height=origin.height + point.z)
                if hasattr(message, "twist"):
                    speed = message.twist.twist.linear
                    self.report(speed=math.hypot(speed.x, speed.y))
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
        assert isinstance(ready, Ready) and ready.topic.path is not None
        self._not_ready = None if ready.topic.path.read(message) == ready.value else ready.otherwise

    def _complain(self, why: str) -> None:
        """Writes it to standard error, once."""
        if why not in self._complaints and len(self._complaints) < 100:
            self._complaints.add(why)
            print(f"{self.name}: {why}", file=sys.stderr)

    # Plans.

    async def problems(self, plan: dolphin.Plan) -> Sequence[str]:
        steps, problems = self._judged(plan)
        if problems:
            return problems
        try:
            for step in steps:
                self._message(*step)
        except Unfit as unfit:
            return [f"plan '{plan.name}': {unfit}"]
        return []

    def _judged(self, plan: dolphin.Plan) -> Tuple[List[Step], List[str]]:
        """The goals of a plan, or the call of its service; and the reasons why it cannot be carried out."""
        if plan.language is not None:
            place = self.known.get("latitude"), self.known.get("longitude")
            start = None if place[0] is None or place[1] is None else (place[0], place[1])
            return maneuvers.compile_plan(
                plan.body, self.name, self.kind.maneuvers, self.configuration.origin, start)
        found = self.kind.plan(plan.name)
        if found is None:
            names = [rule.name for rule in self.kind.plans]
            return [], [f"undefined plan '{plan.name}'{near(plan.name, names)}"]
        return [Step(*found)], []

    def _message(self, rule: PlanRule, parameters: Mapping[str, Any]) -> Any:
        """The goal or the request of a plan. Raises `Unfit`."""
        class_ = interfaces.of(rule.type, self._load)
        kind = class_.Request if rule.is_service else class_.Goal
        return messages.build(kind, rule.values(parameters), lambda name: interfaces.message(name, self._load))

    def _found(self, plan: dolphin.Plan) -> List[Step]:
        """The goals of a plan that an adapter has accepted."""
        steps = self._steps.get(plan.request)
        if steps is None:
            steps, problems = self._judged(plan)
            if problems:
                raise dolphin.Unknown(f"its configuration has no plan '{plan.name}' any more")
            self._steps[plan.request] = steps
        return steps

    async def start(self, plan: dolphin.Plan) -> None:
        self._started.add(plan.request)
        steps = self._found(plan)
        rule, parameters = steps[0]
        if rule.is_service:
            message = self._message(rule, parameters)
            service = self._services[rule.name]
            await self._present(service, f"has no service {self.entry.resolve(rule.interface)}")
            self._calls[plan.request] = asyncio.ensure_future(service.call(message))
            return
        for step in steps:
            await self._present(
                self._actions[step.rule.interface], f"has no action {self.entry.resolve(step.rule.interface)}")
        while not self._is_settled() and self._since < math.inf:
            await asyncio.sleep(LOOK)
        await self._send(plan, 0)

    async def _send(self, plan: dolphin.Plan, number: int) -> None:
        """Sends a goal of the plan; returns once it is accepted."""
        foreign = self._foreign()
        if foreign is not None:
            self._forget(plan)
            raise dolphin.Failed(foreign)
        rule, parameters = self._found(plan)[number]
        message = self._message(rule, parameters)
        goal = self._goal(plan, number)
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
        steps = self._found(plan)
        if steps[0].rule.is_service:
            await self._reply(steps[0].rule, plan)
            return
        while True:
            await self._end_of_goal(plan, steps)
            number = self._goals[plan.request].number + 1
            if number == len(steps):
                self._forget(plan)
                return
            await plan.note({"goal": number})  # before it is sent: `resume` looks for this one
            await self._send(plan, number)

    async def _end_of_goal(self, plan: dolphin.Plan, steps: Sequence[Step]) -> None:
        """Returns once the goal that runs is done."""
        goal, end = self._goals[plan.request], None
        while end is None:
            end = await goal.end(LOOK)
            self._report_progress(plan, goal, len(steps))
        try:
            goals.judge(goal.rule, *end)
        except dolphin.Failed:
            self._forget(plan)
            raise

    def _report_progress(self, plan: dolphin.Plan, goal: Goal, count: int) -> None:
        feedback = goal.action.feedback(goal.id)
        if feedback is not None:
            share, remaining = goals.share(goal.rule, goal.parameters, feedback), goals.remaining(goal.rule, feedback)
            if share is not None:
                share = (goal.number + min(1.0, max(0.0, share))) / count
            if share is not None or remaining is not None:
                plan.progress(share, remaining if count == 1 else None)

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
        self._steps.pop(plan.request, None)

    async def stop(self, plan: dolphin.Plan) -> None:
        steps = self._found(plan)
        if plan.request in self._started and plan.request not in self._goals and plan.request not in self._calls:
            return  # the stop came before anything was sent
        if steps[0].rule.is_service:
            await self._stop_call(steps[0].rule, plan)
        elif plan.request in self._goals and plan.request not in self._doubtful:
            await self._stop_goal(self._goals[plan.request])
        else:
            for number in range(_noted(plan), len(steps)):
                await self._stop_goal(self._goal(plan, number))
        self._doubtful.discard(plan.request)
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
                code = await within(goal.action.cancel(goal.id), CANCEL_WAIT)
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

    def _goal(self, plan: dolphin.Plan, number: int) -> Goal:
        """A goal of a request, which counts as running; this adapter or one before it sends it."""
        step, before = self._found(plan)[number], self._goals.get(plan.request)
        if before is not None:
            before.forget()
        goal = Goal(
            step, number, self._actions[step.rule.interface], goals.goal_id(self.name, plan.request, number))
        self._goals[plan.request] = goal
        self._own.add(goal.id)
        return goal

    async def resume(self, plan: dolphin.Plan) -> None:
        steps, number = self._found(plan), _noted(plan)
        rule = steps[number].rule
        if rule.is_service:
            raise dolphin.Unknown(f"the reply of its service {rule.interface} went to an adapter that has ended")
        self._own.update(goals.goal_id(self.name, plan.request, later) for later in range(number, len(steps)))
        if plan.doubt is not None and len(steps) > 1:
            self._doubtful.add(plan.request)
            raise dolphin.Unknown("the journal may have lost which of its goals was sent last")
        goal, waited = self._goal(plan, number), 0.0
        while waited < self.configuration.answer:
            if goal.action.statuses().get(goal.id) in goals.ACTIVE:
                return
            end = await goal.end(LOOK)
            if end is not None and end[0] == goals.SUCCEEDED and number + 1 < len(steps):
                return  # `finish` judges it, and goes on with the next one
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


def _noted(plan: dolphin.Plan) -> int:
    """The number of the goal that was sent last, by the notes on the plan."""
    return next((int(note["goal"]) for note in plan.notes if "goal" in note), 0)
