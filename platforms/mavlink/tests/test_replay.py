"""Conclusions of `dolphin-mavlink replay` from recorded flights."""

import os
import random
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from pymavlink import mavutil

from dolphin_mavlink import replay, tlog
from dolphin_mavlink.station import Options
from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, waypoint, way
from tests.test_endings import LANDINGS, at_its_landing
from tests.test_mavsdk import spawn_vehicle
from tests.test_process import FOLDER, free_port

BEGIN = 1_764_000_000.0


def file_of(log):
    return b"".join(struct.pack(">Q", round((BEGIN + at) * 1e6)) + bytes(frame) for at, frame in log)


def concluded(data, **options):
    """The conclusions about vehicles, as (vehicle, text)."""
    played = replay.Replay(Options(picks=False, **options))
    records, _ = tlog.read(data)
    for at, frame in records:
        played.hear(at - records[0][0], frame)
    played.finish()
    return [(vehicle, text) for _, vehicle, text in played.lines]


def verdicts(lines):
    return [text for _, text in lines if text.startswith(("mission done", "mission failed", "mission unknown"))]


class Conclusions(Case):
    def flown(self, kind="copter", px4=False, items=None, act=None, **more):
        """A recorded flight: its log, and how the adapter that ordered it judged it."""
        vehicle, wires = one(kind, px4, items=items or way(12), **more)
        wires.log = []
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(120, lambda: wires.said("taken")))
        if act is not None:
            act(vehicle, wires)
        end = wires.run_to_end("r")
        wires.run(12)
        text = "mission done" if end["kind"] == "done" else f"mission failed: {end['why']}"
        return file_of(wires.log), text

    def pilot(self, mode):
        def act(vehicle, wires):
            wires.run(6)
            wires.say(vehicle, vehicle.pilot(wires.now, mode))

        return act

    def test_it_concludes_what_the_adapter_concluded(self):
        def failsafe(vehicle, wires):
            wires.run(6)
            wires.say(vehicle, vehicle.failsafe(wires.now, "Battery 1 is low 10.4V used 1200 mAh", "RTL"))

        def breach(vehicle, wires):
            wires.run(6)
            wires.say(vehicle, vehicle.breach(wires.now, "RTL", text="Fence Breached"))

        def kill(vehicle, wires):
            wires.run(8)
            wires.say(vehicle, vehicle.kill(wires.now))

        def kill_low(vehicle, wires):
            wires.run(200, at_its_landing(vehicle, 8.0))
            wires.say(vehicle, vehicle.kill(wires.now))

        def away(vehicle, wires):
            wires.run(3)
            wires.down = True
            wires.run(20)
            wires.down = False

        def restart(vehicle, wires):
            wires.run(6)
            vehicle.restart(wires.now)

        landing = (*way(4), LANDINGS["a landing"])
        flights = [
            ("copter", False, None, None),
            ("plane", False, None, None),
            ("rover", False, None, None),
            ("copter", True, None, None),
            ("copter", False, landing, None),
            ("copter", True, landing, None),
            ("copter", False, (*way(3), waypoint(200, 0, command=17)), None),
            ("copter", False, (*way(2), waypoint(0, 0, command=177, params=(1.0, 2.0, 0.0, 0.0))), None),
            ("copter", True, (*way(2), waypoint(0, 0, command=177, params=(1.0, 2.0, 0.0, 0.0))), None),
            ("copter", False, None, self.pilot("LOITER")),
            ("copter", True, None, self.pilot("POSCTL")),
            ("copter", True, None, self.pilot("HOLD")),
            ("plane", False, None, self.pilot("RTL")),
            ("copter", False, None, failsafe),
            ("copter", False, None, breach),
            ("copter", False, None, kill),
            ("copter", False, None, restart),
            ("copter", False, landing, kill_low),
            ("copter", False, landing, away),
            ("rover", False, None, away),
        ]
        for kind, px4, items, act in flights:
            for loss in (0.0, 0.2):
                for seed in seeds(2):
                    with self.subTest(kind=kind, px4=px4, act=act and act.__name__, loss=loss, seed=seed):
                        data, text = self.flown(kind, px4, items, act, seed=seed, loss=loss, delay=0.05)
                        self.assertEqual(verdicts(concluded(data)), [text])

    def test_the_lines_of_a_flight(self):
        data, _ = self.flown(items=(*way(3), LANDINGS["a landing"]))
        lines = [text for vehicle, text in concluded(data, names={1: "x8"}) if vehicle == "x8"]
        self.assertEqual(lines[0], "copter of ArduPilot")
        for text in (
            "disarmed, in mode STABILIZE",
            "armed, in mode AUTO",
            "begins its mission of 4 items",
            "mission at 25 %",
            "disarmed, in mode AUTO",
            "mission done",
        ):
            self.assertIn(text, lines)
        self.assertEqual([text for text in lines if "plan" in text], [])

    def test_a_link_that_is_lost(self):
        def away(vehicle, wires):
            wires.run(3)
            wires.down = True
            wires.run(20)
            wires.down = False

        lines = [text for _, text in concluded(self.flown(act=away)[0])]
        lost = lines.index("no heartbeat for 5 s: the link counts as lost")
        self.assertIn("is heard again", lines[lost:])

    def test_a_log_that_ends_in_the_air(self):
        data, _ = self.flown()
        records, _ = tlog.read(data)
        lines = concluded(file_of([(at - BEGIN, frame) for at, frame in records if at - records[0][0] < 12]))
        self.assertEqual(verdicts(lines), [])
        self.assertEqual(lines[-1][1], "the log ends before its mission does")

    def test_a_log_without_the_mission(self):
        data, _ = self.flown()
        transfers = {"MISSION_ITEM_INT", "MISSION_COUNT"}
        wire = replay.Wire(255, 190)
        records, _ = tlog.read(data)
        kept = [(a - BEGIN, f) for a, f in records if wire.decode_datagram(f)[0].get_type() not in transfers]
        lines = [text for _, text in concluded(file_of(kept))]
        self.assertIn("flies a mission that the log does not have: give it by --mission", lines)

    def test_missions_of_two_vehicles_and_one_after_another(self):
        vehicle, wires = one(items=way(4))
        wires.log = []
        for n in range(3):
            wires.start(f"r{n}", "mav-1", stored())
            self.ends(wires, f"r{n}", "done")
        self.assertEqual(verdicts(concluded(file_of(wires.log))), ["mission done"] * 3)


