"""The adapter with a vehicle that is not ours: MAVSDK's, in another process."""

import heapq
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
    Loses a share of them, by a seed, and all while it is `down`; passes them on after `delay` seconds."""

    def __init__(self, adapter_port, loss=0.0, seed=1, delay=0.0):
        self.loss, self.delay, self.down, self._random = loss, delay, False, random.Random(seed)
        self.uploaded = 0  # datagrams to the vehicle
        self._number, self._late = 0, []  # when each is due, its number, where it goes, and itself
        self._near, self._far = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        for end in (self._near, self._far):
            end.bind(("127.0.0.1", 0))
        self.port, self._adapter, self._vehicle = self._near.getsockname()[1], ("127.0.0.1", adapter_port), None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self):
        while not self._over.is_set():
            wait = 0.1 if not self._late else max(0.0, min(0.1, self._late[0][0] - time.monotonic()))
            for end in select.select([self._near, self._far], [], [], wait)[0]:
                try:
                    data, where = end.recvfrom(65536)
                except OSError:
                    continue
                if end is self._near:
                    self._vehicle = where
                self.uploaded += end is self._far
                if self.down or self._random.random() < self.loss:
                    continue
                to = (self._far, self._adapter) if end is self._near else (self._near, self._vehicle)
                if to[1] is not None:
                    self._number += 1
                    heapq.heappush(self._late, (time.monotonic() + self.delay, self._number, to, data))
            while self._late and self._late[0][0] <= time.monotonic():
                _, _, (end, where), data = heapq.heappop(self._late)
                try:
                    end.sendto(data, where)
                except OSError:
                    pass  # as if it were lost

    def close(self):
        self._over.set()
        self._thread.join()
        self._near.close()
        self._far.close()


MISSIONS = int(os.environ.get("DOLPHIN_MAVSDK", "1"))


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


def items_of(*words):
    items = [{"item": name, "arguments": list(arguments), "named": {}} for name, *arguments in words]
    return {"name": "way", "language": "mission", "body": {"items": items}}


LONG = items_of(("arm", True), ("takeOff", 20), *(("moveFromHome", 10 * n, 10) for n in range(19)))


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

    def test_a_return_that_another_station_orders(self):
        self.sent_by_another(b"R", "returns home in mode RTL")

    def test_a_landing_that_another_station_orders(self):
        self.sent_by_another(b"L", "lands in mode LAND")

    def test_a_hold_that_another_station_orders(self):
        """PX4 goes into this mode also when a mission is over."""
        self.tell(b"S")
        self.start("r")
        self.adapter.until(lambda r: r["kind"] == "taken")
        time.sleep(3)  # until heartbeats have shown the mode of missions
        self.tell(b"H")
        end = self.adapter.end_of("r")
        self.assertEqual((end["kind"], end.get("why")), ("failed", "taken over by its pilot in mode HOLD"))

    def test_a_stop_that_the_vehicle_refuses(self):
        """MAVSDK's vehicle lets no ground station set HOLD. As long as it flies its mission, it is not stopped."""
        self.tell(b"S")
        self.start("r")
        self.adapter.until(lambda r: r["kind"] == "taken")
        self.adapter.order(kind="stop", request="r")
        with self.assertRaisesRegex(AssertionError, "not within 4 s"):
            self.adapter.until(lambda r: r.get("request") == "r" and r["kind"] in ("stopped", "failed", "done"), 4)
        self.tell(b"F")
        self.assertEqual(self.adapter.end_of("r")["kind"], "stopped")

    def test_the_end_of_dolphin_while_a_stop_is_refused(self):
        """As after Ctrl-C: the adapter ends, and does not call the mission stopped."""
        self.tell(b"S")
        self.start("r")
        self.adapter.until(lambda r: r["kind"] == "taken")
        began = time.monotonic()
        self.adapter.order(kind="close")
        self.adapter.until(lambda r: r["kind"] == "quiet")
        self.assertGreater(time.monotonic() - began, 4)
        self.assertEqual(self.adapter.process.wait(20), 0)
        self.assertEqual([r for r in self.adapter.reports if r["kind"] in ("stopped", "failed", "done")], [])

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
        """It goes north all the time: made again from the vehicle's position, it would be another one."""
        plan = items_of(("arm", True), ("takeOff", 20), *[("move", 50, 0)] * 30)
        self.assertEqual(self.resumed(plan).end_of("r"), {"kind": "done", "request": "r"})


