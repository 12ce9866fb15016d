"""A vehicle that leaves its mission: its pilot's hand, the mission's end, a late copy of an order, or an old heartbeat.
On links that lose, double, delay and reorder. Virtual time."""

import random
import unittest

from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, waypoint, way

SET_MODE = mavlink.MAV_CMD_DO_SET_MODE
# What the autopilot itself takes after the last item: a pilot's hand in the same mode looks alike.
AFTER = [("copter", True, "HOLD"), ("plane", True, "HOLD"), ("plane", False, "RTL"), ("rover", False, "HOLD")]
NEWS = {"MISSION_CURRENT", "MISSION_ITEM_REACHED"}
LATE_COPY = "by its pilot, or by a late copy of an order"


def flown(kind="copter", px4=False, items=None, **more):
    """A vehicle that flies a mission, and its network."""
    vehicle, wires = one(kind, px4, items=items or way(12), **more)
    wires.start("r", "mav-1", stored())
    return vehicle, wires


def flown_from(kind, px4, mode, **more):
    """The same, of a vehicle that is put into another mode first."""
    vehicle, wires = one(kind, px4, **more)
    vehicle.mode = mode
    wires.run(2)
    wires.start("r", "mav-1", stored())
    return vehicle, wires


def modes_sent(wires):
    return [m for m in wires.sent_messages if m.get_type() == "COMMAND_LONG" and m.command == SET_MODE]


class Ends(Case):
    """A mission that was flown to its end is done, even if some of its reports are lost."""

    def fly(self, kind, px4, loses, tells_state=True, items=None):
        vehicle, wires = flown(kind, px4, items)
        vehicle.tells_state = tells_state
        self.assertTrue(wires.run(60, lambda: wires.said("taken")))
        wires.loses = loses(vehicle)
        self.ends(wires, "r", "done")
        self.assertEqual(len(vehicle.began), 1)
        return wires

    def test_the_report_that_the_last_item_is_reached_is_lost(self):
        def loses(vehicle):
            return lambda m: m.get_type() == "MISSION_ITEM_REACHED" and m.seq == len(vehicle.items) - 1

        for kind, px4, _ in AFTER:
            for tells_state in (True, False):
                with self.subTest(kind=kind, px4=px4, tells_state=tells_state):
                    self.fly(kind, px4, loses, tells_state)

    def test_no_report_of_the_last_items_arrives(self):
        """The place of the vehicle decides."""

        def loses(vehicle):
            return lambda m: m.get_type() in NEWS and vehicle.current >= len(vehicle.items) - 3

        for kind, px4, _ in AFTER:
            with self.subTest(kind=kind, px4=px4):
                # Places apart, as 15 m around a place count as there, of planes 150.
                self.fly(kind, px4, loses, items=tuple(waypoint(200.0 * n, 0) for n in range(6)))

    def test_a_vehicle_that_says_each_thing_once(self):
        """As MAVSDK's does: the number after the last item is the end. Any of these reports may be lost."""
        for seed in seeds(100):
            with self.subTest(seed=seed):
                draw = random.Random(seed)
                lost = {("C", n) for n in range(7) if draw.random() < 0.5} | {
                    ("R", n) for n in range(6) if draw.random() < 0.5
                }
                vehicle, wires = flown(px4=True, items=tuple(waypoint(60.0 * n, 0) for n in range(6)))
                vehicle.tells_state = False
                self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                said = set()

                def loses(m):
                    what = {"MISSION_CURRENT": "C", "MISSION_ITEM_REACHED": "R"}.get(m.get_type())
                    if what is None:
                        return False
                    at_end = vehicle.state == mavlink.MISSION_STATE_COMPLETE and what == "C"
                    if at_end:
                        m.seq = 6
                    key = what, m.seq
                    is_new = key not in said
                    said.add(key)
                    return key in lost or not is_new

                wires.loses = loses
                self.ends(wires, "r", "done")

    def test_neither_acknowledgement_nor_heartbeat_says_that_it_has_begun(self):
        """Reached items show it. The order is not repeated: that would fly a short mission twice."""
        for kind, px4 in (("copter", True), ("plane", True), ("rover", False)):
            for seed in seeds(5):
                with self.subTest(kind=kind, px4=px4, seed=seed):
                    vehicle, wires = flown(kind, px4, way(3), seed=seed)
                    mission = vehicle.modes.mission
                    wires.loses = lambda m: (
                        vehicle.mode == mission and m.get_type() in ("HEARTBEAT", "COMMAND_ACK")
                    )
                    self.assertTrue(wires.run(60, lambda: vehicle.began))
                    self.ends(wires, "r", "done")
                    self.assertEqual(len(vehicle.began), 1)


    def test_the_next_mission_while_a_heartbeat_still_shows_the_mode_of_the_one_before(self):
        """Of a short mission of which no heartbeat arrived before its end."""
        for kind, px4 in (("copter", True), ("plane", True), ("rover", False)):
            for again in (False, True):
                with self.subTest(kind=kind, px4=px4, again=again):
                    vehicle, wires = flown(kind, px4, way(3))
                    vehicle.tells_state = False
                    mission, act = vehicle.modes.mission, wires._act
                    wires.loses = lambda m: vehicle.began and m.get_type() == "HEARTBEAT"

                    def at_once():
                        act()
                        if wires.end_of("r") is not None and not wires.said(None, "r2"):
                            wires._act = act
                            wires.loses = lambda m: False
                            if again:
                                wires.start("r2", "mav-1", stored())
                            late, vehicle.mode = vehicle.mode, mission
                            vehicle._beat(wires.now)
                            vehicle.mode = late
                            wires.say(vehicle, vehicle._take())
                            wires.run(0.02)
                            if not again:
                                wires.start("r2", "mav-1", stored())

                    wires._act = at_once
                    self.ends(wires, "r2", "done")
                    self.assertEqual(len(vehicle.began), 2)

    def test_a_mission_of_another_station_after_ours(self):
        """It is not taken for ours."""
        for kind, px4, mode in AFTER:
            with self.subTest(kind=kind, px4=px4):
                vehicle, wires = flown(kind, px4, way(3))
                self.ends(wires, "r", "done")
                wires.run(8)
                vehicle.items = [i.message((1, 1), n) for n, i in enumerate((waypoint(0, 0), *way(30)))]
                vehicle._rewind()
                wires.say(vehicle, vehicle.pilot(wires.now, vehicle.modes.mission))
                wires.run(2)
                wires.start("r2", "mav-1", stored())
                end = wires.run_to_end("r2")
                self.assertEqual(end["kind"], "failed")
                self.assertIn("flies a mission of another station", end["why"])


