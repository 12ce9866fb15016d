"""Places in stored missions: how they are sent, compared and refused, for any command in any frame."""

import importlib
import json
import pkgutil
import random
import re
import unittest

from pymavlink.dialects import v20

from dolphin_mavlink import mission, mission_files
from dolphin_mavlink.mission import Item, Unreadable
from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, waypoint

# Those of pymavlink that missions of ArduPilot or PX4 are written in.
DIALECTS = [m.name for m in pkgutil.iter_modules(v20.__path__) if m.name in {"ardupilotmega", "common", "development"}]
GLOBAL_FRAMES = (0, 3, 5, 6, 10, 11)
AS_IT_IS = (
    mavlink.MAV_CMD_DO_DIGICAM_CONFIGURE,
    mavlink.MAV_CMD_DO_DIGICAM_CONTROL,
    mavlink.MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW,
    mavlink.MAV_CMD_NAV_SCRIPT_TIME,
    mavlink.MAV_CMD_NAV_ATTITUDE_TIME,
)
# These are read otherwise: jumps by numbers of items; points of fences and rally points are refused.
OTHERS = (mission.JUMP, mission.JUMP_TO_TAG, *range(5000, 5005), 5100)
DEFINED = sorted(n for n in mavlink.enums["MAV_CMD"] if n not in OTHERS and n < 65536)
# Commands of which issues were reported, beside those that are drawn.
KNOWN = (16, 22, 30, 36, 80, 94, 179, 189, 195, 201, 4501)


def file_of(kind, command, frame, x, y, z=30.0):
    """The items of a file of `kind` with one item, and a waypoint after it."""
    if kind == "plan":
        items = [
            {"type": "SimpleItem", "command": c, "frame": f, "params": [0, 0, 0, 0, *p], "doJumpId": n}
            for n, (c, f, p) in enumerate([(command, frame, (x, y, z)), (16, 3, (41.185, -8.706, 30))], 1)
        ]
        return mission_files.of_file("a.plan", json.dumps({"mission": {"items": items}}))
    rows = [(16, 0, (41.185, -8.706, 10)), (command, frame, (x, y, z)), (16, 3, (41.185, -8.706, 30))]
    lines = [
        "\t".join(str(c) for c in (n, 0, f, c, 0, 0, 0, 0, *(repr(float(v)) for v in p), 1))
        for n, (c, f, p) in enumerate(rows)
    ]
    return mission_files.of_file("a.waypoints", "QGC WPL 110\n" + "\n".join(lines) + "\n")


def drawn(generator):
    command = generator.choice((generator.choice(KNOWN), generator.choice(DEFINED), generator.randrange(65536)))
    while command in OTHERS:
        command = generator.choice(DEFINED)
    frame = generator.choice((*GLOBAL_FRAMES, 2))
    return command, frame, round(generator.uniform(-90, 90), 7), round(generator.uniform(-180, 180), 7)


def is_place(command, frame):
    return frame in GLOBAL_FRAMES and command not in AS_IT_IS


