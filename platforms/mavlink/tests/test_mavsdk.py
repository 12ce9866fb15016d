"""The adapter with a vehicle that nobody here wrote: MAVSDK's, in another process."""

import os
import subprocess
import sys
import unittest

from tests.test_process import FLIGHT, FOLDER, Adapter, free_port


class Mavsdk(unittest.TestCase):
    def setUp(self):
        port = free_port()
        vehicle = subprocess.Popen(
            [sys.executable, "-B", os.path.join(FOLDER, "tests", "mavsdk_vehicle.py"), str(port)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

        def end():
            vehicle.kill()
            vehicle.wait(5)
            vehicle.stdin.close()

        self.addCleanup(end)
        self.vehicle = vehicle
        self.adapter = Adapter("--udp", str(port), "--kind", "1=copter:px4", "--name", "1=foreign")
        self.addCleanup(self.adapter.close)
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


if __name__ == "__main__":
    unittest.main()
