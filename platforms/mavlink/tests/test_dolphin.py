"""Programs of Dolphin on vehicles that speak MAVLink, with the command itself: the environment variable DOLPHIN."""

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from tests.test_process import FOLDER, PATIENCE, free_port, free_ports

DOLPHIN = os.environ.get("DOLPHIN")
EXAMPLE = os.path.join(FOLDER, "example")
RENDEZVOUS = os.path.join(FOLDER, "..", "..", "examples", "rendezvous.dol")
PHOTOS = os.path.join(FOLDER, "..", "..", "examples", "photos.dol")
WAYPOINTS = (
    "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t41.184\t-8.707\t0\t1\n"
    "1\t0\t3\t16\t0\t0\t0\t0\t41.1842\t-8.7068\t80\t1\n"
    "2\t0\t3\t19\t{seconds}\t0\t60\t0\t41.1842\t-8.7068\t80\t1\n"
)
TWO_FLIGHTS = "v = pick { id 'x8-02'; timeout 20.seconds }\nexecute v: task('rv1') >> task('rv2')\nmessage 'Done!'\n"


@unittest.skipUnless(DOLPHIN, "DOLPHIN is not set")
class Programs(unittest.TestCase):
    def setUp(self):
        self.port = free_port()
        self.environment = dict(os.environ, DOLPHIN_MAVLINK=sys.executable, PYTHONPATH=FOLDER)
        self.began = os.path.join(tempfile.mkdtemp(), "began")

    def fly(self, *arguments):
        """Simulated vehicles, whose missions are listed in `began`."""
        options = ["--to", f"127.0.0.1:{self.port}", "--time", "10", "--began", self.began]
        self.spawn([sys.executable, "-B", "-m", "sim", *options, *arguments])

    def rendezvous_plane(self):
        self.adapter = (
            f"{os.path.join(FOLDER, 'dolphin-mavlink')} --udp {self.port} --name 1=x8-02 "
            f"--missions {os.path.join(EXAMPLE, 'missions')}"
        )
        self.fly("--place=41.184,-8.707", "--armed", "plane")

    def spawn(self, command, **more):
        process = subprocess.Popen(command, env=self.environment, stdin=subprocess.PIPE, **more)

        def end():
            process.kill()
            process.wait(5)
            process.stdin.close()

        self.addCleanup(end)
        return process

    def flights(self):
        """The number of items of each mission that was begun, in order."""
        with open(self.began, encoding="utf-8") as file:
            return [int(line) for line in file]

    def test_missions_of_the_program(self):
        """They arm, and only those with a camera take photos."""
        self.fly("--place=41.1850,-8.7062", "copter", "copter:px4")
        adapter = f"{os.path.join(FOLDER, 'dolphin-mavlink')} --udp {self.port} --payload mav-2=camera"
        run = subprocess.run(
            [DOLPHIN, "exec", PHOTOS, "--platform", adapter],
            env=self.environment, capture_output=True, text=True, timeout=300,
        )
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        for line in ("mav-2       ends survey", "mav-1       stops wait", "says: the field is photographed"):
            self.assertIn(line, run.stdout)
        self.assertEqual(len(self.flights()), 2)

    def test_what_a_mission_lacks_is_told_before_anything_moves(self):
        adapter = f"{os.path.join(FOLDER, 'dolphin-mavlink')} --udp {self.port}"
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "low.dol")
            with open(program, "w", encoding="utf-8") as file:
                file.write("v = pick { type 'UAV' }\nexecute v: mission { name 'low'; goPos Location.APDL }\n")
            run = subprocess.run(
                [DOLPHIN, "check", program, "--platform", adapter],
                env=self.environment, capture_output=True, text=True, timeout=300,
            )
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("low: mavlink: item 1, goPos: how high? Give altitude", run.stdout + run.stderr)

    def test_the_kit_of_situations(self):
        """All of them at night; else those that take no time."""
        self.fly("--place=41.184,-8.707", "--armed", "plane")
        quick = ["completion", "start-twice", "stop", "refusal", "killed", "resume-twice", "lost-notes"]
        only = [] if "DOLPHIN_KILLS" in os.environ else [f"--only={name}" for name in quick]
        with tempfile.TemporaryDirectory() as folder:
            for name, seconds in (("short", 0), ("long", 36000)):
                with open(os.path.join(folder, f"{name}.waypoints"), "w", encoding="utf-8") as file:
                    file.write(WAYPOINTS.format(seconds=seconds))
            adapter = f"{os.path.join(FOLDER, 'dolphin-mavlink')} --udp {self.port} --missions {folder}"
            run = subprocess.run(
                [DOLPHIN, "platform", "check", adapter, *only],
                env=self.environment, capture_output=True, text=True, timeout=600,
            )
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        number = len(only) or 22
        self.assertIn(f"{number} of {number} situations passed", run.stdout)

    def test_submarines_of_imc_and_a_plane_of_mavlink_in_one_program(self):
        self.rendezvous_plane()
        first = free_ports(15)
        ports = f"{first}-{first + 4}"
        fleet = os.path.join(EXAMPLE, "uuvs.fleet")
        imc = ["--imc", "--discovery-ports", ports, "--port", str(first + 10), "--announce", "1", "--contact", "1"]
        self.spawn([DOLPHIN, "sim", fleet, *imc, "--speed", "60", "--for", "600"], stdout=subprocess.DEVNULL)
        command = [DOLPHIN, "exec", RENDEZVOUS, "--imc-loopback", "--imc-discovery-ports", ports]
        command += ["--fleet", RENDEZVOUS.replace(".dol", ".fleet")]
        run = subprocess.run(
            [*command, "--platform", self.adapter], env=self.environment, capture_output=True, text=True, timeout=300
        )
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        ended = sorted(re.findall(r"(\S+) +ends ((?:survey|sk|rv)\d)", run.stdout), key=lambda e: e[1])
        self.assertEqual(
            [plan for _, plan in ended], ["rv1", "rv2", "rv3", "sk1", "sk2", "sk3", "survey1", "survey2", "survey3"]
        )
        self.assertEqual({vehicle for vehicle, plan in ended if plan.startswith("rv")}, {"x8-02"})
        self.assertIn("says: Done!", run.stdout)
        self.assertEqual(self.flights(), [2, 2, 2])

    def test_a_console_that_is_killed_and_resumed(self):
        """At DOLPHIN_KILLS moments of its run, far apart at first: each mission is flown once."""
        self.rendezvous_plane()
        for number in range(int(os.environ.get("DOLPHIN_KILLS", "2"))):
            with self.subTest(number=number), tempfile.TemporaryDirectory() as folder:
                program, journal = os.path.join(folder, "two.dol"), os.path.join(folder, "run")
                with open(program, "w", encoding="utf-8") as file:
                    file.write(TWO_FLIGHTS)
                before = len(self.flights()) if os.path.exists(self.began) else 0
                command = [DOLPHIN, "exec", program, "--platform", self.adapter]
                log = open(os.path.join(folder, "log"), "w+", encoding="utf-8")
                self.addCleanup(log.close)
                first = self.spawn([*command, "--journal", journal], stdout=log, start_new_session=True)
                wait_for(lambda: "starts rv1" in open(log.name, encoding="utf-8").read())
                time.sleep(0.1 * (number * 37 % 100))
                first.send_signal(signal.SIGKILL)
                first.wait(5)
                with open(journal, encoding="utf-8") as file:
                    if '"kind":"end"' in file.read():
                        continue
                resumed = subprocess.run(
                    [DOLPHIN, "exec", "--resume", journal, program, "--platform", self.adapter],
                    env=self.environment,
                    capture_output=True,
                    text=True,
                    timeout=300,
                )
                if resumed.returncode == 0:
                    self.assertIn("says: Done!", resumed.stdout)
                    self.assertEqual(len(self.flights()) - before, 2)
                else:
                    why = "does not fly the mission that it was to begin"
                    self.assertIn(why, resumed.stdout + resumed.stderr)


def wait_for(holds):
    end = time.monotonic() + PATIENCE
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"not within {PATIENCE} s")
        time.sleep(0.02)


if __name__ == "__main__":
    unittest.main()
