"""The adapter's figures, on loopback, with simulated robots in another process:

    .environment/bin/python bench.py [ROBOTS]

From the order to start to the report that the goal is accepted, through the adapter (with the note on the disk of a
console left out), and from the request to the reply of a plain client of rclpy: median, nine in ten, longest of 200
goals, first one, then the other, in turns of 50. Then the share of a core that the adapter of 50 robots takes for 30 s:
idle, each of which publishes position, battery and a reading five times a second. The load of the machine is printed.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time

FOLDER = os.path.dirname(os.path.abspath(__file__))
DOMAIN = 1 + os.getpid() % 100
ENVIRONMENT = dict(
    os.environ, ROS_DOMAIN_ID=str(DOMAIN), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", DOLPHIN_ROS2=sys.executable,
    PYTHONPATH=FOLDER)
KIND = """\
kinds:
  carrier:
    type: UGV
    position: {topic: odom, type: nav_msgs/msg/Odometry}
    battery: {topic: battery_state}
    readings: {Load: {topic: load, type: std_msgs/msg/Float64, field: data}}
    plans:
      nothing: {action: work, type: test_msgs/action/Fibonacci, goal: {order: 0}}
origin: {latitude: 41.185, longitude: -8.706}
"""


class Adapter:
    """The adapter's process, and a console that keeps notes at once."""

    def __init__(self, robots):
        self.file = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        names = "".join(f"  robot-{n}: {{kind: carrier, namespace: /robot{n}}}\n" for n in range(1, robots + 1))
        self.file.write(f"domain: {DOMAIN}\n{KIND}robots:\n{names}")
        self.file.flush()
        self.process = subprocess.Popen(
            [os.path.join(FOLDER, "dolphin-ros2"), "--config", self.file.name], env=ENVIRONMENT,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.order(kind="hello", protocol=1, dolphin="bench", purpose="run", resumes=False)
        self.order(kind="telemetry", on=True)

    def order(self, **order):
        self.process.stdin.write(json.dumps(order).encode() + b"\n")
        self.process.stdin.flush()

    def until(self, holds):
        while True:
            report = json.loads(self.process.stdout.readline())
            if report["kind"] == "note":
                self.order(kind="kept", id=report["id"])
            if holds(report):
                return report

    def until_all_have_a_link(self, robots):
        there = set()

        def holds(report):
            if report.get("link"):
                there.add(report["vehicle"])
            return len(there) == robots

        self.until(holds)

    def measure(self, request):
        began = time.perf_counter()
        self.order(
            kind="start", request=request, vehicle="robot-1", plan={"name": "nothing"}, timeout=30)
        first = self.until(lambda report: report.get("request") == request and report["kind"] in ("taken", "failed"))
        assert first["kind"] == "taken", first
        taken = 1000 * (time.perf_counter() - began)
        end = self.until(lambda report: report.get("request") == request and report["kind"] in ("done", "failed"))
        assert end["kind"] == "done", end
        return taken

    def share(self, seconds):
        """The share of a core that the process takes, its threads included."""
        def used():
            with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as file:
                fields = file.read().rpartition(")")[2].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

        threading.Thread(target=self.process.stdout.read, daemon=True).start()
        time.sleep(5)
        before, began = used(), time.monotonic()
        time.sleep(seconds)
        return (used() - before) / (time.monotonic() - began)

    def close(self):
        self.process.kill()
        self.process.wait(5)


class Plain:
    """A plain client of rclpy, as its tutorials have it."""

    def __init__(self):
        import rclpy
        from rclpy.action import ActionClient
        from rclpy.executors import SingleThreadedExecutor
        from test_msgs.action import Fibonacci

        rclpy.init(domain_id=DOMAIN)
        node = rclpy.create_node("plain")
        self.goal, self.client = Fibonacci.Goal(order=0), ActionClient(node, Fibonacci, "/robot1/work")
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        threading.Thread(target=executor.spin, daemon=True).start()
        self.client.wait_for_server()

    def wait(self, future):
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        done.wait()
        return future.result()

    def measure(self):
        began = time.perf_counter()
        handle = self.wait(self.client.send_goal_async(self.goal))
        taken = 1000 * (time.perf_counter() - began)
        self.wait(handle.get_result_async())
        return taken


def show(name, times):
    times.sort()
    ninety = times[len(times) * 9 // 10]
    print(f"{name:14} median {statistics.median(times):.1f} ms, 90 % {ninety:.1f} ms, longest {times[-1]:.1f} ms")


def simulate(robots):
    process = subprocess.Popen(
        [sys.executable, "-B", "-m", "sim", "--stay", "--robots", str(robots)], env=ENVIRONMENT, cwd=FOLDER,
        stdout=subprocess.PIPE, stdin=subprocess.DEVNULL)
    process.stdout.readline()
    return process


def main(robots):
    os.environ.update(ENVIRONMENT)
    print(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    sim, adapter = simulate(1), Adapter(1)
    try:
        adapter.until_all_have_a_link(1)
        plain, through, beside = Plain(), [], []
        for turn in range(4):
            through += [adapter.measure(f"r-{turn}-{number}") for number in range(50)]
            beside += [plain.measure() for _ in range(50)]
            time.sleep(1)  # until the robot is ready again: it ran goals of another client
    finally:
        adapter.close()
        sim.kill()
        sim.wait(5)
    show("adapter", through)
    show("plain client", beside)
    sim, adapter = simulate(robots), Adapter(robots)
    try:
        adapter.until_all_have_a_link(robots)
        print(f"{robots} robots: {100 * adapter.share(30):.0f} % of a core")
    finally:
        adapter.close()
        sim.kill()
        sim.wait(5)
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 50)