class Pilots(Case):
    """A pilot's hand is recognised, soon, and nothing is sent after it."""

    def take_over(self, kind, px4, mode, seed, seconds, **more):
        draw = random.Random(seed)
        vehicle, wires = flown(kind, px4, tuple(waypoint(100.0 * (n + 1), 0) for n in range(12)), seed=seed, **more)
        self.assertTrue(wires.run(120, lambda: wires.said("taken")))
        wires.run(6 + 20 * draw.random())
        self.assertIsNone(wires.end_of("r"))
        sent, at = len(modes_sent(wires)), wires.now
        wires.say(vehicle, vehicle.pilot(wires.now, mode))
        end = wires.run_to_end("r", 60)
        self.assertIsNotNone(end)
        self.assertEqual(end["kind"], "failed")
        # With heartbeats lost, a copy of our own order into GUIDED is possible too.
        self.assertRegex(end["why"], f"in mode {mode}|for {mode}: {LATE_COPY}")
        self.assertLessEqual(wires.now - at, seconds)
        wires.run(10)
        self.assertEqual(len(modes_sent(wires)), sent)
        self.assertEqual(vehicle.mode, mode)

    def test_in_any_mode(self):
        """Modes that the autopilot takes after a mission too, and those that we order."""
        hands = [*AFTER, ("copter", False, "LOITER"), ("copter", False, "GUIDED"), ("copter", False, "BRAKE")]
        hands += [("rover", False, "MANUAL"), ("plane", False, "LOITER"), ("copter", True, "POSCTL")]
        for kind, px4, mode in hands:
            for seed in seeds(5):
                with self.subTest(kind=kind, px4=px4, mode=mode, seed=seed):
                    self.take_over(kind, px4, mode, seed, 6.0)

    def test_on_a_bad_link(self):
        for kind, px4, mode in [*AFTER, ("copter", False, "LOITER"), ("copter", False, "GUIDED")]:
            for seed in seeds(10):
                with self.subTest(kind=kind, px4=px4, mode=mode, seed=seed):
                    self.take_over(kind, px4, mode, seed, 16.0, loss=0.3, doubled=0.1, reordered=0.2)

    def test_with_the_reports_of_its_mission_lost(self):
        """The vehicle is not where the mission ends."""
        for kind, px4, mode in AFTER:
            for seed in seeds(5):
                with self.subTest(kind=kind, px4=px4, seed=seed):
                    vehicle, wires = flown(kind, px4, tuple(waypoint(200.0 * (n + 1), 0) for n in range(6)))
                    vehicle.tells_state = False
                    self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                    self.assertTrue(wires.run(120, lambda: vehicle.current >= len(vehicle.items) - 2))
                    wires.loses = lambda m: m.get_type() in NEWS
                    wires.run(random.Random(seed).random())
                    wires.say(vehicle, vehicle.pilot(wires.now, mode))
                    end = wires.run_to_end("r", 12)
                    self.assertIsNotNone(end)
                    self.assertEqual(end["kind"], "failed")

    def test_a_stop_while_the_hand_is_judged(self):
        for seed in seeds(20):
            draw = random.Random(seed)
            vehicle, wires = flown()
            self.assertTrue(wires.run(60, lambda: wires.said("taken")))
            wires.run(6)
            sent = len(modes_sent(wires))
            wires.say(vehicle, vehicle.pilot(wires.now, "LOITER"))
            wires.run(0.3 + 1.2 * draw.random())  # its heartbeat has come
            wires.stop("r")
            self.ends(wires, "r", "failed", "taken over by its pilot in mode LOITER")
            self.assertEqual((len(modes_sent(wires)), vehicle.mode), (sent, "LOITER"))