class Places(Case):
    def test_any_command_in_any_frame(self):
        """Global frames have degrees, sent in units of 1e-7 degrees; frame 2 has numbers, sent as they are."""
        for seed in seeds(20):
            generator = random.Random(seed)
            for _ in range(100):
                command, frame, x, y = drawn(generator)
                kind = generator.choice(("plan", "waypoints"))
                with self.subTest(seed=seed, command=command, frame=frame, place=(x, y), kind=kind):
                    try:
                        item = file_of(kind, command, frame, x, y)[0]
                    except Unreadable as why:
                        # Degrees in a frame without places.
                        self.assertFalse(is_place(command, frame), why)
                        self.assertIn(f"frame {frame}", str(why))
                        self.assertTrue(mission.has_defined_place(command))
                        continue
                    sent = item.message((1, 1), 1)
                    scale = 1e7 if is_place(command, frame) else 1
                    self.assertEqual((sent.x, sent.y), (round(x * scale), round(y * scale)))

    def test_each_place_is_compared(self):
        """A place that is kept wrongly is a difference. A vehicle may drop places that MAVLink does not define."""
        for seed in seeds(20):
            generator = random.Random(seed)
            for _ in range(100):
                command, frame, x, y = drawn(generator)
                if not is_place(command, frame):
                    continue
                item = file_of("plan", command, frame, x, y)[0]
                unscaled = mission.dataclasses.replace(item, x=round(x), y=round(y))
                off = mission.dataclasses.replace(item, x=item.x + generator.choice((-50, 2, 1000)))
                dropped = mission.dataclasses.replace(item, x=0, y=0)
                with self.subTest(seed=seed, command=command, frame=frame, place=(x, y)):
                    self.assertIsNone(mission.difference(item, item))
                    self.assertIn("instead of", mission.difference(item, off))
                    if (unscaled.x, unscaled.y) != (0, 0):
                        self.assertIn("instead of", mission.difference(item, unscaled))
                    if command in KNOWN or command not in mavlink.enums["MAV_CMD"]:
                        self.assertIn("0.0000000, 0.0000000 instead of", mission.difference(item, dropped))

    def test_near_0_0(self):
        for kind in ("plan", "waypoints"):
            for command in KNOWN:
                for x, y in ((1e-6, 0.0), (0.0, -8e-6), (1e-9, 1e-9), (6e-6, 6e-6)):
                    with self.subTest(kind=kind, command=command, place=(x, y)):
                        with self.assertRaises(Unreadable) as caught:
                            file_of(kind, command, 3, x, y)
                        self.assertIn("item 1 is at", str(caught.exception))
                        self.assertIn("within a metre of 0, 0", str(caught.exception))
                item = file_of(kind, command, 3, 0.0, 0.0)[0]
                self.assertEqual((item.x, item.y), (0, 0))
                self.assertEqual(file_of(kind, command, 3, 2e-5, 0.0)[0].x, 200)

    def test_degrees_in_a_frame_without_places(self):
        for command in (80, 94, 179, 189, 195, 201, 4501):
            with self.assertRaises(Unreadable) as caught:
                file_of("waypoints", command, 2, 41.19, -8.7)
            self.assertIn("frame 2", str(caught.exception))

    def test_the_height_and_frame_of_a_take_off_here(self):
        sent = Item(22, 6, z=30.0)
        self.assertIsNone(mission.difference(sent, Item(22, 3, z=30.0)))
        self.assertIn("a height of 3 m", mission.difference(sent, Item(22, 6, z=3.0)))
        self.assertIn("frame 0", mission.difference(sent, Item(22, 0, z=30.0)))
        self.assertIn("41.0000000", mission.difference(sent, Item(22, 6, x=410000000, z=30.0)))

    def test_an_autopilot_that_drops_what_it_does_not_use(self):
        """A return home with a place left over in the file is flown; a home position elsewhere is not."""
        for command, why in (
            (20, None),
            (179, "item 1 has 0.0000000, 0.0000000 instead of 41.1900000, -8.7000000"),
        ):
            items = file_of("waypoints", command, 3, 41.19, -8.7)[::-1]
            vehicle, wires = one(items=items)

            def keep(kept):
                for item in kept:
                    if item.command == command:
                        item.x = item.y = 0
                return kept

            vehicle.keeps = keep
            wires.start("r", "mav-1", stored())
            if why is None:
                wires.run(20, lambda: vehicle.began)
                self.assertEqual(len(vehicle.began), 1)
            else:
                why = why.replace("item 1", "item 2")
                self.ends(wires, "r", "failed", f"the mission is not on board as it was sent: {why}")
                self.assertEqual(vehicle.began, [])

    def test_what_an_autopilot_fulfils_before_it_goes_on(self):
        """In each dialect the commands up to NAV_LAST, and others that are called NAV and can stand in a mission:
        points of fences and rally points cannot."""
        for dialect in DIALECTS:
            commands = importlib.import_module(f"pymavlink.dialects.v20.{dialect}").enums["MAV_CMD"]
            for number, entry in commands.items():
                with self.subTest(dialect=dialect, command=entry.name):
                    is_point = re.match("MAV_CMD_NAV_(FENCE|RALLY)", entry.name)
                    is_named = entry.name.startswith("MAV_CMD_NAV_") and not is_point
                    self.assertEqual(Item(number).is_navigation(False), number <= 95 or is_named)

    def test_a_mission_ends_after_what_is_fulfilled_last(self):
        """Not with the waypoint before it."""
        for command, params in ((42702, (1.0, 20.0, 0.0, 0.0)), (42703, (20.0, 0.0, 0.0, 0.0)), (213, (90.0, 0, 0, 0))):
            for px4 in (False, True):
                with self.subTest(command=command, px4=px4):
                    vehicle, wires = one(px4=px4, items=(waypoint(20, 0), Item(command, 2, params)))
                    wires.start("r", "mav-1", stored())
                    self.ends(wires, "r", "done")
                    self.assertEqual(len(vehicle.reached), 2)

    def test_a_time_that_the_autopilot_cuts_off(self):
        """ArduPilot keeps the seconds of a script in a byte."""
        vehicle, wires = one(items=(waypoint(20, 0), Item(42702, 2, (1.0, 300.0, 0.0, 0.0))))

        def keep(kept):
            for item in kept:
                item.param2 = item.param2 % 256
            return kept

        vehicle.keeps = keep
        wires.start("r", "mav-1", stored())
        why = "item 2 has parameter 2 of command 42702 is 44 instead of 300"
        self.ends(wires, "r", "failed", f"the mission is not on board as it was sent: {why}")

    def test_what_follows_a_region_of_interest_starts_from_the_way(self):
        """`move` after a stored mission goes on from the last place that is flown to."""
        interest = waypoint(500, 500, command=201)
        plan = stored()
        plan["body"]["items"] += [
            {"item": "altitude", "arguments": [30], "named": {}},
            {"item": "move", "arguments": [10], "named": {}},
        ]
        vehicle, wires = one(items=(waypoint(20, 0), interest))
        wires.start("r", "mav-1", plan)
        self.ends(wires, "r", "done")
        self.assertLess(abs(vehicle.items[-1].x - waypoint(30, 0).x), 3)


if __name__ == "__main__":
    unittest.main()
