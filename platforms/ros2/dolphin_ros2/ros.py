"""The connection to ROS 2, by rclpy. Actions are used by the services and topics that they consist of, as the design of
ROS 2 actions defines them: rclpy's own client does not ask about goals that another process has sent.

Replies come by an executor in a thread. Topics are not: each has a queue of one message, which the adapter
takes when it looks. So robots may publish a hundred times a second, and cost nothing here."""

from __future__ import annotations

import asyncio
import os
import threading
import uuid
from typing import Any, Callable, Dict, FrozenSet, Mapping, Optional, Tuple

import rclpy
from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String

_LATEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE)
_STATUS = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_FEEDBACK = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE)
_EVERY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE)


class Links:
    """The connection of this process."""

    def __init__(self, domain: Optional[int] = None) -> None:
        self._loop = asyncio.get_running_loop()
        self._context = Context()
        rclpy.init(
            args=[], context=self._context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
        options: Dict[str, Any] = {"context": self._context, "start_parameter_services": False, "enable_rosout": False}
        self.caller = Node(f"dolphin_ros2_{os.getpid()}", **options)
        self.listener = Node(f"dolphin_ros2_{os.getpid()}_topics", **options)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.caller)
        self._actions: Dict[str, Action] = {}
        self._thread = threading.Thread(target=self._spin, daemon=True)

    def open(self) -> None:
        """Begins to receive replies. Clients are made before."""
        self._thread.start()

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except ExternalShutdownException:
            pass

    def close(self) -> None:
        """Leaves the network, so that robots need not find out by themselves that this process has ended."""
        rclpy.shutdown(context=self._context)

    def action(self, name: str, class_: Any) -> "Action":
        """The client of an action. Plans may share one."""
        if name not in self._actions:
            self._actions[name] = Action(self, name, class_)
        return self._actions[name]

    def service(self, name: str, class_: Any) -> "Service":
        return Service(self, name, class_)

    def topic(self, name: str, class_: Any) -> Callable[[], Any]:
        take = self.subscribe(name, class_, _LATEST)

        def latest() -> Any:
            taken = take()
            return None if taken is None else taken[0]

        return latest

    def publisher(self, name: str) -> Callable[[str], None]:
        """A function that publishes a text."""
        publisher = self.caller.create_publisher(String, name, 100)
        return lambda text: publisher.publish(String(data=text))

    def every(self, name: str, class_: Any, hear: Callable[[Any], None]) -> None:
        """Calls `hear` on the loop for every message of a topic."""
        self.caller.create_subscription(class_, name, lambda message: self.on_loop(lambda: hear(message)), _EVERY)

    def subscribe(self, name: str, class_: Any, profile: QoSProfile) -> Callable[[], Optional[Tuple[Any, Any]]]:
        """A function that takes the next message of a topic, with its origin."""
        subscription = self.listener.create_subscription(class_, name, lambda message: None, profile)

        def take() -> Optional[Tuple[Any, Any]]:
            with subscription.handle:
                taken: Optional[Tuple[Any, Any]] = subscription.handle.take_message(class_, False)
            return taken

        return take

    def on_loop(self, call: Callable[[], None]) -> None:
        try:
            self._loop.call_soon_threadsafe(call)
        except RuntimeError:  # the loop is closed: this process is about to end
            pass

    async def call(self, client: Any, request: Any) -> Any:
        """The response to a request. A call that is cancelled is forgotten."""
        answer: "asyncio.Future[Any]" = self._loop.create_future()
        future = client.call_async(request)

        def settle() -> None:
            if not answer.done():
                error = future.exception()
                answer.set_result(future.result()) if error is None else answer.set_exception(error)

        future.add_done_callback(lambda _: self.on_loop(settle))
        try:
            return await answer
        finally:
            if not future.done():
                client.remove_pending_request(future)


class Service:
    def __init__(self, links: Links, name: str, class_: Any) -> None:
        self._links = links
        self._client: Any = links.caller.create_client(class_, name)

    def is_there(self) -> bool:
        there: bool = self._client.service_is_ready()
        return there

    async def call(self, message: Any) -> Any:
        return await self._links.call(self._client, message)


class Action:
    def __init__(self, links: Links, name: str, class_: Any) -> None:
        self._links, self._name, self._class = links, name, class_
        create = links.caller.create_client
        self._goal: Any = create(class_.Impl.SendGoalService, f"{name}/_action/send_goal")
        self._result: Any = create(class_.Impl.GetResultService, f"{name}/_action/get_result")
        self._cancel: Any = create(CancelGoal, f"{name}/_action/cancel_goal")
        self._status_topic = f"{name}/_action/status"
        self._take_status = links.subscribe(self._status_topic, GoalStatusArray, _STATUS)
        self._take_feedback = links.subscribe(f"{name}/_action/feedback", class_.Impl.FeedbackMessage, _FEEDBACK)
        self._statuses: Dict[uuid.UUID, int] = {}
        self._reporter: Any = None

    def is_there(self) -> bool:
        return all(client.service_is_ready() for client in (self._goal, self._result, self._cancel))

    def servers(self) -> FrozenSet[Any]:
        publishers = self._links.listener.get_publishers_info_by_topic(self._status_topic)
        return frozenset(bytes(publisher.endpoint_gid) for publisher in publishers)

    def statuses(self) -> Mapping[uuid.UUID, int]:
        taken = self._take_status()
        if taken is not None:
            message, origin = taken
            self._statuses = {_uuid(each.goal_info.goal_id): each.status for each in message.status_list}
            gid = origin.get("publisher_gid") if isinstance(origin, Mapping) else None
            self._reporter = None if gid is None else bytes(gid["data"])
        if self._statuses and not self._is_reporter_there():
            self._statuses = {}
        return self._statuses

    def _is_reporter_there(self) -> bool:
        """Whether the server that reported the statuses is still there. Older versions of ROS do not name it."""
        servers = self.servers()
        return self._reporter in servers if self._reporter is not None else bool(servers)

    def feedback(self, goal: uuid.UUID) -> Any:
        latest = None
        while True:
            taken = self._take_feedback()
            if taken is None:
                return latest
            if _uuid(taken[0].goal_id) == goal:
                latest = taken[0].feedback

    async def send(self, goal: uuid.UUID, message: Any) -> bool:
        request = self._class.Impl.SendGoalService.Request()
        request.goal_id.uuid = list(goal.bytes)
        request.goal = message
        response = await self._links.call(self._goal, request)
        accepted: bool = response.accepted
        return accepted

    async def result(self, goal: uuid.UUID) -> Tuple[int, Any]:
        request = self._class.Impl.GetResultService.Request()
        request.goal_id.uuid = list(goal.bytes)
        response = await self._links.call(self._result, request)
        return response.status, response.result

    async def cancel(self, goal: uuid.UUID) -> int:
        request = CancelGoal.Request()
        request.goal_info.goal_id.uuid = list(goal.bytes)
        response = await self._links.call(self._cancel, request)
        code: int = response.return_code
        return code


def _uuid(message: Any) -> uuid.UUID:
    return uuid.UUID(bytes=bytes(bytearray(message.uuid)))
