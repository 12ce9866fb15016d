"""The adapter as a process: on UDP, TCP and a serial line, with simulated vehicles. On loopback, bounded in time."""

import fcntl
import json
import os
import pty
import select
import socket
import subprocess
import sys
import tempfile
import threading
import time
import tty
import unittest

from dolphin_mavlink.wire import Wire
from sim.vehicle import SimVehicle
from tests.support import HARBOUR

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HOME = {"latitude": HARBOUR[0], "longitude": HARBOUR[1], "height": 0}
FLIGHT = {
    "name": "flight",
    "language": "mission",
    "body": {
        "items": [
            {"item": "arm", "arguments": [True], "named": {}},
            {"item": "takeOff", "arguments": [20], "named": {}},
            {"item": "move", "arguments": [50, 20], "named": {}},
            {"item": "move", "arguments": [50, 20], "named": {}},
            {"item": "returnHome", "arguments": [], "named": {}},
        ]
    },
}


_LEASES = []  # locks of files, as long as this process lives


def free_ports(count=1):
    """The first of `count` free ports in a row. Other tests that run beside this one take others, and they are below
    those that systems give to sockets without a port: they stay free until they are bound.
    Every run of tests on the machine looks there, whatever its folder for temporary files."""
    folder = "/tmp/dolphin-test-ports"
    os.makedirs(folder, exist_ok=True)
    for first in range(11000, 19900, 20):
        lease = open(os.path.join(folder, str(first)), "a", encoding="utf-8")
        try:
            fcntl.flock(lease, fcntl.LOCK_EX | fcntl.LOCK_NB)
            for port in range(first, first + count):
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
                    s.bind(("", port))
        except OSError:
            lease.close()
            continue
        _LEASES.append(lease)
        return first
    raise AssertionError("there are no free ports")


def free_port():
    return free_ports()


PATIENCE = 120  # seconds; machines that run tests are busy


class Adapter:
    """An adapter as Dolphin has it: lines out, lines in."""

    def __init__(self, *options):
        environment = dict(os.environ, DOLPHIN_MAVLINK=sys.executable, DOLPHIN_PLATFORM_PROTOCOL="1")
        self.process = subprocess.Popen(
            [os.path.join(FOLDER, "dolphin-mavlink"), *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        self.reports, self._rest = [], b""

    def greet(self):
        self.order(kind="hello", protocol=1, dolphin="test", purpose="run", resumes=False)

    def order(self, **line):
        self.process.stdin.write(json.dumps(line).encode() + b"\n")
        self.process.stdin.flush()

    def until(self, holds, seconds=PATIENCE):
        """Reads reports until one of them `holds`; that one."""
        end = time.monotonic() + seconds
        while True:
            for report in self.reports:
                if holds(report):
                    return report
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.process.stdout], [], [], left)[0]:
                raise AssertionError(f"not within {seconds} s: {self.reports[-5:]}")
            data = os.read(self.process.stdout.fileno(), 65536)
            if not data:
                raise AssertionError(f"the adapter has ended: {self.reports[-5:]}")
            *lines, self._rest = (self._rest + data).split(b"\n")
            for report in map(json.loads, lines):
                self.reports.append(report)
                if "id" in report and report["kind"] == "note":
                    self.order(kind="kept", id=report["id"])

    def until_ready(self, name="mav-1"):
        self.until(lambda r: r["kind"] == "vehicle" and r["vehicle"] == name and "latitude" in r)

    def end_of(self, request):
        return self.until(lambda r: r.get("request") == request and r["kind"] in ("done", "failed", "stopped"))

    def close(self):
        self.process.kill()
        self.process.wait(5)
        self.process.stdin.close()
        self.process.stdout.close()


def fly_on_stream(read, write, stop):
    """A vehicle at the other end of a stream, 20 times as fast."""
    vehicle, wire, rest = SimVehicle(1, "copter", speed=200.0), Wire(1, 1), b""
    begin = time.monotonic()
    while not stop.is_set():
        messages = []
        if select.select([read], [], [], 0.02)[0]:
            try:
                heard, rest = wire.decode(rest + os.read(read, 4096))
            except OSError:
                return
            for message in heard:
                messages += vehicle.hear(time.monotonic() - begin, message)
        messages += vehicle.tick(time.monotonic() - begin)
        try:
            for message in messages:
                os.write(write, wire.encode(message))
        except OSError:
            return


