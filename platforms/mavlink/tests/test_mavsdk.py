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
        self.adapter = Adapter("--udp", str(port), "--kind", "1=copter:px4", "--name", "1=foreign")
        self.addCleanup(self.adapter.close)
        self.adapter.greet()
        self.adapter.until_ready("foreign")

    def start(self, request):
        self.adapter.order(kind="start", request=request, vehicle="foreign", plan=FLIGHT, timeout=20)

    def test_missions_one_after_another(self):
        for request in ("r1", "r2", "r3"):
            self.start(request)
            self.assertEqual(self.adapter.end_of(request), {"kind": "done", "request": request})


if __name__ == "__main__":
    unittest.main()
