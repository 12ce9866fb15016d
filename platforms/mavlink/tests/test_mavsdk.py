"""The adapter with a vehicle that nobody here wrote: MAVSDK's, in another process."""

import os
import random
import select
import socket
import subprocess
import sys
import threading
import time
import unittest

from tests.test_process import FLIGHT, FOLDER, Adapter, free_port


class Lossy:
    """Passes datagrams on between a vehicle, which sends to `port`, and an adapter, which listens on another port.
    Loses a share of them, by a seed."""

    def __init__(self, adapter_port, loss, seed):
        self.loss, self._random = loss, random.Random(seed)
        self._near, self._far = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        for end in (self._near, self._far):
            end.bind(("127.0.0.1", 0))
        self.port, self._adapter, self._vehicle = self._near.getsockname()[1], ("127.0.0.1", adapter_port), None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self):
        while not self._over.is_set():
            for end in select.select([self._near, self._far], [], [], 0.1)[0]:
                try:
                    data, where = end.recvfrom(65536)
                except OSError:
                    continue
                if end is self._near:
                    self._vehicle = where
                if self._random.random() < self.loss:
                    continue
                to = (self._far, self._adapter) if end is self._near else (self._near, self._vehicle)
                if to[1] is not None:
                    try:
                        to[0].sendto(data, to[1])
                    except OSError:
                        pass  # as if it were lost

    def close(self):
        self._over.set()
        self._thread.join()
        self._near.close()
        self._far.close()


def spawn_vehicle(case, port, *options):
    vehicle = subprocess.Popen(
        [sys.executable, "-B", os.path.join(FOLDER, "tests", "mavsdk_vehicle.py"), str(port), *options],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )

    def end():
        vehicle.kill()
        vehicle.wait(5)
        vehicle.stdin.close()

    case.addCleanup(end)
    return vehicle


def adapter_of(case, port, *options):
    adapter = Adapter("--udp", str(port), "--kind", "1=copter:px4", "--name", "1=foreign", *options)
    case.addCleanup(adapter.close)
    return adapter


class Mavsdk(unittest.TestCase):
    def setUp(self):
        self.port = free_port()
        self.vehicle = spawn_vehicle(self, self.port)
        self.adapter = adapter_of(self, self.port)
        self.adapter.greet()
        self.adapter.until_ready("foreign")

    def tell(self, letter):
        self.vehicle.stdin.write(letter)
        self.vehicle.stdin.flush()

    def start(self, request):
        self.adapter.order(kind="start", request=request, vehicle="foreign", plan=FLIGHT, timeout=20)

    def test_missions_one_after_another(self):
        for request in ("r1", "r2", "r3"):
            self.start(request)
            self.assertEqual(self.adapter.end_of(request), {"kind": "done", "request": request})

    def sent_by_another(self, letter, why):
        self.tell(b"S")
        self.start("r")
        self.adapter.until(lambda r: r["kind"] == "taken")
        self.tell(letter)
        end = self.adapter.end_of("r")
        self.assertEqual((end["kind"], end.get("why")), ("failed", why + ", set by its pilot or another station"))
        self.adapter.until(lambda r: r["kind"] == "vehicle" and r.get("unready") == why)

    def test_a_return_that_somebody_else_orders(self):
        self.sent_by_another(b"R", "returns home in mode RTL")

    def test_a_landing_that_somebody_else_orders(self):
        self.sent_by_another(b"L", "lands in mode LAND")

    def resumed(self, plan):
        """Another adapter, after the first was killed while the vehicle flew `plan`."""
        self.adapter.order(kind="start", request="r", vehicle="foreign", plan=plan, timeout=20)
        self.adapter.until(lambda r: r["kind"] == "taken")
        notes = [r["note"] for r in self.adapter.reports if r["kind"] == "note"]
        self.adapter.process.kill()
        adapter = adapter_of(self, self.port)
        adapter.order(kind="hello", protocol=1, dolphin="test", purpose="run", resumes=True)
        adapter.order(kind="resume", request="r", vehicle="foreign", plan=plan, timeout=20, notes=notes)
        return adapter

    def test_a_mission_relative_to_the_vehicle_is_resumed(self):
        """It goes north all the time: made again from where the vehicle is, it would be another one."""
        words = [["arm", True], ["takeOff", 20], *[["move", 50, 0]] * 30]
        items = [{"item": name, "arguments": arguments, "named": {}} for name, *arguments in words]
        plan = {"name": "north", "language": "mission", "body": {"items": items}}
        self.assertEqual(self.resumed(plan).end_of("r"), {"kind": "done", "request": "r"})


class OnABadLink(unittest.TestCase):
    """DOLPHIN_MAVSDK: how many missions."""

    def test_missions_of_20_items_with_a_third_lost(self):
        count = int(os.environ.get("DOLPHIN_MAVSDK", "1"))
        port = free_port()
        words = [["arm", True], ["takeOff", 20], *[["moveFromHome", 10 * n, 10] for n in range(19)]]
        items = [{"item": name, "arguments": arguments, "named": {}} for name, *arguments in words]
        plan = {"name": "long", "language": "mission", "body": {"items": items}}
        link = Lossy(port, 0.3, int(os.environ.get("DOLPHIN_SEED", "1")))
        self.addCleanup(link.close)
        spawn_vehicle(self, link.port)
        adapter = adapter_of(self, port)
        adapter.greet()
        adapter.until_ready("foreign")
        for number in range(count):
            with self.subTest(number=number):
                began = time.monotonic()
                request = f"r{number}"
                adapter.order(kind="start", request=request, vehicle="foreign", plan=plan, timeout=60)
                end = adapter.until(
                    lambda r: r.get("request") == request and r["kind"] in ("done", "failed", "stopped"), 600
                )
                self.assertEqual(end, {"kind": "done", "request": request})
                print(f"mission {number}: {time.monotonic() - began:.1f} s", flush=True)



if __name__ == "__main__":
    unittest.main()
