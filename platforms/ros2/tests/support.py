"""Shared by the tests: Dolphin's side of the protocol in memory, and robots without ROS."""

from __future__ import annotations

import asyncio
import uuid
from types import SimpleNamespace
from typing import Any, Awaitable, Callable, Dict, FrozenSet, List, Mapping, Optional, Tuple

import dolphin
from dolphin.channel import Channel

from dolphin_ros2 import configuration, configuration_file, goals
from dolphin_ros2.robot import Robot

TEXT = """\
answer: 0.6
origin: {latitude: 41.185, longitude: -8.706}
inputs:
  sighting: {topic: /detections, type: fake_msgs/msg/Text, field: data}
kinds:
  carrier:
    type: UGV
    payload: [tray]
    silence: 1000
    position: {topic: odom, type: nav_msgs/msg/Odometry}
    battery: {topic: battery_state}
    ready: {topic: state, type: fake_msgs/msg/Text, field: data, is: idle, otherwise: is charging}
    readings:
      Load: {topic: load, type: fake_msgs/msg/Number, field: data}
    plans:
      home: {action: drive, type: fake_msgs/action/Drive, goal: {bay: 0}}
      'drive_${bay}':
        action: drive
        type: fake_msgs/action/Drive
        goal: {bay: '${bay}', label: 'bay ${bay}', pose: {x: 1}}
        progress: {field: done, of: 4, remaining: left}
        result: {field: code, done: [0, 1], message: text, words: {7: the bay is occupied}}
      tare: {service: tare, type: fake_msgs/srv/Trigger}
robots:
  carrier-1: {kind: carrier, namespace: /carrier1}
"""


def message(name: str, **fields: str) -> Any:
    """A class as rosidl makes them: its fields with their types, and default values."""
    defaults = {"string": "", "boolean": False, "double": 0.0}

    def __init__(self: Any, **values: Any) -> None:
        for key, field in fields.items():
            default = [] if field.startswith("sequence") else find(field)() if "/" in field else defaults.get(field, 0)
            setattr(self, key, values.get(key, default))

    def listed(*_: Any) -> Dict[str, str]:
        return dict(fields)

    return type(name, (), {"__init__": __init__, "get_fields_and_field_types": classmethod(listed)})


Point = message("Point", x="double", y="double", z="double")
Pose = message("Pose", x="double", cells="sequence<fake_msgs/Point>")
CLASSES = {
    "fake_msgs.msg": SimpleNamespace(
        Text=message("Text", data="string"), Number=message("Number", data="double"), Point=Point, Pose=Pose,
        Duration=message("Duration", sec="int32", nanosec="uint32")),
    "fake_msgs.action": SimpleNamespace(Drive=SimpleNamespace(
        Goal=message("Drive_Goal", bay="int32", label="string<12>", pose="fake_msgs/Pose", quick="boolean"),
        Result=message("Drive_Result", code="int32", text="string"),
        Feedback=message("Drive_Feedback", done="sequence<int32>", left="fake_msgs/Duration")),
        Follow=SimpleNamespace(
            Goal=message("Follow_Goal", points="sequence<fake_msgs/Point>", speed="double"),
            Result=message("Follow_Result"), Feedback=message("Follow_Feedback")),
        Wait=SimpleNamespace(
            Goal=message("Wait_Goal", time="fake_msgs/Duration"), Result=message("Wait_Result"),
            Feedback=message("Wait_Feedback"))),
    "lifecycle_msgs.srv": SimpleNamespace(GetState=SimpleNamespace(
        Request=message("GetState_Request"), Response=message("GetState_Response", current_state="fake_msgs/Pose"))),
    "fake_msgs.srv": SimpleNamespace(Trigger=SimpleNamespace(
        Request=message("Trigger_Request"), Response=message("Trigger_Response", success="boolean", message="string"))),
    "nav_msgs.msg": SimpleNamespace(Odometry=message("Odometry", pose="double", twist="double")),
    "sensor_msgs.msg": SimpleNamespace(
        BatteryState=message("BatteryState", percentage="double"), NavSatFix=message("NavSatFix", latitude="double")),
}
Drive = CLASSES["fake_msgs.action"].Drive


def load(name: str) -> Any:
    if name not in CLASSES:
        raise ImportError(f"No module named '{name}'")
    return CLASSES[name]


def find(name: str) -> Any:
    return getattr(CLASSES["fake_msgs.msg"], name.rpartition("/")[2])


def odometry(x: float, y: float = 0.0) -> Any:
    point, speed = SimpleNamespace(x=x, y=y, z=0.0), SimpleNamespace(x=3.0, y=4.0)
    return SimpleNamespace(
        pose=SimpleNamespace(pose=SimpleNamespace(position=point)), twist=SimpleNamespace(
            twist=SimpleNamespace(linear=speed)))