class Copies(Case):
    """Of our orders."""

    def test_a_late_copy_is_named(self):
        """Heartbeats after it may be lost: the last time at which the vehicle was seen in its mission counts."""
        for kind, px4, mode in (("copter", False, "STABILIZE"), ("copter", True, "POSCTL"), ("rover", False, "MANUAL")):
            for seed in seeds(20):
                with self.subTest(kind=kind, px4=px4, seed=seed):
                    draw = random.Random(seed)
                    vehicle, wires = flown_from(kind, px4, mode, items=way(12))
                    self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                    order = modes_sent(wires)[0]
                    wires.run(3 * draw.random())
                    away = wires.now + 8 * draw.random()
                    loses_ack = draw.random() < 0.5
                    wires.loses = lambda m: (
                        (m.get_type() == "HEARTBEAT" and wires.now < away)
                        or (m.get_type() == "COMMAND_ACK" and loses_ack)
                    )
                    wires.repeat(order)
                    end = wires.run_to_end("r", 60)
                    self.assertEqual(end["kind"], "failed")
                    known = LATE_COPY + "|did not go into mode"
                    self.assertRegex(end["why"], known)

    def test_its_acknowledgement_names_a_copy_of_any_age(self):
        for seconds in (6, 10, 14):
            for px4 in (False, True):
                with self.subTest(seconds=seconds, px4=px4):
                    items = tuple(waypoint(400.0 * (n + 1), 0) for n in range(5))
                    vehicle, wires = flown_from("copter", px4, "POSCTL" if px4 else "STABILIZE", items=items)
                    self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                    wires.run(seconds)
                    wires.repeat(modes_sent(wires)[0])
                    self.assertIn(LATE_COPY, wires.run_to_end("r", 60)["why"])

    def test_an_acknowledgement_of_an_earlier_order_ends_no_stop(self):
        """The order to hold is lost, and the acknowledgement of the second order to begin is late."""
        for kind, px4 in (("copter", False), ("copter", True), ("rover", False), ("plane", False)):
            for seconds in (0.5, 2.0, 5.0):
                with self.subTest(kind=kind, px4=px4, seconds=seconds):
                    vehicle, wires = flown(kind, px4)
                    mission = vehicle.modes.mission
                    wires.loses = lambda m: m.get_type() == "COMMAND_ACK" and vehicle.mode == mission
                    self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                    until = wires.now + seconds
                    wires.loses = lambda m: m.get_type() == "COMMAND_LONG" and wires.now < until
                    wires.stop("r")
                    ack = mavlink.MAVLink_command_ack_message(SET_MODE, 0, 0, 0, 255, 190)
                    wires.say(vehicle, [ack])
                    self.ends(wires, "r", "stopped", seconds=30)
                    self.assertEqual(vehicle.mode, vehicle.modes.hold)

    def test_a_stop_right_after_the_start(self):
        """A late copy of the order to begin does not begin a mission that was stopped."""
        for kind, px4 in (("copter", False), ("copter", True), ("rover", False), ("plane", False)):
            for seed in seeds(40):
                with self.subTest(kind=kind, px4=px4, seed=seed):
                    draw = random.Random(seed)
                    vehicle, wires = one(kind, px4, way(12), seed=seed, doubled=0.4, reordered=0.4)
                    wires.run(5)
                    wires.doubled = wires.reordered = 0.0  # the upload is another matter
                    wires.start("r", "mav-1", stored())
                    self.assertTrue(wires.run(30, lambda: wires.said("note")))
                    wires.doubled = wires.reordered = 0.4
                    self.assertTrue(wires.run(30, lambda: vehicle.began))
                    wires.run(0.4 * draw.random())
                    wires.stop("r")
                    self.ends(wires, "r", "stopped")
                    wires.run(3)
                    self.assertNotEqual((vehicle.mode, vehicle.armed), (vehicle.modes.mission, True))

    def test_a_link_that_doubles_and_reorders(self):
        """By up to 0.3 s, and loses nothing: no mission is begun before a late copy has arrived."""
        for kind, px4 in (("copter", False), ("copter", True), ("rover", False)):
            for seed in seeds(50):
                with self.subTest(kind=kind, px4=px4, seed=seed):
                    vehicle, wires = one(kind, px4, items=way(4), seed=seed, doubled=0.3, reordered=0.3)
                    wires.run(5)
                    wires.start("r", "mav-1", stored())
                    self.ends(wires, "r", "done")
                    self.assertEqual(len(vehicle.began), 1)