class OnABadLink(unittest.TestCase):
    """DOLPHIN_MAVSDK is the number of missions; with more than one, more links are tried."""

    def test_missions_of_20_items_with_a_third_lost(self):
        port = free_port()
        link = Lossy(port, 0.3, int(os.environ.get("DOLPHIN_SEED", "1")))
        self.addCleanup(link.close)
        spawn_vehicle(self, link.port)
        adapter = adapter_of(self, port)
        adapter.greet()
        adapter.until_ready("foreign")
        for number in range(MISSIONS):
            with self.subTest(number=number):
                began = time.monotonic()
                request = f"r{number}"
                adapter.order(kind="start", request=request, vehicle="foreign", plan=LONG, timeout=60)
                end = adapter.until(
                    lambda r: r.get("request") == request and r["kind"] in ("done", "failed", "stopped"), 600
                )
                self.assertEqual(end, {"kind": "done", "request": request})
                print(f"mission {number}: {time.monotonic() - began:.1f} s", flush=True)

    def flown(self, link, port, act=lambda adapter: None):
        """Flies LONG over the link, and returns its end."""
        self.addCleanup(link.close)
        spawn_vehicle(self, link.port)
        adapter = adapter_of(self, port)
        adapter.greet()
        adapter.until_ready("foreign")
        adapter.order(kind="start", request="r", vehicle="foreign", plan=LONG, timeout=60)
        act(adapter)
        return adapter.until(lambda r: r.get("request") == "r" and r["kind"] in ("done", "failed", "stopped"), 300)

    def test_slow_links(self):
        for delay, loss in ((0.3, 0.1),) if MISSIONS == 1 else ((0.3, 0.0), (0.3, 0.1), (1.0, 0.0)):
            with self.subTest(delay=delay, loss=loss):
                port = free_port()
                end = self.flown(Lossy(port, loss=loss, delay=delay), port)
                self.assertEqual(end, {"kind": "done", "request": "r"})

    def test_a_link_that_is_away_during_the_upload(self):
        for away in (8.0,) if MISSIONS == 1 else (2.0, 8.0, 20.0):
            with self.subTest(away=away):
                port = free_port()
                link = Lossy(port, delay=0.05)

                def vanish(_):
                    sent = link.uploaded
                    end = time.monotonic() + 20
                    while link.uploaded < sent + 6 and time.monotonic() < end:
                        time.sleep(0.01)
                    link.down = True
                    time.sleep(away)
                    link.down = False

                self.assertEqual(self.flown(link, port, vanish), {"kind": "done", "request": "r"})


class Two(unittest.TestCase):
    def test_two_vehicles_at_once(self):
        """A hand on one of them does not touch the other."""
        port = free_port()
        vehicles = [spawn_vehicle(self, port, str(system)) for system in (1, 2)]
        adapter = adapter_of(self, port, "--kind", "2=copter:px4", "--name", "2=other")
        adapter.greet()
        for name in ("foreign", "other"):
            adapter.until_ready(name)
        for vehicle in vehicles:
            vehicle.stdin.write(b"S")
            vehicle.stdin.flush()
        for name in ("foreign", "other"):
            adapter.order(kind="start", request=name, vehicle=name, plan=FLIGHT, timeout=20)
        for name in ("foreign", "other"):
            adapter.until(lambda r: r["kind"] == "taken" and r["request"] == name)
        vehicles[1].stdin.write(b"R")
        vehicles[1].stdin.flush()
        end = adapter.end_of("other")
        self.assertEqual(end.get("why"), "returns home in mode RTL, set by its pilot or another station")
        self.assertEqual(adapter.end_of("foreign"), {"kind": "done", "request": "foreign"})


if __name__ == "__main__":
    unittest.main()