class Files(unittest.TestCase):
    def setUp(self):
        vehicle, wires = one(items=way(4))
        wires.log = []
        wires.start("r", "mav-1", stored())
        wires.run_to_end("r")
        wires.run(5)
        self.data = file_of(wires.log)

    def test_pymavlink_reads_the_same_messages(self):
        with tempfile.NamedTemporaryFile(suffix=".tlog") as file:
            file.write(self.data)
            file.flush()
            log, read = mavutil.mavlink_connection(file.name), 0
            while log.recv_msg() is not None:
                read += 1
            log.close()
        records, left_out = tlog.read(self.data)
        self.assertEqual((len(records), left_out), (read, 0))

    def test_damaged_logs(self):
        """Bytes that are changed, left out or added cost messages, and nothing else."""
        for seed in seeds(60):
            draw, data = random.Random(seed), bytearray(self.data)
            for _ in range(draw.randrange(1, 30)):
                at, what = draw.randrange(len(data)), draw.randrange(4)
                if what == 0:
                    data[at] = draw.randrange(256)
                elif what == 1:
                    del data[at : at + draw.randrange(60)]
                elif what == 2:
                    data[at:at] = draw.randbytes(draw.randrange(60))
                else:
                    del data[max(at, len(self.data) // 2) :]  # the first half remains: it is still a log
            with self.subTest(seed=seed):
                concluded(bytes(data))

    def test_times_that_jump(self):
        """A gap of a day is passed over at once, and time does not go back."""
        records, _ = tlog.read(self.data)
        half = len(records) // 2
        later = [(at - BEGIN + 86400 * 30, f) for at, f in records[half:]]
        data = file_of([(at - BEGIN, f) for at, f in records[:half]] + later)
        began = time.monotonic()
        concluded(data)
        concluded(file_of([(at - BEGIN, f) for at, f in reversed(records)]))
        self.assertLess(time.monotonic() - began, 60)

    def test_what_is_no_telemetry_log(self):
        for data in (b"", b"QGC WPL 110\n" * 50, self.data[8:20], bytes(1000)):
            with self.assertRaises(tlog.Unreadable):
                tlog.read(data)


class Command(unittest.TestCase):
    def run_it(self, *arguments):
        return subprocess.run(
            [os.path.join(FOLDER, "dolphin-mavlink"), "replay", *arguments],
            env=dict(os.environ, DOLPHIN_MAVLINK=sys.executable),
            capture_output=True,
            text=True,
            timeout=120,
        )

    def test_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.tlog")
            with open(path, "w", encoding="utf-8") as file:
                file.write("no log\n")
            result = self.run_it(path)
            self.assertEqual(result.returncode, 1)
            self.assertIn("a.tlog: not a telemetry log: no time stamp before a MAVLink frame was found", result.stderr)
            self.assertEqual(self.run_it(os.path.join(folder, "none")).returncode, 1)
            self.assertIn("it is one of copter,", self.run_it("--kind", "1=ship:px4", path).stderr)
            self.assertEqual(self.run_it("--help").returncode, 0)

    def station(self, port, path, items):
        """A ground station that pymavlink is, and records: it uploads, downloads and begins a mission."""
        link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255, dialect="common")
        file = open(path, "wb", buffering=0)
        self.addCleanup(file.close)
        self.addCleanup(link.close)
        # As MAVProxy does it. pymavlink's own setup_logfile records no UDP.
        link.message_hooks.append(lambda _, m: file.write(struct.pack(">Q", int(time.time() * 1e6)) + m.get_msgbuf()))
        end = time.monotonic() + 120

        def until(kind, holds=lambda m: True, ask=lambda: None):
            while time.monotonic() < end:
                ask()
                message = link.recv_match(type=kind, blocking=True, timeout=1)
                if message is not None and holds(message):
                    return message
            raise AssertionError(f"no {kind}")

        heartbeat = until("HEARTBEAT", lambda m: m.get_srcComponent() == 1)
        link.target_system, link.target_component = heartbeat.get_srcSystem(), 1
        to = link.target_system, link.target_component
        until("MISSION_REQUEST_INT", lambda m: m.seq == 0, lambda: link.mav.mission_count_send(*to, len(items)))
        link.mav.send(items[0].message(to, 0))
        for n in range(1, len(items)):
            until("MISSION_REQUEST_INT", lambda m, n=n: m.seq == n)
            link.mav.send(items[n].message(to, n))
        until("MISSION_ACK")
        until("MISSION_COUNT", ask=lambda: link.mav.mission_request_list_send(*to))
        for n in range(len(items)):
            until("MISSION_ITEM_INT", lambda m, n=n: m.seq == n, lambda n=n: link.mav.mission_request_int_send(*to, n))
        link.mav.mission_ack_send(*to, 0)
        command = link.mav.command_long_send
        until("COMMAND_ACK", ask=lambda: command(*to, mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0, 1, 0, 0, 0, 0, 0, 0))
        until("COMMAND_ACK", lambda m: m.command == 176, lambda: command(*to, 176, 0, 1, 4, 4, 0, 0, 0, 0))
        return until

    def test_a_flight_of_mavsdks_vehicle_recorded_by_pymavlink(self):
        items = tuple(waypoint(20.0 * n, 10.0) for n in range(12))
        with tempfile.TemporaryDirectory() as folder:
            path, port = os.path.join(folder, "flight.tlog"), free_port()
            vehicle = spawn_vehicle(self, port)
            vehicle.stdin.write(b"S")  # it takes 2 s for each item: heartbeats show the flight
            vehicle.stdin.flush()
            until = self.station(port, path, items[:4])
            until("MISSION_ITEM_REACHED", lambda m: m.seq == 3)
            for _ in range(8):
                until("HEARTBEAT")
            result = self.run_it("--kind", "1=copter:px4", "--name", "1=foreign", path)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("foreign: copter of PX4", result.stdout)
            self.assertIn("foreign: begins its mission of 4 items", result.stdout)
            self.assertIn("foreign: mission done", result.stdout)

    def test_a_return_of_mavsdks_vehicle_that_somebody_else_ordered(self):
        items = tuple(waypoint(20.0 * n, 10.0) for n in range(12))
        with tempfile.TemporaryDirectory() as folder:
            path, port = os.path.join(folder, "flight.tlog"), free_port()
            vehicle = spawn_vehicle(self, port)
            vehicle.stdin.write(b"S")
            vehicle.stdin.flush()
            until = self.station(port, path, items)
            until("HEARTBEAT", lambda m: m.custom_mode >> 24 == 4)
            vehicle.stdin.write(b"R")
            vehicle.stdin.flush()
            until("HEARTBEAT", lambda m: m.custom_mode >> 24 == 5)
            for _ in range(5):
                until("HEARTBEAT")
            result = self.run_it("--kind", "1=copter:px4", path)
            why = "mission failed: returns home in mode RTL, set by its pilot or another station"
            self.assertIn(f"mav-1: {why}", result.stdout)


if __name__ == "__main__":
    unittest.main()