class FakeServer:
    """An action server, and its client. `accepts` is its answer to goals, or `None`: no answer; `cancels` the code of
    its answer to cancellations. It outlives adapters; `restart` makes it forget."""

    def __init__(self) -> None:
        self.there, self.accepts, self.cancels = True, True, goals.ERROR_NONE
        self.sent: List[uuid.UUID] = []
        self.begun: List[Tuple[uuid.UUID, Any]] = []
        self.states: Dict[uuid.UUID, int] = {}
        self.results: "Dict[uuid.UUID, Any]" = {}
        self.cancelled: List[uuid.UUID] = []
        self.news: Dict[uuid.UUID, Any] = {}
        self.life = 0

    def restart(self) -> None:
        self.states, self.results, self.life = {}, {}, self.life + 1

    def end(self, goal: uuid.UUID, status: int, **fields: Any) -> None:
        self.states[goal], self.results[goal] = status, Drive.Result(**fields)

    def last(self) -> uuid.UUID:
        return self.begun[-1][0]

    # As a client.

    def is_there(self) -> bool:
        return self.there

    def servers(self) -> FrozenSet[Any]:
        return frozenset({self.life} if self.there else {})

    def statuses(self) -> Mapping[uuid.UUID, int]:
        return self.states if self.there else {}

    def feedback(self, goal: uuid.UUID) -> Any:
        return self.news.pop(goal, None)

    async def send(self, goal: uuid.UUID, message: Any) -> bool:
        self.sent.append(goal)
        while self.accepts is None:
            await asyncio.sleep(0.01)
        if self.accepts and goal not in self.states:
            self.begun.append((goal, message))
            self.states[goal] = goals.EXECUTING
            return True
        return False

    async def result(self, goal: uuid.UUID) -> Tuple[int, Any]:
        life = self.life
        while self.states.get(goal) in goals.ACTIVE or not self.there:
            await asyncio.sleep(0.01)
        if life != self.life:  # the server that was asked has gone
            await asyncio.Event().wait()
        return self.states.get(goal, goals.UNKNOWN), self.results.get(goal)

    async def cancel(self, goal: uuid.UUID) -> int:
        self.cancelled.append(goal)
        if goal not in self.states:
            return goals.ERROR_UNKNOWN_GOAL_ID
        if self.states[goal] in goals.OVER:
            return goals.ERROR_GOAL_TERMINATED
        if self.cancels == goals.ERROR_NONE:
            self.end(goal, goals.CANCELED)
        return self.cancels


class FakeService:
    def __init__(self) -> None:
        self.there = True
        self.replies: "asyncio.Queue[Any]" = asyncio.Queue()

    def is_there(self) -> bool:
        return self.there

    async def call(self, message: Any) -> Any:
        return await self.replies.get()


class FakeLinks:
    """A network of one robot. `topics` has the next message of each topic."""

    def __init__(self) -> None:
        self.server, self.tare = FakeServer(), FakeService()
        self.topics: Dict[str, Any] = {}

    def action(self, name: str, class_: Any) -> FakeServer:
        """All actions have one server, as goals do that exclude each other."""
        return self.server

    def service(self, name: str, class_: Any) -> FakeService:
        return self.tare

    def topic(self, name: str, class_: Any) -> Callable[[], Any]:
        return lambda: self.topics.pop(name, None)

    def speak(self, **messages_: Any) -> None:
        """The robot is heard, is idle, and publishes these messages."""
        self.topics.update({"/carrier1/odom": odometry(0.0), "/carrier1/state": SimpleNamespace(data="idle")})
        self.topics.update({f"/carrier1/{name}": each for name, each in messages_.items()})


class Console(Channel):
    """Dolphin's side: `order` gives orders, `reports` has the answers. Notes are kept at once."""

    def __init__(self, resumes: bool = False) -> None:
        self.reports: List[Dict[str, Any]] = []
        self._orders: "asyncio.Queue[Optional[Dict[str, Any]]]" = asyncio.Queue()
        self.order("hello", protocol=1, dolphin="test", purpose="run", resumes=resumes)

    async def receive(self) -> Optional[Dict[str, Any]]:
        return await self._orders.get()

    def send(self, message: Mapping[str, Any]) -> None:
        self.reports.append(dict(message))
        if message["kind"] == "note":
            self.order("kept", id=message["id"])

    def order(self, kind: str, **members: Any) -> None:
        self._orders.put_nowait({"kind": kind, **members})

    def die(self) -> None:
        self._orders.put_nowait(None)

    def task(self, kind: str, request: str, plan: Any = "drive_3", **members: Any) -> None:
        whole = {"name": plan} if isinstance(plan, str) else plan
        self.order(kind, request=request, vehicle="carrier-1", plan=whole, timeout=60, **members)

    def words(self, request: str) -> List[str]:
        """The reports on a request, without estimates and notes."""
        kinds = [report["kind"] for report in self.reports if report.get("request") == request]
        return [kind for kind in kinds if kind not in ("progress", "note")]

    def why(self, request: str) -> str:
        return [report["why"] for report in self.reports if report.get("request") == request and "why" in report][-1]

    def last(self, member: str) -> Any:
        """The vehicle's member as it was reported last, or `...`."""
        found = [report[member] for report in self.reports if report["kind"] == "vehicle" and member in report]
        return found[-1] if found else ...


def found() -> configuration.Configuration:
    return configuration_file.of_text(TEXT, "robots.yaml")


def converse(links: FakeLinks, script: Callable[[Console, Robot], Awaitable[None]], resumes: bool = False,
             configured: Optional[configuration.Configuration] = None) -> Console:
    """An adapter's life with a robot, which is heard and idle unless the script changes that. Afterwards the adapter is
    dead: nothing that it had begun goes on."""

    async def go() -> Console:
        own = configured or found()
        robot = Robot(own.robots[0], own, links, load)
        adapter, console = dolphin.Adapter("ros2", [robot]), Console(resumes)
        links.speak()
        conversation = asyncio.ensure_future(adapter.converse(console))
        await script(console, robot)
        console.die()
        await conversation
        return console

    return asyncio.run(go())
