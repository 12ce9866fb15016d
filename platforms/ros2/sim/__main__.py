"""Robots of ROS 2 for tests, with faults to order:

    python -m sim [--robots N] [--began FILE] [--rate HZ] [NAMESPACE ...]

Each has an action server of rclpy for each behaviour below, of type test_msgs/action/Fibonacci: a goal lasts `order`
tenths of a second, its feedback is a list that grows, and the result is a list with one code. `--began` gets a line for
each goal that begins, ends or is cancelled: time, robot, action, goal, event. Ends when its input ends, or with
`--stay` when it is killed.
"""

from __future__ import annotations

import argparse
import functools
import math
import os
import sys
import threading
import time
import uuid
from typing import Any, Dict, List, Optional, Tuple

import rclpy
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci

TICK = 0.05
ACTIONS = {
    "work": "accepts, lasts, succeeds with code 0",
    "occupied": "succeeds with code 7",
    "reject": "rejects each goal",
    "abort": "aborts with code 9 in the middle",
    "mute": "never answers a goal",
    "slow": "accepts a goal after 2 s",
    "deaf": "rejects each cancellation",
    "lazy": "accepts a cancellation, and is at rest 2 s later",
}


class Time:
    """Waits of coroutines, by one timer of the process."""

    def __init__(self, node: Node, executor: SingleThreadedExecutor) -> None:
        self._executor = executor
        self._waits: List[Tuple[float, Future]] = []
        node.create_timer(TICK, self._tick)

    def sleep(self, seconds: float) -> Future:
        future = Future(executor=self._executor)
        self._waits.append((time.monotonic() + seconds, future))
        return future

    def _tick(self) -> None:
        now = time.monotonic()
        due = [future for at, future in self._waits if at <= now]
        self._waits = [wait for wait in self._waits if wait[0] > now]
        for future in due:
            future.set_result(None)


class Journal:
    def __init__(self, path: Optional[str]) -> None:
        self._file = None if path is None else os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)

    def write(self, *words: str) -> None:
        if self._file is not None:
            os.write(self._file, (" ".join((f"{time.time():.3f}", *words)) + "\n").encode())


class SimRobot:
    def __init__(self, node: Node, namespace: str, number: int, clock: Time, journal: Journal, rate: float) -> None:
        self.namespace, self.x, self.y = namespace, 10.0 * number, 0.0
        self.battery, self.running = 0.9, 0
        self._clock, self._journal = clock, journal
        self._odometry = node.create_publisher(Odometry, f"{namespace}/odom", 5)
        self._battery = node.create_publisher(BatteryState, f"{namespace}/battery_state", 5)
        self._load = node.create_publisher(Float64, f"{namespace}/load", 5)
        self._seconds = 1.0 / rate
        node.create_timer(self._seconds, self._publish)
        self._servers = [
            ActionServer(
                node, Fibonacci, f"{namespace}/{action}", functools.partial(self._run, action),
                callback_group=ReentrantCallbackGroup(),  # a server that waits must not keep the others waiting
                goal_callback=functools.partial(self._judge, action),
                cancel_callback=functools.partial(self._hear, action))
            for action in ACTIONS
        ]
        for name, fine in (("tare", True), ("jam", False)):
            node.create_service(
                Trigger, f"{namespace}/{name}", lambda _, response, fine=fine: self._reply(response, fine))

    def _publish(self) -> None:
        if self.running:
            self.x += 1.0 * self._seconds
            self.battery = max(0.05, self.battery - 1e-4)
        odometry = Odometry()
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = self.x, self.y
        odometry.twist.twist.linear.x = 1.0 if self.running else 0.0
        self._odometry.publish(odometry)
        self._battery.publish(BatteryState(percentage=self.battery, voltage=math.nan))
        self._load.publish(Float64(data=float(self.running)))

    def _reply(self, response: Any, fine: bool) -> Any:
        response.success, response.message = fine, "" if fine else "The gripper is jammed."
        return response

    async def _judge(self, action: str, goal: Any) -> GoalResponse:
        if action == "mute":
            await Future()
        if action == "slow":
            await self._clock.sleep(2.0)
        return GoalResponse.REJECT if action == "reject" else GoalResponse.ACCEPT

    def _hear(self, action: str, handle: Any) -> CancelResponse:
        return CancelResponse.REJECT if action == "deaf" else CancelResponse.ACCEPT

    async def _run(self, action: str, handle: Any) -> Fibonacci.Result:
        goal = str(uuid.UUID(bytes=bytes(bytearray(handle.goal_id.uuid))))
        self._journal.write(self.namespace, action, goal, "begins")
        self.running += 1
        try:
            event, code = await self._last(action, handle)
        finally:
            self.running -= 1
        self._journal.write(self.namespace, action, goal, event)
        return Fibonacci.Result(sequence=[code])

    async def _last(self, action: str, handle: Any) -> Tuple[str, int]:
        end = time.monotonic() + handle.request.order / 10
        half = time.monotonic() + handle.request.order / 20
        steps = 0
        while time.monotonic() < end:
            if handle.is_cancel_requested:
                if action == "lazy":
                    await self._clock.sleep(2.0)
                handle.canceled()
                return "is-cancelled", 0
            if action == "abort" and time.monotonic() > half:
                handle.abort()
                return "aborts", 9
            done = handle.request.order - round(10 * (end - time.monotonic()))
            if done > steps:
                steps = done
                handle.publish_feedback(Fibonacci.Feedback(sequence=list(range(min(steps, 100)))))
            await self._clock.sleep(TICK)
        handle.succeed()
        return "ends", 7 if action == "occupied" else 0


def main() -> None:
    parser = argparse.ArgumentParser(prog="sim", description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("namespaces", nargs="*", default=[], metavar="NAMESPACE")
    parser.add_argument("--robots", type=int, default=0, help="as many robots more: /robot1, /robot2 ...")
    parser.add_argument("--began", help="the file with events of goals")
    parser.add_argument("--rate", type=float, default=5.0, help="positions a second")
    parser.add_argument("--stay", action="store_true")
    options = parser.parse_args()
    rclpy.init()
    node, executor = Node("sim"), SingleThreadedExecutor()
    clock, journal = Time(node, executor), Journal(options.began)
    namespaces = [*options.namespaces, *(f"/robot{n + 1}" for n in range(options.robots))]
    robots: Dict[str, SimRobot] = {
        name: SimRobot(node, name, n, clock, journal, options.rate) for n, name in enumerate(namespaces)}
    executor.add_node(node)
    if not options.stay:
        threading.Thread(target=lambda: (sys.stdin.read(), os._exit(0)), daemon=True).start()
    print(f"{len(robots)} robots", flush=True)
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


if __name__ == "__main__":
    main()