class OldHeartbeats(Case):
    """One heartbeat decides nothing: it may have been under way for long."""

    def old(self, vehicle, mode):
        """A heartbeat from when it was in `mode`."""
        now, vehicle.mode = vehicle.mode, mode
        vehicle._beat(0.0)
        vehicle.mode = now
        return vehicle._take()

    def test_the_mission_goes_on(self):
        for kind, px4, mode in [*AFTER, ("copter", False, "STABILIZE"), ("copter", False, "GUIDED")]:
            for seed in seeds(5):
                with self.subTest(kind=kind, px4=px4, mode=mode, seed=seed):
                    vehicle, wires = flown(kind, px4, seed=seed)
                    self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                    wires.run(2 + 5 * random.Random(seed).random())
                    wires.say(vehicle, self.old(vehicle, mode))
                    self.ends(wires, "r", "done")
                    self.assertEqual(len(vehicle.began), 1)

    def test_before_the_mission_has_begun(self):
        """At each of its stages, of a vehicle that is disarmed and of one that is armed."""
        for kind, px4, armed in (("copter", False, False), ("copter", False, True), ("copter", True, True)):
            for tenths in range(0, 30, 2):
                with self.subTest(kind=kind, px4=px4, armed=armed, tenths=tenths):
                    vehicle, wires = one(kind, px4, way(12), armed, delay=0.1)
                    wires.start("r", "mav-1", stored())
                    wires.run(tenths / 10)
                    wires.say(vehicle, self.old(vehicle, "POSCTL" if px4 else "LOITER"))
                    self.ends(wires, "r", "done")
                    self.assertEqual(len(vehicle.began), 1)

    def test_a_stop_is_not_lost(self):
        """A vehicle that was not left flies on, and is stopped."""
        for seed in seeds(10):
            with self.subTest(seed=seed):
                vehicle, wires = flown(seed=seed)
                self.assertTrue(wires.run(60, lambda: wires.said("taken")))
                wires.run(3)
                wires.say(vehicle, self.old(vehicle, "STABILIZE"))
                wires.run(0.05 + 0.5 * random.Random(seed).random())
                wires.stop("r")
                self.ends(wires, "r", "stopped")
                self.assertEqual(vehicle.mode, "BRAKE")


if __name__ == "__main__":
    unittest.main()
