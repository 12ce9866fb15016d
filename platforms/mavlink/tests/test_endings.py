"""How missions end that land, and vehicles that are disarmed, restarted or taken away. Virtual time."""

import unittest

from dolphin_mavlink.mission import Item
from dolphin_mavlink.wire import mavlink
from tests.support import Case, one, seeds, stored, waypoint, way

LANDINGS = {
    "a landing": waypoint(0, 0, 0.0, command=21),
    "a landing where it is": Item(21, 6),
    "a return": Item(20),
}


def begun(items, px4=False, **more):
    vehicle, wires = one(px4=px4, items=items, **more)
    wires.start("r", "mav-1", stored())
    return vehicle, wires


def at_its_landing(vehicle, height):
    return lambda: 0 < len(vehicle.items) - 1 <= vehicle.current and vehicle.altitude <= height


class Landings(Case):
    def test_a_copter_that_lands_is_done(self):
        """ArduCopter goes back to its first item when it is disarmed, and reports the ground only after that."""
        for what, landing in LANDINGS.items():
            for px4 in (False, True):
                for loss in (0.0, 0.3):
                    for seed in seeds(10):
                        with self.subTest(what=what, px4=px4, loss=loss, seed=seed):
                            vehicle, wires = begun((*way(3), landing), px4, seed=seed, loss=loss, delay=0.05)
                            self.ends(wires, "r", "done")
                            self.assertFalse(vehicle.armed)
                            self.assertEqual(vehicle.altitude, 0.0)
                            self.assertEqual(len(vehicle.began), 1)

    def test_a_link_that_is_away_at_touchdown(self):
        for what, landing in LANDINGS.items():
            for before in (25.0, 15.0, 8.0, 3.0, 0.5):
                for away in (2, 8, 30, 90):
                    with self.subTest(what=what, before=before, away=away):
                        vehicle, wires = begun((*way(3), landing), delay=0.05)
                        self.assertTrue(wires.run(200, at_its_landing(vehicle, before)))
                        wires.down = True
                        wires.run(away)
                        wires.down = False
                        self.ends(wires, "r", "done")
                        self.assertEqual(len(vehicle.began), 1)

    def test_a_link_that_is_away_from_the_first_item_on(self):
        """That it landed where the mission ends is enough."""
        for what, landing in LANDINGS.items():
            with self.subTest(what=what):
                vehicle, wires = begun((*way(8), landing))
                self.assertTrue(wires.run(60, lambda: vehicle.current == 3))
                wires.down = True
                wires.run(200)
                wires.down = False
                self.ends(wires, "r", "done")

    def test_a_link_that_is_away_while_it_lands_elsewhere(self):
        vehicle, wires = begun((*way(8), waypoint(500, 0, 0.0, command=21)))
        self.assertTrue(wires.run(60, lambda: vehicle.current == 3))
        wires.down = True
        vehicle._advance(wires.now)
        vehicle.altitude, vehicle._on_ground = 0.0, True
        vehicle.disarm(wires.now)
        wires.run(20)
        wires.down = False
        why = "was disarmed while it was not heard: it may have flown its mission"
        self.ends(wires, "r", "failed", why)

    def test_the_next_mission_after_a_landing(self):
        vehicle, wires = begun((*way(3), LANDINGS["a landing"]))
        self.ends(wires, "r", "done")
        for n in range(3):
            wires.start(f"r{n}", "mav-1", stored())
            self.ends(wires, f"r{n}", "done")
        self.assertEqual(len(vehicle.began), 4)

    def test_progress_does_not_go_back(self):
        vehicle, wires = begun((*way(5), LANDINGS["a landing"]))
        self.ends(wires, "r", "done")
        shares = [r["share"] for r in wires.said("progress", "r")]
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(shares[-1], 0.8)


class Motors(Case):
    def test_a_vehicle_whose_motors_are_stopped_in_flight(self):
        """At each item, also at the one that lands it: ArduCopter claims the ground at once."""
        for number in range(2, 5):
            for loss in (0.0, 0.2):
                for seed in seeds(5):
                    with self.subTest(number=number, loss=loss, seed=seed):
                        items = (*way(5), LANDINGS["a landing"])
                        vehicle, wires = begun(items, seed=seed, loss=loss, delay=0.05)
                        self.assertTrue(wires.run(60, lambda: vehicle.current == number))
                        wires.run(6, lambda: vehicle.current > number)
                        wires.say(vehicle, vehicle.kill(wires.now))
                        self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_a_vehicle_whose_motors_are_stopped_while_it_lands(self):
        for height in (28.0, 20.0, 12.0, 8.0):
            for seed in seeds(10):
                with self.subTest(height=height, seed=seed):
                    vehicle, wires = begun((*way(3), LANDINGS["a landing"]), seed=seed, delay=0.05)
                    self.assertTrue(wires.run(200, at_its_landing(vehicle, height)))
                    wires.run(0.1 * seed)
                    wires.say(vehicle, vehicle.kill(wires.now))
                    self.ends(wires, "r", "failed", "was disarmed in flight")

    def test_a_vehicle_that_is_disarmed_on_the_ground(self):
        for kind in ("rover", "boat"):
            vehicle, wires = one(kind, items=way(12))
            wires.start("r", "mav-1", stored())
            self.assertTrue(wires.run(30, lambda: wires.said("taken")))
            wires.run(8)
            wires.say(vehicle, vehicle.disarm(wires.now))
            self.ends(wires, "r", "failed", "was disarmed")


class StopsAndStarts(Case):
    def test_a_start_right_after_a_stop(self):
        """A heartbeat ends a stop: the acknowledgement comes before it, on a slow radio by a second."""
        for px4 in (False, True):
            for lag in (0.02, 0.3, 0.9):
                for loss in (0.0, 0.2):
                    for seed in seeds(5):
                        with self.subTest(px4=px4, lag=lag, loss=loss, seed=seed):
                            vehicle, wires = one(px4=px4, items=way(12), delay=0.1, loss=loss, seed=seed)
                            vehicle.lag = lag
                            wires.start("a", "mav-1", stored())
                            wires.run(6 + 0.1 * seed)
                            act, begun = wires._act, []

                            def at_once():
                                act()
                                if wires.end_of("a") is not None and not begun:
                                    begun.append(True)
                                    wires.start("b", "mav-1", stored())

                            wires._act = at_once
                            wires.stop("a")
                            self.assertEqual(wires.run_to_end("a", 60)["kind"], "stopped")
                            self.assertNotEqual(vehicle.mode, vehicle.modes.mission if not begun else None)
                            self.ends(wires, "b", "done")

    def test_a_stop_that_is_refused_at_first_is_repeated(self):
        vehicle, wires = begun(way(30))
        self.assertTrue(wires.run(30, lambda: wires.said("taken")))
        wires.run(3)
        vehicle.results[mavlink.MAV_CMD_DO_SET_MODE] = mavlink.MAV_RESULT_FAILED
        wires.stop("r")
        wires.run(5)
        self.assertIsNone(wires.end_of("r"))
        del vehicle.results[mavlink.MAV_CMD_DO_SET_MODE]
        self.ends(wires, "r", "stopped")
        self.assertEqual(vehicle.mode, "BRAKE")


if __name__ == "__main__":
    unittest.main()