class Processes(unittest.TestCase):
    def adapter(self, *options):
        adapter = Adapter(*options)
        self.addCleanup(adapter.close)
        return adapter

    def vehicles(self, port, *kinds):
        environment = dict(os.environ, PYTHONPATH=FOLDER)
        process = subprocess.Popen(
            [sys.executable, "-B", "-m", "sim", "--to", f"127.0.0.1:{port}", "--time", "20", *kinds],
            stdin=subprocess.PIPE,
            env=environment,
        )

        def end():
            process.kill()
            process.wait(5)
            process.stdin.close()

        self.addCleanup(end)

    def flies(self, adapter, vehicle="mav-1"):
        adapter.greet()
        adapter.until_ready(vehicle)
        adapter.order(kind="start", request="r", vehicle=vehicle, plan=FLIGHT, timeout=30)
        self.assertEqual(adapter.end_of("r"), {"kind": "done", "request": "r"})
        adapter.order(kind="close")
        adapter.until(lambda r: r["kind"] == "quiet")
        self.assertEqual(adapter.process.wait(PATIENCE), 0)

    def test_udp(self):
        port = free_port()
        self.vehicles(port, "copter", "plane:px4")
        self.flies(self.adapter("--udp", str(port)), "mav-2")

    def test_signed(self):
        port = free_port()
        self.vehicles(port, "copter", "--key", "dolphins")
        with tempfile.NamedTemporaryFile("w") as key:
            key.write("dolphins\n")
            key.flush()
            self.flies(self.adapter("--udp", str(port), "--key-file", key.name))

    def stream(self, read, write):
        stop = threading.Event()
        thread = threading.Thread(target=fly_on_stream, args=(read, write, stop))
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(stop.set)

    def test_tcp(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            adapter = self.adapter("--tcp", f"127.0.0.1:{server.getsockname()[1]}")
            server.settimeout(PATIENCE)
            connection, _ = server.accept()
        self.addCleanup(connection.close)
        self.stream(connection.fileno(), connection.fileno())
        self.flies(adapter)

    def test_serial(self):
        master, slave = pty.openpty()
        tty.setraw(slave)
        self.addCleanup(os.close, master)
        self.addCleanup(os.close, slave)
        self.stream(master, master)
        self.flies(self.adapter("--serial", os.ttyname(slave) + ",115200"))

    def test_a_stop_and_the_end_of_dolphin(self):
        port = free_port()
        self.vehicles(port, "copter")
        adapter = self.adapter("--udp", str(port))
        adapter.greet()
        adapter.until_ready()
        adapter.order(kind="start", request="r", vehicle="mav-1", plan=FLIGHT, timeout=30)
        adapter.until(lambda r: r["kind"] == "taken")
        adapter.order(kind="stop", request="r", vehicle="mav-1")
        self.assertEqual(adapter.end_of("r")["kind"], "stopped")
        adapter.process.stdin.close()
        self.assertEqual(adapter.process.wait(PATIENCE), 0)

    def test_what_cannot_begin_says_why(self):
        taken = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(taken.close)
        taken.bind(("", 0))
        port = taken.getsockname()[1]
        for options, why in (
            (["--udp", str(port)], f"UDP port {port}: address already in use"),
            (["--serial", "/dev/nowhere"], "serial port /dev/nowhere: no such file or directory"),
            (["--missions", "/nowhere"], "missions in /nowhere: no such file or directory"),
            (["--tcp", "nonsense"], "TCP nonsense: it is HOST:PORT, as in 192.168.1.20:5760"),
            (["--name", "x"], "--name x: it is NUMBER=..."),
        ):
            adapter = self.adapter(*options)
            report = adapter.until(lambda r: r["kind"] == "error")
            self.assertEqual(report["why"], why)
            self.assertEqual(adapter.process.wait(PATIENCE), 1)

    def test_orders_that_are_no_json(self):
        adapter = self.adapter("--udp", str(free_port()))
        adapter.process.stdin.write(b"nonsense\n\xff\xfe\n" + b"[" * 100000 + b"\n" + b"x" * (3 << 20) + b"\n")
        adapter.greet()
        adapter.order(kind="ping", id=3)
        adapter.until(lambda r: r == {"kind": "pong", "id": 3})


if __name__ == "__main__":
    unittest.main()
